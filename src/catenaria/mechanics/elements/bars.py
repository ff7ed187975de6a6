"""Bars between two wires by their force density: droppers of any stiffness, which incline as they like."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.carrier import Carrier
from catenaria.mechanics.chain import Points
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_VERTICAL = np.array([0.0, 0.0, 1.0])
_SOFT = 1e-4  # [1/N]; which bars are slack in the end is the same for any positive value


@dataclass(frozen=True)
class Bars:
    r"""Straight bars from points of lower to points of upper wires, with their weight.

    Parameters
    ----------
    lower, upper : Carrier
        The wires at their ends.
    s_lower, s_upper : IntArray, shape (n,)
        Indices of the sliding coordinates of the clamps [m]. Their rows are left to `Guides` or `Given`.
    element_lower, element_upper : IntArray, shape (n,)
        Elements in which the clamps are: discrete state, changed by `relocate` only.
    density : IntArray, shape (n,)
        Indices of the force densities q [N/m]: pull over length.
    length : IntArray, shape (n,)
        Indices of the unstressed lengths l0 [m]. Their rows are left to targets or given values.
    flexibility : FloatArray, shape (n,)
        1/EA [1/N], 0 for rigid bars.
    rhoA : FloatArray, shape (n,)
        Mass per length [kg/m].
    mass_lower, mass_upper : FloatArray, shape (n,)
        Masses of the clamps [kg].
    g : float
        Gravity [m/s^2].
    ramp : Ramp
        Its growth in time, rho(t).
    only_pull : bool
        Whether bars go slack instead of pushing.

    Notes
    -----
    With d = r(s_upper) - r(s_lower) the lower wire gets q d, the upper one -q d (Schek 1974), and either end
    half of the weight g rhoA |d| and its clamp. The row of q is the bar's elongation in Green strain,

    .. math::
        C = l_0 (\varepsilon - q\,l_0/EA) = 0, \qquad \varepsilon = \tfrac12 (d \cdot d/l_0^2 - 1),

    which a rigid bar meets by eps = 0. Bars that only pull have 0 <= q, C <= 0 and q C = 0 instead:

    .. math:: \max(C,\; -l_0^2 c\,q) = 0,

    for any c > 0; with c = 1/EA it would read l0 max(eps, 0) = l0^2 q/EA. Newton's method on it is the
    primal-dual active set of Hintermueller, Ito & Kunisch (2002): a bar is slack where the second argument is
    larger. Bars that are stiff or rigid decide as soft ones would, c = max(1/EA, 1e-4/N): a millimetre of
    slack counts as much as a pull of some 10 N.
    """

    lower: Carrier
    upper: Carrier
    s_lower: IntArray
    s_upper: IntArray
    element_lower: IntArray
    element_upper: IntArray
    density: IntArray
    length: IntArray
    flexibility: FloatArray
    rhoA: FloatArray
    mass_lower: FloatArray
    mass_upper: FloatArray
    g: float
    ramp: Ramp
    only_pull: bool = False

    def _ends(self, z: FloatArray) -> tuple[Points, Points]:
        below = self.lower.evaluate(z, z[self.s_lower], self.element_lower)
        return below, self.upper.evaluate(z, z[self.s_upper], self.element_upper)

    def loads(self, t: float, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the forces of bars and clamps on the lower and the upper wires [N], shape (n, 3) each."""
        below, above = self._ends(z)
        on_below, on_above = self._burdens(t, z, above.r - below.r)
        return -on_below, -on_above

    def slack(self, z: FloatArray) -> NDArray[np.bool_]:
        """Return which bars hang slack, shape (n,); none do if bars may push."""
        below, above = self._ends(z)
        return self._slack(z, above.r - below.r)

    def _burdens(self, t: float, z: FloatArray, d: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what the residual of the two ends gets: minus the forces on the wires."""
        pull = z[self.density][:, None] * d
        half, gravity = self._half_density(t) * _size(d), self.g * self.ramp(t)
        below = (half + gravity * self.mass_lower)[:, None] * _VERTICAL
        above = (half + gravity * self.mass_upper)[:, None] * _VERTICAL
        return below - pull, above + pull

    def _half_density(self, t: float) -> FloatArray:
        """Return half of the weight per length [N/m]."""
        return (0.5 * self.g * self.ramp(t)) * self.rhoA

    def _elongation(self, z: FloatArray, d: FloatArray) -> FloatArray:
        """Return l0 times the strain from the unstressed length [m]."""
        l0 = z[self.length]
        return 0.5 * (np.einsum("ni,ni->n", d, d) / l0 - l0)

    def _slack(self, z: FloatArray, d: FloatArray) -> NDArray[np.bool_]:
        if not self.only_pull:
            return np.zeros(self.density.size, dtype=np.bool_)
        q, l0 = z[self.density], z[self.length]
        return self._elongation(z, d) + (self._softness - self.flexibility) * l0**2 * q < 0.0

    @property
    def _softness(self) -> FloatArray:
        """The factor c of the row of a slack bar [1/N]."""
        return np.maximum(self.flexibility, _SOFT)

    def _law(self, z: FloatArray, d: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return 1 for taut bars and 0 for slack ones, and the flexibility in the bar's row."""
        slack = self._slack(z, d)
        return np.where(slack, 0.0, 1.0), np.where(slack, self._softness, self.flexibility)

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add bar forces and weights, and the bars' own equations, to f."""
        z = state.z
        below, above = self._ends(z)
        d = above.r - below.r
        for end, burden in zip((below, above), self._burdens(state.t, z, d), strict=True):
            np.add.at(f, end.dofs.ravel(), (end.N[:, :, None] * burden[:, None, :]).ravel())
        taut, flexibility = self._law(z, d)
        f[self.density] += taut * self._elongation(z, d) - flexibility * z[self.length] ** 2 * z[self.density]

    def pattern(self) -> Pattern:
        """Return the entries of both ends' forces and of the bars' equations.

        Notes
        -----
        Forces couple each direction with itself by q, and the vertical one with all by the weight.
        """
        dofs, q = self._dofs(), self.density[:, None]
        s = np.stack((self.s_lower, self.s_upper), axis=1)
        on, by = dofs[:, :, None, :], dofs[:, None, :, :]
        blocks = (
            (on, by),
            (on[..., 2:], by),
            (on, s[:, None, :, None]),
            (dofs, q[:, :, None]),
            (q[:, :, None], dofs),
            (q, s),
            (q, q),
            (q, self.length[:, None]),
        )
        pairs = [np.broadcast_arrays(*block) for block in blocks]
        return np.concatenate([rows.ravel() for rows, _ in pairs]), np.concatenate(
            [columns.ravel() for _, columns in pairs]
        )

    def _dofs(self) -> IntArray:
        """Return the nodal coordinates of both ends, shape (n, 8, 3)."""
        ends = ((self.lower.nodes, self.element_lower), (self.upper.nodes, self.element_upper))
        nodes = [nodes[element + i] for nodes, element in ends for i in (0, 1)]
        return np.concatenate(nodes, axis=1).reshape(-1, 8, 3)

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return the exact derivatives at those entries."""
        ends = self._ends(state.z)
        parts = (*self._by_forces(state, ends), *self._by_equations(state.z, ends))
        return np.concatenate([part.ravel() for part in parts])

    def _by_forces(self, state: State, ends: tuple[Points, Points]) -> tuple[FloatArray, ...]:
        """Return the derivatives of the nodal forces by nodal coordinates (twice), s and q.

        Notes
        -----
        With A = (N_l, N_u) and B = (-N_l, N_u), which gives d = B r_k, they are q B d + A w e_z, where the
        weights w have dw/dd = g rho rhoA/2 d/|d|. A clamp that shifts distributes its force by N'.
        """
        below, above = ends
        A, B, d, d_s = _coupling(below, above)
        qB = state.z[self.density][:, None] * B
        w_d = (self._half_density(state.t) / _size(d))[:, None] * d
        elastic = np.broadcast_to((qB[:, :, None] * B[:, None, :])[..., None], (*B.shape, 8, 3))
        weighing = A[:, :, None, None] * (B[:, :, None] * w_d[:, None, :])[:, None]
        by_s = qB[:, :, None, None] * d_s[:, None]
        by_s[..., 2] += A[:, :, None] * np.einsum("ni,nei->ne", w_d, d_s)[:, None]
        for e, (end, burden) in enumerate(zip(ends, self._burdens(state.t, state.z, d), strict=True)):
            by_s[:, 4 * e : 4 * e + 4, e] += end.N1[:, :, None] * burden[:, None]
        return elastic, weighing, by_s, B[:, :, None] * d[:, None]

    def _by_equations(self, z: FloatArray, ends: tuple[Points, Points]) -> tuple[FloatArray, ...]:
        """Return the derivatives of the bars' equations by nodal coordinates, s, q and l0."""
        _, B, d, d_s = _coupling(*ends)
        q, l0 = z[self.density], z[self.length]
        taut, flexibility = self._law(z, d)
        by_d = (taut / l0)[:, None] * d
        by_l0 = -0.5 * taut * (np.einsum("ni,ni->n", d, d) / l0**2 + 1.0) - 2.0 * flexibility * q * l0
        along = np.einsum("ni,nei->ne", by_d, d_s)
        return B[:, :, None] * by_d[:, None], along, -flexibility * l0**2, by_l0

    def relocate(self, z: FloatArray) -> Bars | None:
        """Return the bars with their clamps in the elements that fit z, or None if they are."""
        lower = self.lower.relocate(z[self.s_lower], self.element_lower)
        upper = self.upper.relocate(z[self.s_upper], self.element_upper)
        if np.array_equal(lower, self.element_lower) and np.array_equal(upper, self.element_upper):
            return None
        return replace(self, element_lower=lower, element_upper=upper)


def _size(d: FloatArray) -> FloatArray:
    return np.sqrt(np.einsum("ni,ni->n", d, d))


def _coupling(below: Points, above: Points) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return A = (N_l, N_u), B = (-N_l, N_u), d and its derivatives by both s, shape (n, 2, 3)."""
    A, B = (np.concatenate((sign * below.N, above.N), axis=1) for sign in (1.0, -1.0))
    return A, B, above.r - below.r, np.stack((-below.r1, above.r1), axis=1)
