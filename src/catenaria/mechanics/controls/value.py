"""An unknown itself as what is measured."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Value:
    """The values of unknowns: a force component to be met, a length to be reached.

    Parameters
    ----------
    index : IntArray, shape (n,)
        Indices of the unknowns.
    """

    index: IntArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return the unknowns."""
        return z[self.index]

    def columns(self) -> IntArray:
        """Return their indices."""
        return self.index[:, None]

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return 1."""
        return np.ones((self.index.size, 1))

    def relocate(self, z: FloatArray) -> None:
        """Return None: there is no discrete state."""
        return
