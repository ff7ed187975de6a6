"""The force with which a tensioning device pulls in its own direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Pull:
    """-la . n at a held cable end: what is left of the reaction without the forces across the direction n.

    Parameters
    ----------
    multipliers : IntArray, shape (n, 3)
        Indices of the forces of the cable ends on the devices.
    direction : FloatArray, shape (n, 3)
        Unit vectors in which the devices pull.

    Notes
    -----
    A short tail beyond a sliding joint has to bear the moment that bends the cable there, by large forces
    across the cable. They are part of `ReactionTension`, and not of this measure.
    """

    multipliers: IntArray
    direction: FloatArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return the pulls [N]."""
        return -np.einsum("ni,ni->n", z[self.multipliers], self.direction)

    def columns(self) -> IntArray:
        """Return the multipliers."""
        return self.multipliers

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return -n."""
        return -self.direction

    def relocate(self, z: FloatArray) -> None:
        """Return None: there is no discrete state."""
        return
