"""What every method for strings ends with: a line of strings at rest, as plain numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class StringAtRest:
    """A string by some points on it, its two ends first and last.

    Attributes
    ----------
    s : FloatArray, shape (n,)
        Ascending material (unstressed) coordinates of the points, from the start [m].
    r : FloatArray, shape (n, 3)
        Their positions [m].
    force : FloatArray, shape (n, 3)
        Forces on the string there: of the tensioning devices at the ends, of supports and droppers with
        their clamps; nothing at other points [N]. The string's own weight is not among them.
    support, clamp : IntArray
        Which of the points are at supports, and at droppers.

    Notes
    -----
    That is all there is to a string: the tension at s is the sum of all forces and weights before s.
    """

    s: FloatArray
    r: FloatArray
    force: FloatArray
    support: IntArray
    clamp: IntArray


@dataclass(frozen=True)
class LineAtRest:
    """Two strings with their droppers.

    Attributes
    ----------
    contact, messenger : StringAtRest
        The wires.
    unstressed : FloatArray, shape (k,)
        Unstressed lengths of the droppers [m].
    """

    contact: StringAtRest
    messenger: StringAtRest
    unstressed: FloatArray
