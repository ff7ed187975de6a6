"""Steady arms: rigid bars from fixed hinges to the wire."""

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


@dataclass(frozen=True)
class Arms:
    r"""Rigid bars hinged at fixed points and at wires, with their weight.

    Parameters
    ----------
    carrier : Carrier
        The wires that the arms hold.
    s : IntArray, shape (n,)
        Indices of the material coordinates of the clamps [m]; their rows belong to whatever else says where
        along the track the clamps are.
    density : IntArray, shape (n,)
        Indices of the force densities q: tension of the arm over its length [N/m].
    element : IntArray, shape (n,)
        Element in which each clamp is: discrete state, changed by `relocate` only.
    hinge : FloatArray, shape (n, 3)
        Fixed ends H of the arms [m].
    length : FloatArray, shape (n,)
        Lengths L [m].
    mass : FloatArray, shape (n,)
        Masses m [kg].
    g : float
        Gravity [m/s^2].
    ramp : Ramp
        How the weight grows in time.

    Notes
    -----
    With d = r(s) - H, the row of q holds the length, and the wire feels the pull of the arm and half of its
    weight, by the balance of moments about H:

    .. math:: \frac{d\cdot d - L^2}{2L} = 0,\qquad F = -q\,d - \tfrac12 m g\,e_z.
    """

    carrier: Carrier
    s: IntArray
    density: IntArray
    element: IntArray
    hinge: FloatArray
    length: FloatArray
    mass: FloatArray
    g: float
    ramp: Ramp

    def loads(self, t: float, z: FloatArray) -> FloatArray:
        """Return the forces of the arms on their wires [N], shape (n, 3)."""
        return self._force(t, z, self._point(z).r - self.hinge)

    def _point(self, z: FloatArray) -> Points:
        return self.carrier.evaluate(z, z[self.s], self.element)

    def _force(self, t: float, z: FloatArray, d: FloatArray) -> FloatArray:
        half = 0.5 * self.g * self.ramp(t) * self.mass
        return -z[self.density, None] * d - half[:, None] * _VERTICAL

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add the equations of the lengths, pulls and weights to f."""
        z = state.z
        point = self._point(z)
        d = point.r - self.hinge
        f[self.density] += (np.einsum("ni,ni->n", d, d) - self.length**2) / (2.0 * self.length)
        np.subtract.at(f, point.dofs, point.N[:, :, None] * self._force(state.t, z, d)[:, None, :])

    def pattern(self) -> Pattern:
        """Return the entries of forces by coordinates, q and s, and of lengths by coordinates and s."""
        dofs = np.concatenate(
            (self.carrier.nodes[self.element], self.carrier.nodes[self.element + 1]), axis=1
        )
        stiff_rows = np.repeat(dofs, 4, axis=1)  # a component of force depends on the same one of d
        stiff_columns = np.tile(dofs.reshape(-1, 4, 3).transpose(0, 2, 1), (1, 4, 1))
        q12, s12 = np.repeat(self.density[:, None], 12, axis=1), np.repeat(self.s[:, None], 12, axis=1)
        rows = (stiff_rows, dofs, dofs, q12, self.density)
        columns = (stiff_columns, q12, s12, dofs, self.s)
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return q N N, N d, N q r' - N' F, N d/L and d . r'/L at those entries."""
        z = state.z
        point = self._point(z)
        d, q, N = point.r - self.hinge, z[self.density], point.N
        stiff = np.repeat(q[:, None, None] * N[:, :, None] * N[:, None, :], 3, axis=1)
        N_d = N[:, :, None] * d[:, None, :]
        shifted = N[:, :, None] * (q[:, None] * point.r1)[:, None, :]
        by_s = shifted - point.N1[:, :, None] * self._force(state.t, z, d)[:, None, :]
        turned = np.einsum("ni,ni->n", d, point.r1) / self.length
        parts = (stiff, N_d, by_s, N_d / self.length[:, None, None], turned)
        return np.concatenate([part.ravel() for part in parts])

    def relocate(self, z: FloatArray) -> Arms | None:
        """Return the arms with their clamps in the elements that fit z, or None if they are."""
        element = self.carrier.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
