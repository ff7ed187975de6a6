"""Whole droppers: straight elastic bars between two wires, which can only pull."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.chain import Chain, Points
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_VERTICAL = np.array([0.0, 0.0, 1.0])
_ACROSS = np.array([0.0, 1.0, 1.0])  # a guide takes the component along the track


@dataclass(frozen=True)
class Droppers:
    r"""Bars from a lower to an upper wire with their weight, guided along the track or clamped to the wires.

    Parameters
    ----------
    lower, upper : Chain
        Contact wire and messenger wire.
    s_lower, s_upper : IntArray, shape (n,)
        Indices of the sliding coordinates of the clamps [m].
    element_lower, element_upper : IntArray, shape (n,)
        Elements in which the clamps are: discrete state.
    length : IntArray, shape (n,)
        Indices of the unstressed lengths l0 [m]: parameters.
    x : FloatArray, shape (n,)
        Where guides hold both ends along the track [m].
    EA, rhoA : float
        Axial stiffness [N] and mass per length [kg/m].
    clamp_lower, clamp_upper : float
        Masses of the clamps [kg].
    g : float
        Gravity [m/s^2].
    clamped : tuple of FloatArray, shape (n,) each, optional
        Material coordinates at which the clamps are fixed to the two wires [m]; then there are no guides.
    may_push : bool
        Let bars push as they pull; a step on the way to an equilibrium with bars that cannot.

    Notes
    -----
    With d = r(s_upper) - r(s_lower), |d| = l, Green strain eps = (l^2/l0^2 - 1)/2, a bar pulls its ends by

    .. math:: F = EA\,\varepsilon\,d / l_0 \quad (\varepsilon > 0),\qquad F = 0 \quad (\varepsilon \le 0),

    the derivative of the energy EA l0 eps^2/2. Half of its weight g rhoA l hangs on either end, so that the
    forces at the ends differ by G of eq. (23). The row of a sliding coordinate holds x(s) = X, and forces
    along the track are those of guides, which do not act on the wires; or s = s*, and all of the force acts.
    """

    lower: Chain
    upper: Chain
    s_lower: IntArray
    s_upper: IntArray
    element_lower: IntArray
    element_upper: IntArray
    length: IntArray
    x: FloatArray
    EA: float
    rhoA: float
    clamp_lower: float
    clamp_upper: float
    g: float
    clamped: tuple[FloatArray, FloatArray] | None = None
    may_push: bool = False

    def _ends(self, z: FloatArray) -> tuple[Points, Points]:
        below = self.lower.evaluate(z, z[self.s_lower], self.element_lower)
        return below, self.upper.evaluate(z, z[self.s_upper], self.element_upper)

    def loads(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the forces of droppers and clamps on the lower and the upper wire [N], shape (n, 3) each."""
        below, above = self._ends(z)
        on_below, on_above = self._burdens(z, above.r - below.r)
        return -on_below * self._acts, -on_above * self._acts

    @property
    def _acts(self) -> FloatArray:
        """Components of the forces that act on the wires."""
        return _ACROSS if self.clamped is None else np.ones(3)

    @property
    def _loaded(self) -> NDArray[np.bool_]:
        """Which of the 24 nodal coordinates of both ends a force acts on."""
        return np.tile(self._acts > 0.0, 8)

    def _stiffness(self, z: FloatArray, d: FloatArray) -> FloatArray:
        """Return the force per length of d, k = EA eps/l0 of a taut bar [N/m]."""
        l0 = z[self.length]
        eps = 0.5 * (np.einsum("ni,ni->n", d, d) / l0**2 - 1.0)
        return self.EA * (eps if self.may_push else np.maximum(eps, 0.0)) / l0

    def _burdens(self, z: FloatArray, d: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what the residual of the two ends gets: minus the forces on the wires."""
        pull = self._stiffness(z, d)[:, None] * d
        half = 0.5 * self.g * self.rhoA * np.linalg.norm(d, axis=1)
        below = (half + self.g * self.clamp_lower)[:, None] * _VERTICAL
        above = (half + self.g * self.clamp_upper)[:, None] * _VERTICAL
        return below - pull, above + pull

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add bar forces, weights and the guides' equations to f."""
        below, above = self._ends(state.z)
        on_below, on_above = self._burdens(state.z, above.r - below.r)
        for end, burden in ((below, on_below), (above, on_above)):
            np.add.at(f, end.dofs, end.N[:, :, None] * (burden * self._acts)[:, None, :])
        if self.clamped is None:
            f[self.s_lower] += below.r[:, 0] - self.x
            f[self.s_upper] += above.r[:, 0] - self.x
        else:
            f[self.s_lower] += state.z[self.s_lower] - self.clamped[0]
            f[self.s_upper] += state.z[self.s_upper] - self.clamped[1]

    def pattern(self) -> Pattern:
        """Return the entries of both ends' forces by both ends' coordinates, s and l0, and of the guides."""
        below = _dofs(self.lower, self.element_lower)
        above = _dofs(self.upper, self.element_upper)
        dofs = np.concatenate((below, above), axis=1)
        by = np.concatenate(
            (dofs, self.s_lower[:, None], self.s_upper[:, None], self.length[:, None]), axis=1
        )
        loaded = dofs[:, self._loaded]
        rows = [np.repeat(loaded, by.shape[1], axis=1).ravel()]
        columns = [np.tile(by, (1, loaded.shape[1])).ravel()]
        for s, end in ((self.s_lower, below), (self.s_upper, above)):
            rows += [np.repeat(s, 4), s]
            columns += [end[:, ::3].ravel(), s]
        return np.concatenate(rows), np.concatenate(columns)

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return the exact derivatives at those entries.

        Notes
        -----
        With k = EA eps/l0: dF/dd = k 1 + EA d d^T/l0^3, dF/dl0 = -(k/l0 + EA l^2/l0^4) d, and the weight of
        half a bar changes by g rhoA/2 d/l.
        """
        z = state.z
        below, above = self._ends(z)
        d, l0 = above.r - below.r, z[self.length]
        size, k = np.linalg.norm(d, axis=1), self._stiffness(z, d)
        taut = self.EA * ((k > 0.0) | self.may_push)
        F_d = k[:, None, None] * np.eye(3) + (taut / l0**3)[:, None, None] * d[:, :, None] * d[:, None, :]
        F_l0 = -(k / l0 + taut * size**2 / l0**4)[:, None] * d
        w_d = 0.5 * self.g * self.rhoA * _VERTICAL[:, None] * (d / size[:, None])[:, None, :]
        on_below, on_above = self._burdens(z, d)
        by_below = _by_all(below, (below, above), w_d - F_d, -F_l0, self._acts)
        by_above = _by_all(above, (below, above), w_d + F_d, F_l0, self._acts)
        for matrix, end, burden, column in ((by_below, below, on_below, 24), (by_above, above, on_above, 25)):
            # a clamp that shifts along its wire distributes its force differently
            matrix[:, :, column] += (end.N1[:, :, None] * (burden * self._acts)[:, None, :]).reshape(-1, 12)
        parts = [np.concatenate((by_below, by_above), axis=1)[:, self._loaded].ravel()]
        for end in (below, above):
            guide = self.clamped is None
            parts += (
                [end.N.ravel(), end.r1[:, 0]] if guide else [np.zeros(end.N.size), np.ones(end.N.shape[0])]
            )
        return np.concatenate(parts)

    def relocate(self, z: FloatArray) -> Droppers | None:
        """Return the droppers with their clamps in the elements that fit z, or None if they are."""
        lower = self.lower.relocate(z[self.s_lower], self.element_lower)
        upper = self.upper.relocate(z[self.s_upper], self.element_upper)
        if np.array_equal(lower, self.element_lower) and np.array_equal(upper, self.element_upper):
            return None
        return replace(self, element_lower=lower, element_upper=upper)


def _dofs(wire: Chain, element: IntArray) -> IntArray:
    return np.concatenate((wire.nodes[element], wire.nodes[element + 1]), axis=1)


def _by_all(
    on: Points, ends: tuple[Points, Points], by_d: FloatArray, by_l0: FloatArray, acts: FloatArray
) -> FloatArray:
    """Return derivatives of an end's nodal forces by both ends' coordinates, s and l0, shape (n, 12, 27)."""
    below, above = ends
    by = np.concatenate(
        (
            -(by_d[:, :, None, :] * below.N[:, None, :, None]).reshape(-1, 3, 12),
            (by_d[:, :, None, :] * above.N[:, None, :, None]).reshape(-1, 3, 12),
            -(by_d @ below.r1[:, :, None]),
            by_d @ above.r1[:, :, None],
            by_l0[:, :, None],
        ),
        axis=2,
    )
    return (on.N[:, :, None, None] * (by * acts[:, None])[:, None, :, :]).reshape(-1, 12, 27)
