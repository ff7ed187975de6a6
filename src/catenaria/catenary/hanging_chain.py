"""A chain of given length between two points: the inextensible catenary."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError

FloatArray = NDArray[np.float64]


def hanging_chain(
    s: FloatArray, span: float, rise: float, length: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return the shape of a chain that hangs between two points.

    Parameters
    ----------
    s : FloatArray, shape (n,)
        Arc length from the start [m].
    span, rise : float
        Horizontal and vertical distance of the end from the start [m].
    length : float
        Length of the chain [m].

    Returns
    -------
    x, z, dx, dz : FloatArray, shape (n,)
        Horizontal and vertical distance from the start [m], and their derivatives by s.

    Raises
    ------
    InconsistentInputError
        If the chain is not longer than the distance of the points, or these are above each other.

    Notes
    -----
    With a = H/w the chain is z = a cosh((x - x0)/a) + c, and its arc length from the lowest point is
    sigma = a sinh((x - x0)/a). Length and rise give sinh(u)/u = sqrt(length^2 - rise^2)/span with
    u = span/(2 a), and artanh(rise/length) = (span/2 - x0)/a (Irvine 1981, Cable Structures, section 1.2).

    Examples
    --------
    >>> x, z, _, _ = hanging_chain(np.array([5.0]), span=8.0, rise=0.0, length=10.0)
    >>> round(float(x[0]), 9), round(float(z[0]), 4)
    (4.0, -2.6544)
    """
    if not (span > 0.0 and length > np.hypot(span, rise)):
        raise InconsistentInputError(
            "a chain hangs only if it is longer than a distance that is not vertical"
        )
    a = 0.5 * span / _half_angle(np.sqrt(length**2 - rise**2) / span)
    lowest = 0.5 * span - a * np.arctanh(rise / length)
    start = -a * np.sinh(lowest / a)
    sigma = start + s
    depth = np.hypot(a, sigma)
    return lowest + a * np.arcsinh(sigma / a), depth - np.hypot(a, start), a / depth, sigma / depth


def _half_angle(ratio: float) -> float:
    """Return the positive root u of sinh(u)/u = ratio by Newton's method.

    f = sinh(u) - ratio u is convex, so from a start beyond the root the iterates descend to it; both
    sqrt(6 (ratio - 1)) and 2 log(2 ratio) + 2 are beyond it.
    """
    u, step = min(np.sqrt(6.0 * (ratio - 1.0)), 2.0 * np.log(2.0 * ratio) + 2.0), np.inf
    while step > 1e-15 * u:
        step = (np.sinh(u) - ratio * u) / (np.cosh(u) - ratio)
        u -= step
    return float(u)
