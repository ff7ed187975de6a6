"""Guides: a point of a wire that stays in the plane across the track at its place along it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.carrier import Carrier
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Guides:
    r"""Clamps that are wherever a wire crosses given planes; they exert no force.

    Parameters
    ----------
    carrier : Carrier
        The wires.
    s : IntArray, shape (n,)
        Indices of the sliding coordinates: material coordinates of the clamps [m].
    element : IntArray, shape (n,)
        Element in which each clamp is: discrete state, changed by `relocate` only.
    P : FloatArray, shape (n, 3)
        A point of each plane [m].
    along : FloatArray, shape (n, 3)
        Unit normal t of each plane: the horizontal direction of the track.

    Notes
    -----
    .. math:: t \cdot (r(s) - P) = 0 .

    The row of s; regular where the wire crosses the plane, t . r' != 0. The equation defines s, as in
    `GuidedJoints`, and nothing in the equilibrium of the wire belongs to it: what is clamped there, a bar or
    a steady arm, has no force along the track because both of its ends are in the plane.
    """

    carrier: Carrier
    s: IntArray
    element: IntArray
    P: FloatArray
    along: FloatArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add t . (r(s) - P) to f."""
        r = self.carrier.evaluate(state.z, state.z[self.s], self.element).r
        f[self.s] += np.einsum("ni,ni->n", self.along, r - self.P)

    def _coupled(self) -> NDArray[np.bool_]:
        """Mask of the nodal coordinates in the equation, (n, 4, 3): on a straight track those along x."""
        return np.repeat((self.along != 0.0)[:, None, :], 4, axis=1)

    def pattern(self) -> Pattern:
        """Return the entries by the nodal coordinates and by s."""
        ends = (self.carrier.nodes[self.element], self.carrier.nodes[self.element + 1])
        coupled = self._coupled()
        dofs = np.concatenate(ends, axis=1).reshape(coupled.shape)
        rows = np.broadcast_to(self.s[:, None, None], coupled.shape)
        return np.concatenate((rows[coupled], self.s)), np.concatenate((dofs[coupled], self.s))

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N t and t . r' at those entries."""
        point = self.carrier.evaluate(state.z, state.z[self.s], self.element)
        by_q = (point.N[:, :, None] * self.along[:, None, :])[self._coupled()]
        return np.concatenate((by_q, np.einsum("ni,ni->n", self.along, point.r1)))

    def relocate(self, z: FloatArray) -> Guides | None:
        """Return the guides in the elements that fit z, or None if all are."""
        element = self.carrier.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
