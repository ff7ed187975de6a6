"""The force of a tensioning device that is a spring, with what its travel takes from it added back."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.controls.control import Measure

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Sprung:
    """T + k p: constant for a spring that pulls an end outwards by p with the force T = T0 - k (p - p0).

    Parameters
    ----------
    tension : Measure
        The tensions T [N].
    travel : IntArray, shape (n,)
        Indices of the travels p [m].
    stiffness : FloatArray, shape (n,)
        Stiffness k of the springs [N/m]; 0 for weights and hydraulic devices.
    """

    tension: Measure
    travel: IntArray
    stiffness: FloatArray

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return T + k p [N]."""
        return self.tension.value(t, z) + self.stiffness * z[self.travel]

    def columns(self) -> IntArray:
        """Return those of the tensions, then the travels."""
        return np.concatenate((self.tension.columns(), self.travel[:, None]), axis=1)

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return the gradients of the tensions, then k."""
        return np.concatenate((self.tension.gradient(t, z), self.stiffness[:, None]), axis=1)

    def relocate(self, z: FloatArray) -> Sprung | None:
        """Return the measure in the elements that fit z, or None."""
        tension = self.tension.relocate(z)
        return None if tension is None else replace(self, tension=tension)
