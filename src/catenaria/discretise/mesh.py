"""Graded meshes: short elements where a wire bends, long ones between.

A taut wire bends within a few lengths sqrt(EJ/T) of every support and clamp (0.14 m here) and is a string
elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError

FloatArray = NDArray[np.float64]

_REACH = 0.475  # of the way to the next centre, up to which fine distances go


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
    return _divided(_graded(length, middle, np.asarray(grading.fine)), grading)


def _graded(length: float, middle: FloatArray, fine: FloatArray) -> FloatArray:
    """Return ends, centres and fine distances beside the centres, which end before the next one is nearer."""
    primary = np.unique(np.concatenate(([0.0], middle, [length])))
    left, right = primary[:-1, None], primary[1:, None]
    fits, refined = fine < _REACH * (right - left), np.isin(primary, middle)
    behind = (left + fine)[fits & refined[:-1, None]]
    before = (right - fine)[fits & refined[1:, None]]
    return np.sort(np.concatenate((primary, behind, before)))


def _divided(nodes: FloatArray, grading: Grading) -> FloatArray:
    """Return the nodes with equal parts between them."""
    gap = np.diff(nodes)
    count = grading.refine * np.maximum(1, np.ceil(gap / grading.largest - 1e-9).astype(np.int64))
    first = np.cumsum(count) - count
    part = np.arange(int(count.sum())) - np.repeat(first, count)
    knots = np.repeat(nodes[:-1], count) + np.repeat(gap / count, count) * part
    return np.concatenate((knots, nodes[-1:]))
