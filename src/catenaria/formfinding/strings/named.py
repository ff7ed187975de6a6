"""Droppers by the names that they have in results."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


def named(span: IntArray, which: BoolArray) -> str:
    """Return some of the droppers of a line by their numbers within spans.

    Parameters
    ----------
    span : IntArray, shape (n,)
        Number of the span of each dropper, ascending.
    which : BoolArray, shape (n,)
        Which of them are meant.

    Examples
    --------
    >>> named(np.array([1, 1, 2, 2]), np.array([True, True, False, True]))
    '1, 2 in span 1; 2 in span 2'
    """
    number = np.arange(span.size) - np.searchsorted(span, span) + 1
    return "; ".join(
        ", ".join(str(n) for n in number[which & (span == i)].tolist()) + f" in span {i}"
        for i in np.unique(span[which]).tolist()
    )
