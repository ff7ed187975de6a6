"""Wires held across the track: a bracket's or an arm's clamp that moves freely along the track."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.carrier import Carrier
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

FULL = Ramp(0.0)


@dataclass(frozen=True)
class HeldAcross:
    r"""Points of wires held in the vertical planes across the track, at a height or with a vertical force.

    Parameters
    ----------
    carrier : Carrier
        The wires that are held.
    s : IntArray, shape (n,)
        Indices of the material coordinates of the clamps [m]; their rows belong to whatever else says where
        along the track the clamps are.
    multipliers : IntArray, shape (n, 2)
        Indices of (la_h, la_v): force of the wire on its support, to the left and upwards [N].
    element : IntArray, shape (n,)
        Element in which each clamp is: discrete state, changed by `relocate` only.
    X : FloatArray, shape (n, 3)
        Where the wires are held [m].
    along : FloatArray, shape (n, 3)
        Horizontal unit vectors along the track.
    lift : FloatArray, shape (n,)
        Upward force of the support on the wire [N] where it is given instead of the height, NaN where the
        height is held.
    ramp : Ramp
        Brings the given forces in, as gravity's does weights.

    Notes
    -----
    With the horizontal h = e_z x t to the left of the track's direction t,

    .. math:: h\cdot(r(s) - X) = 0,\qquad e_z\cdot(r(s) - X) = 0\quad\text{or}\quad \lambda_v = -F,

    and the wire pulls its support by la_h h + la_v e_z: nothing acts along the track.
    """

    carrier: Carrier
    s: IntArray
    multipliers: IntArray
    element: IntArray
    X: FloatArray
    along: FloatArray
    lift: FloatArray
    ramp: Ramp = FULL

    def _left(self) -> FloatArray:
        """Return the two components of h that are not zero, shape (n, 2)."""
        return np.column_stack((-self.along[:, 1], self.along[:, 0]))

    def _force(self, z: FloatArray) -> FloatArray:
        """Return the force of the wire on its support [N], shape (n, 3)."""
        la = z[self.multipliers]
        return np.column_stack((la[:, :1] * self._left(), la[:, 1]))

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints or given forces, and constraint forces to f."""
        z = state.z
        point = self.carrier.evaluate(z, z[self.s], self.element)
        off, held = point.r - self.X, np.isnan(self.lift)
        aside, up = self.multipliers.T
        f[aside] += np.einsum("ni,ni->n", self._left(), off[:, :2])
        f[up] += np.where(held, off[:, 2], z[up] + self.ramp(state.t) * np.where(held, 0.0, self.lift))
        np.add.at(f, point.dofs, point.N[:, :, None] * self._force(z)[:, None, :])

    def pattern(self) -> Pattern:
        """Return the entries of both rows' derivatives and of the force on the wire by la and s."""
        dofs = np.concatenate(
            (self.carrier.nodes[self.element], self.carrier.nodes[self.element + 1]), axis=1
        )
        flat, high, held = np.delete(dofs, np.s_[2::3], axis=1), dofs[:, 2::3], np.isnan(self.lift)
        aside, up = self.multipliers.T
        aside8, up4 = np.repeat(aside[:, None], 8, axis=1), np.repeat(up[:, None], 4, axis=1)
        s12 = np.repeat(self.s[:, None], 12, axis=1)
        rows = (aside8, aside, up4[held], up[held], up[~held], flat, high, dofs)
        columns = (flat, self.s, high[held], self.s[held], up[~held], aside8, up4, s12)
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N h, h . r', N, z', 1, N h, N and N' times the force at those entries."""
        z = state.z
        point, left, held = (
            self.carrier.evaluate(z, z[self.s], self.element),
            self._left(),
            np.isnan(self.lift),
        )
        N_h = (point.N[:, :, None] * left[:, None, :]).ravel()
        parts = (
            N_h,
            np.einsum("ni,ni->n", left, point.r1[:, :2]),
            point.N[held].ravel(),
            point.r1[held, 2],
            np.ones(np.count_nonzero(~held)),
            N_h,
            point.N.ravel(),
            (point.N1[:, :, None] * self._force(z)[:, None, :]).ravel(),
        )
        return np.concatenate(parts)

    def relocate(self, z: FloatArray) -> HeldAcross | None:
        """Return the clamps in the elements that fit z, or None if all are."""
        element = self.carrier.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
