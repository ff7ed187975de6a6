"""Compiled summation of repeated entries."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.kernels.compile import compiled


@compiled
def sum_into(values: NDArray[np.float64], place: NDArray[np.int64], size: int) -> NDArray[np.float64]:
    """Return the array of the given size in which every value is added at its place."""
    total = np.zeros(size)
    for k in range(values.size):
        total[place[k]] += values[k]
    return total
