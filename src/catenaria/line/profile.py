"""The wanted profile of the contact wire: level, graded, with pre-sag, or dropper by dropper."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from catenaria.line.line import Line
    from catenaria.line.span import Span


def held_heights(line: Line) -> tuple[tuple[float, float], ...]:
    """Return chainage and height [m] of the contact wire at every support that holds it."""
    places = zip(line.support_x, line.supports, strict=False)
    return tuple((x, support.contact_wire.height) for x, support in places if support.contact_wire)


def wanted_heights(line: Line) -> tuple[tuple[float, ...], ...]:
    """Return the wanted heights of the contact wire at the droppers of every span [m].

    Notes
    -----
    A pre-sag D lowers them by the parabola D (1 - ((x - m)/(m - a))^2), which is zero at the first dropper,
    at a, and at the last one, with m in the middle between the two.
    """
    held = held_heights(line)
    return tuple(
        lowered(span, _heights(span, start, held))
        for start, span in zip(line.support_x, line.spans, strict=False)
    )


def _heights(span: Span, start: float, held: Sequence[tuple[float, float]]) -> tuple[float, ...]:
    """Return the heights before a pre-sag: those that are given, or on the line between supports."""
    if span.contact_wire_height is None:
        return tuple(between(held, start + x) for x in span.droppers.x)
    if isinstance(span.contact_wire_height, tuple):
        return span.contact_wire_height
    return (span.contact_wire_height,) * len(span.droppers.x)


def lowered(span: Span, heights: tuple[float, ...]) -> tuple[float, ...]:
    """Return heights at the droppers of a span less its pre-sag [m].

    Examples
    --------
    >>> from catenaria.line.dropper import Droppers
    >>> from catenaria.line.span import Span
    >>> span = Span(length=65, droppers=Droppers(positions=(5, 32.5, 60)), pre_sag=0.055)
    >>> lowered(span, (5.5, 5.5, 5.5))
    (5.5, 5.445, 5.5)
    """
    if span.sag == 0.0 or len(span.droppers.x) < 3:
        return heights
    first, last = span.droppers.x[0], span.droppers.x[-1]
    middle, half = (first + last) / 2.0, (last - first) / 2.0
    return tuple(
        height - span.sag * (1.0 - ((x - middle) / half) ** 2)
        for x, height in zip(span.droppers.x, heights, strict=False)
    )


def between(points: Sequence[tuple[float, float]], x: float) -> float:
    """Interpolate; NaN, which compares with nothing, where a neighbour is missing or unknown.

    Examples
    --------
    >>> between([(0.0, 5.0), (50.0, 6.0)], 25.0), between([(0.0, 5.0), (50.0, 6.0)], 60.0)
    (5.5, nan)
    """
    for (x0, z0), (x1, z1) in pairwise(points):
        if x0 <= x <= x1:
            return z0 + (z1 - z0) * (x - x0) / (x1 - x0)
    return math.nan
