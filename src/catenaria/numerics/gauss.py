"""Gauss-Legendre quadrature on the reference interval of the cable element, s in [-1, 1] of eq. (5)."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@cache
def gauss_legendre(count: int) -> tuple[FloatArray, FloatArray]:
    """Return points and weights that integrate polynomials of degree 2 count - 1 exactly.

    Parameters
    ----------
    count : int
        Number of points, at least 1.

    Returns
    -------
    points, weights : FloatArray, shape (count,)
        Points in (-1, 1), ascending, and weights that add up to 2; read-only.

    Raises
    ------
    ValueError
        If `count` is below 1.

    Examples
    --------
    >>> points, weights = gauss_legendre(3)
    >>> round(float(weights @ points**4), 12) == round(2 / 5, 12)
    True
    """
    points, weights = np.polynomial.legendre.leggauss(count)
    points.setflags(write=False)
    weights.setflags(write=False)
    return points, weights
