"""The cubic x^2 (3 - 2 x): rises from 0 to 1 with zero slope at both ends.

The paper uses it twice, for the velocity laws (19), (21) and for the gravity ramp (31).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def smoothstep(x: float | FloatArray) -> FloatArray:
    """Return x^2 (3 - 2 x) between 0 and 1, 0 below and 1 above.

    Examples
    --------
    >>> smoothstep(np.array([-1.0, 0.0, 0.5, 1.0, 2.0]))
    array([0. , 0. , 0.5, 1. , 1. ])
    """
    clipped = np.minimum(np.maximum(x, 0.0), 1.0)
    return clipped * clipped * (3.0 - 2.0 * clipped)


def smoothstep_slope(x: float | FloatArray) -> FloatArray:
    """Return the derivative 6 x (1 - x) between 0 and 1, 0 elsewhere."""
    clipped = np.minimum(np.maximum(x, 0.0), 1.0)
    return 6.0 * clipped * (1.0 - clipped)
