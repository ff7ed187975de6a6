"""Rounding to whole steps, halves upwards, as lengths are cut."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_DIGITS = 6  # of length by step: what is half a step within rounding errors is half a step


def rounded_half_up(length: FloatArray, step: float) -> FloatArray:
    """Return lengths rounded to whole steps, halves upwards.

    Examples
    --------
    >>> rounded_half_up(np.array([1.0024, 1.0025, 1.0075]), 0.005).tolist()
    [1.0, 1.005, 1.01]
    """
    return np.round(step * np.floor(np.round(length / step, _DIGITS) + 0.5), 12)
