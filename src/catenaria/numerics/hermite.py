"""Cubic Hermite shape functions of the cable element, eqs. (2)-(5), and their derivatives by arc length.

The order of the four columns is that of eq. (2): N1, N3, N2, N4, which belong to r_i, r_i', r_j, r_j'.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def shape(s: FloatArray, L: FloatArray) -> FloatArray:
    """Return N1, N3, N2, N4 of eqs. (3)-(4).

    Parameters
    ----------
    s : FloatArray, shape (n,)
        Dimensionless coordinate of eq. (5), -1 at node i, 1 at node j.
    L : FloatArray, shape (n,) or broadcastable
        Undeformed length [m].

    Returns
    -------
    FloatArray, shape (n, 4)
        The second and fourth column in metres, the others dimensionless.

    Examples
    --------
    >>> shape(np.array([-1.0, 1.0]), np.array([2.0]))
    array([[ 1.,  0.,  0., -0.],
           [ 0.,  0.,  1.,  0.]])
    """
    m, p = s - 1.0, s + 1.0
    columns = (m * m * (s + 2.0) / 4.0, L / 8.0 * m * m * p, p * p * (2.0 - s) / 4.0, L / 8.0 * p * p * m)
    return np.stack(columns, axis=-1)


def shape_1(s: FloatArray, L: FloatArray) -> FloatArray:
    """Return the first derivatives by arc length l, with ds/dl = 2/L of eq. (5); shape (n, 4)."""
    m, p = s - 1.0, s + 1.0
    slope = 1.5 / L * m * p
    columns = (slope, 0.25 * m * (3.0 * s + 1.0), -slope, 0.25 * p * (3.0 * s - 1.0))
    return np.stack(columns, axis=-1)


def shape_2(s: FloatArray, L: FloatArray) -> FloatArray:
    """Return the second derivatives by arc length l; shape (n, 4)."""
    bend = 6.0 * s / (L * L)
    columns = (bend, (3.0 * s - 1.0) / L, -bend, (3.0 * s + 1.0) / L)
    return np.stack(columns, axis=-1)
