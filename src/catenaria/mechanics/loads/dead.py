"""Dead loads: forces on the unknowns that do not depend on where these are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class DeadLoads:
    """Forces that keep size and direction: wind on a line as it stands, ice, a push at a point of a wire.

    Parameters
    ----------
    force : FloatArray, shape (n,)
        Generalised force on every unknown [N, N m].
    """

    force: FloatArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Subtract the force from f."""
        f -= self.force

    def pattern(self) -> Pattern:
        """Return no entries."""
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return no entries."""
        return np.empty(0)
