"""The height of points of wires above a track that may be canted."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.carrier import Carrier

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class TrackHeight:
    """The distance u . (r(s) - P) of points of wires from planes, such as that of the rails.

    Parameters
    ----------
    carrier : Carrier
        The wires.
    s : IntArray, shape (n,)
        Indices of the points' sliding coordinates.
    element : IntArray, shape (n,)
        Element in which each point is: discrete state.
    P : FloatArray, shape (n, 3)
        The middle of the track at each point [m].
    up : FloatArray, shape (n, 3)
        Unit normals u of the track.
    """

    carrier: Carrier
    s: IntArray
    element: IntArray
    P: FloatArray
    up: FloatArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return the heights [m]."""
        return np.einsum("ni,ni->n", self.up, self.carrier.evaluate(z, z[self.s], self.element).r - self.P)

    def columns(self) -> IntArray:
        """Return the coordinates of the element, then the sliding coordinate."""
        ends = (self.carrier.nodes[self.element], self.carrier.nodes[self.element + 1])
        return np.concatenate((*ends, self.s[:, None]), axis=1)

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return N u and u . r'."""
        point = self.carrier.evaluate(z, z[self.s], self.element)
        by_q = (point.N[:, :, None] * self.up[:, None, :]).reshape(-1, 12)
        return np.concatenate((by_q, np.einsum("ni,ni->n", self.up, point.r1)[:, None]), axis=1)

    def relocate(self, z: FloatArray) -> TrackHeight | None:
        """Return the measure in the elements that fit z, or None."""
        element = self.carrier.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
