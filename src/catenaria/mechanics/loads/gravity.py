"""Gravity with the smooth ramp (31)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State
from catenaria.numerics.smoothstep import smoothstep

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Ramp:
    """The factor (t/t1)^2 (3 - 2 t/t1) of eq. (31): 0 at t = 0, 1 from t1 on.

    Parameters
    ----------
    duration : float
        t1 [s]; 0 means that the factor is 1 from the start.

    Raises
    ------
    InconsistentInputError
        If the duration is negative or not finite.
    """

    duration: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.duration < np.inf:
            raise InconsistentInputError(
                f"a ramp needs a finite duration of at least 0 s, not {self.duration}"
            )

    def __call__(self, t: float) -> float:
        """Return the factor at time t."""
        return float(smoothstep(t / self.duration)) if self.duration > 0.0 else 1.0


@dataclass(frozen=True)
class Gravity:
    """Weight of all elements and point masses, eq. (17), brought in by the ramp (31).

    Parameters
    ----------
    weight : FloatArray, shape (n,)
        Generalised force per unit of g [kg], from `CableElements.weight` and `point_masses`.
    g : float
        Acceleration of gravity [m/s^2].
    ramp : Ramp
        Its growth in time.
    """

    weight: FloatArray
    g: float
    ramp: Ramp

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Subtract the weight from f."""
        f -= (self.g * self.ramp(state.t)) * self.weight

    def pattern(self) -> Pattern:
        """Return no entries: the load is dead."""
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return no entries."""
        return np.empty(0)
