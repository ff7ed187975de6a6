"""Graded meshes: short elements where a wire bends, long ones between.

A taut wire bends within a few lengths sqrt(EJ/T) of every support and clamp (0.14 m here) and is a string
elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Grading:
    """How a wire is divided.

    Parameters
    ----------
    fine : tuple of float
        Distances from every support and clamp at which nodes stand [m].
    largest : float
        Longest element [m].
    refine : int
        Into how many equal parts every element is divided in the end.
    even : int, optional
        Number of equal elements of the whole wire instead, wherever supports and clamps come to lie.
    """

    fine: tuple[float, ...]
    largest: float
    refine: int = 1
    even: int | None = None


def graded_knots(length: float, centres: Sequence[float] | FloatArray, grading: Grading) -> FloatArray:
    """Return the material coordinates of all nodes of a wire.

    Parameters
    ----------
    length : float
        Unstressed length of the wire [m].
    centres : sequence of float
        Material coordinates that will lie under supports and clamps; each gets a node [m].
    grading : Grading
        Distances and sizes.

    Returns
    -------
    FloatArray
        From 0 to `length`, ascending.

    Raises
    ------
    InconsistentInputError
        If a centre lies outside the wire.

    Examples
    --------
    >>> graded_knots(10.0, [5.0], Grading(fine=(0.1, 0.3), largest=2.5))
    array([ 0.  ,  2.35,  4.7 ,  4.9 ,  5.  ,  5.1 ,  5.3 ,  7.65, 10.  ])
    """
    middle = np.unique(np.asarray(centres, dtype=np.float64))
    if middle.size and not (middle[0] >= 0.0 and middle[-1] <= length):
        raise InconsistentInputError("a support or clamp lies beyond the end of its wire")
    if grading.even is not None:
        return np.linspace(0.0, length, grading.even * grading.refine + 1)
    primary = np.unique(np.concatenate(([0.0], middle, [length])))
    knots = [0.0]
    refined = np.isin(primary, middle).tolist()
    for (left, fine_left), (right, fine_right) in pairwise(zip(primary.tolist(), refined, strict=True)):
        knots.extend(_between(left, right, fine_left, fine_right, grading))
    return np.array(knots)


def _between(left: float, right: float, fine_left: bool, fine_right: bool, grading: Grading) -> list[float]:
    """Return the nodes after `left` up to `right`; fine distances end before the middle."""
    half = 0.5 * (right - left)
    fine = [distance for distance in sorted(grading.fine) if distance < 0.95 * half]
    nodes = [
        left,
        *(left + d for d in fine if fine_left),
        *(right - d for d in reversed(fine) if fine_right),
        right,
    ]
    result: list[float] = []
    for a, b in pairwise(nodes):
        count = grading.refine * max(1, ceil((b - a) / grading.largest - 1e-9))
        result.extend(a + (b - a) * k / count for k in range(1, count))
        result.append(b)
    return result
