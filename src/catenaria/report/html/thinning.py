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
