"""Parameters with given values: what a control has found, held fast."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Given:
    """A batch of parameters p = p*.

    Parameters
    ----------
    parameter : IntArray, shape (n,)
        Indices of the parameters.
    value : FloatArray, shape (n,)
        Their values [m].
    """

    parameter: IntArray
    value: FloatArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add p - p* to f."""
        f[self.parameter] += state.z[self.parameter] - self.value

    def pattern(self) -> Pattern:
        """Return the diagonal entries."""
        return self.parameter, self.parameter

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return 1."""
        return np.ones(self.parameter.size)
