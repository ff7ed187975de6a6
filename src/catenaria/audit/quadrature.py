"""Clenshaw-Curtis quadrature: the audit's own, as unlike the elements' Gauss rule as a good rule can be."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@cache
def clenshaw_curtis(intervals: int) -> tuple[FloatArray, FloatArray]:
    r"""Return points and weights on [0, 1], both ends included.

    Parameters
    ----------
    intervals : int
        Even number n of intervals; n + 1 points integrate polynomials of degree n + 1 exactly.

    Returns
    -------
    points, weights : FloatArray, shape (intervals + 1,)
        Read-only: they are made once.

    Notes
    -----
    The interpolating polynomial in the points :math:`\cos(k\pi/n)` is integrated term by term:

    .. math:: w_k = \frac{c_k}{n}\left(1 - \sum_{j=1}^{n/2} \frac{b_j}{4j^2-1}\cos\frac{2jk\pi}{n}\right),

    with :math:`c_k = 1` at the ends and 2 between, :math:`b_{n/2} = 1` and 2 else, on [-1, 1].

    References
    ----------
    J. Waldvogel, Fast construction of the Fejer and Clenshaw-Curtis quadrature rules, BIT 46 (2006) 195-202.

    Examples
    --------
    >>> points, weights = clenshaw_curtis(4)
    >>> round(float(weights @ points**4), 12)
    0.2
    """
    k = np.arange(intervals + 1)
    j = np.arange(1, intervals // 2 + 1)
    b = np.where(2 * j == intervals, 1.0, 2.0) / (4.0 * j * j - 1.0)
    c = np.where((k == 0) | (k == intervals), 1.0, 2.0) / intervals
    w = c * (1.0 - np.cos(2.0 * np.pi / intervals * np.outer(k, j)) @ b)
    points, weights = 0.5 - 0.5 * np.cos(np.pi * k / intervals), 0.5 * w
    for shared in (points, weights):
        shared.flags.writeable = False
    return points, weights
