"""Fewer points for figures, without losing any peak."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

INTERVALS = 600  # of a figure


def thinned(x: FloatArray, values: tuple[FloatArray, ...], most: int = INTERVALS) -> IntArray:
    """Return the indices of the points to draw.

    Parameters
    ----------
    x : FloatArray
        Where the points are.
    values : tuple of FloatArray
        What is drawn over x; its largest and smallest value in every interval are kept.
    most : int
        Number of intervals; lines of fewer points are drawn whole.

    Examples
    --------
    >>> x = np.linspace(0.0, 1.0, 10_001)
    >>> peak = np.where(np.arange(x.size) == 5_003, 1.0, 0.0)
    >>> kept = thinned(x, (peak,), most=100)
    >>> kept.size < 400, peak[kept].max()
    (True, np.float64(1.0))
    """
    if x.size <= most:
        return np.arange(x.size)
    edges: FloatArray = np.linspace(float(x.min()), float(x.max()), most + 1)
    interval = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, most - 1)
    order = np.argsort(interval, kind="stable")
    starts = np.flatnonzero(np.diff(interval[order], prepend=-1))
    length = np.diff(starts, append=x.size)
    kept = [np.array([0, x.size - 1])]
    for y in (x, *values):
        sorted_y = y[order]
        for extreme in (np.minimum, np.maximum):
            peaks = np.flatnonzero(sorted_y == np.repeat(extreme.reduceat(sorted_y, starts), length))
            _, first = np.unique(interval[order[peaks]], return_index=True)
            kept.append(order[peaks[first]])
    return np.unique(np.concatenate(kept))


def simplified(x: FloatArray, y: FloatArray, tolerance: float, least: int = 100) -> IntArray:
    """Return the indices of points between which straight lines are off by no more than a tolerance.

    Parameters
    ----------
    x : FloatArray
        Where the points are, ascending.
    y : FloatArray
        What is drawn over x.
    tolerance : float
        How far a point may be from the line that is drawn, in units of y.
    least : int
        Number of points, at about equal distances, that are always there: one points at points. Lines of
        fewer points are drawn whole.

    Notes
    -----
    Where a line is off, its worst point is added, in all lines at once (Douglas & Peucker 1973).

    Examples
    --------
    >>> x = np.linspace(0.0, 1.0, 1001)
    >>> kept = simplified(x, x**2, 1e-3)
    >>> kept.size < 120, float(np.abs(np.interp(x, x[kept], x[kept] ** 2) - x**2).max()) <= 1e-3
    (True, True)
    """
    if x.size <= least:
        return np.arange(x.size)
    kept = np.unique(np.linspace(0, x.size - 1, least).astype(np.intp))
    while True:
        off = np.abs(y - np.interp(x, x[kept], y[kept]))
        worst = np.maximum.reduceat(off, kept[:-1])
        worst[worst <= tolerance] = np.inf
        added = np.flatnonzero(off[:-1] == np.repeat(worst, np.diff(kept)))
        if not added.size:
            return kept
        kept = np.union1d(kept, added)
