"""The balance of forces on a dropper that is modelled as two halves in one system, eq. (23)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.loads.gravity import Ramp

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class ForceBalance:
    """T_md - T_cd - G of eq. (23), with both forces from joints of the same system.

    Parameters
    ----------
    force : IntArray, shape (n, 2)
        Indices of the vertical multipliers of the joints at the upper and the lower end.
    sign : FloatArray, shape (n, 2)
        1 where the multiplier is the force on the dropper, -1 where it is the force of the dropper.
    end : IntArray, shape (n, 2)
        Indices of the vertical coordinates of the upper and the lower end.
    rhoA, mass : FloatArray, shape (n,)
        Mass of the dropper per length [kg/m], and of what else hangs at its ends [kg].
    g, ramp
        Gravity [m/s^2] and its ramp.

    Notes
    -----
    The sum of the vertical forces on one dropper that reaches from end to end. `DropperForce` is the same
    with the lower force and end known from an earlier step.
    """

    force: IntArray
    sign: FloatArray
    end: IntArray
    rhoA: FloatArray
    mass: FloatArray
    g: float
    ramp: Ramp

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return T_md - T_cd - G [N]."""
        upper, lower = z[self.end].T
        weight = self.g * self.ramp(t) * (self.rhoA * (upper - lower) + self.mass)
        return np.sum(self.sign * z[self.force], axis=1) - weight

    def columns(self) -> IntArray:
        """Return the two forces, then the two heights."""
        return np.concatenate((self.force, self.end), axis=1)

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return the signs, and -/+ g rhoA."""
        by_height = -self.g * self.ramp(t) * self.rhoA[:, None] * np.array([1.0, -1.0])
        return np.concatenate((self.sign, by_height), axis=1)

    def relocate(self, z: FloatArray) -> None:
        """Return None: there is no discrete state."""
        return
