"""A sketch of a line, not to scale: supports, spans, wires and droppers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from catenaria.line import Line
from catenaria.results import FormResult

_WIDTH, _MARGIN = 1000.0, 36.0
_SPANS = 8  # beside each other
_TOP, _AUXILIARY, _CONTACT, _GROUND = 24.0, 66.0, 84.0, 112.0


@dataclass(frozen=True)
class Mast:
    """A support: where it is drawn, its name, and how it holds the contact wire."""

    x: float
    name: str
    holds: bool
    arm: bool
    stitch: bool


@dataclass(frozen=True)
class Bay:
    """A span: where it is drawn, two lines written below it, places and upper ends of its droppers."""

    x0: float
    x1: float
    length: str
    count: str
    droppers: tuple[tuple[float, float], ...]
    upper_droppers: tuple[tuple[float, float], ...]

    @property
    def middle(self) -> float:
        """Where its label stands."""
        return 0.5 * (self.x0 + self.x1)


@dataclass(frozen=True)
class Row:
    """Some spans beside each other."""

    masts: tuple[Mast, ...]
    bays: tuple[Bay, ...]


@dataclass(frozen=True)
class Sketch:
    """Rows of spans, and the heights at which wires are drawn."""

    rows: tuple[Row, ...]
    auxiliary: bool
    second: bool
    width: float = _WIDTH
    top: float = _TOP
    auxiliary_y: float = _AUXILIARY
    contact: float = _CONTACT
    ground: float = _GROUND
    height: float = _GROUND + 36.0


def sketch(result: FormResult, line: Line) -> Sketch:
    """Return what to draw of a line."""
    count = len(line.spans)
    rows = -(-count // _SPANS)
    each = -(-count // rows)
    return Sketch(
        rows=tuple(
            _row(result, line, first, min(first + each, count), each) for first in range(0, count, each)
        ),
        auxiliary=line.auxiliary_messenger is not None,
        second=line.second_contact_wire is not None,
    )


def _row(result: FormResult, line: Line, first: int, end: int, most: int) -> Row:
    x = np.array(line.support_x[first : end + 1])
    share = (end - first) / most  # the last row may have fewer spans
    scale = share * (_WIDTH - 2.0 * _MARGIN) / (x[-1] - x[0])
    at = (_MARGIN + scale * (x - x[0])).tolist()
    stitched = line.stitched_supports
    masts = tuple(
        Mast(
            x=at[i - first],
            name=line.supports[i].name,
            holds=(held := line.supports[i].contact_wire) is not None,
            arm=held is not None and held.arm is not None,
            stitch=i in stitched,
        )
        for i in range(first, end + 1)
    )
    bays = tuple(_bay(result, line, k, at[k - first], at[k - first + 1]) for k in range(first, end))
    return Row(masts, bays)


def _bay(result: FormResult, line: Line, span: int, x0: float, x1: float) -> Bay:
    droppers, start, length = result.droppers, line.support_x[span], line.spans[span].length
    own = np.flatnonzero(droppers.span == span + 1)
    roles = {wire.name: wire.role for wire in result.wires}
    lower = [i for i in own if roles[droppers.lower_wire[i]] == "contact wire"]
    upper = [i for i in own if roles[droppers.lower_wire[i]] != "contact wire"]
    compound = line.auxiliary_messenger is not None

    def place(i: int, level: bool) -> tuple[float, float]:
        xi = float(droppers.x[i] - start) / length
        return x0 + xi * (x1 - x0), _AUXILIARY if level else messenger_y(xi)

    count = len({round(float(droppers.x[i]), 3) for i in lower})
    named = f"{len(upper)} + {count} droppers" if compound else f"{count} dropper{'s' * (count != 1)}"
    return Bay(
        x0,
        x1,
        f"{length:g} m",
        named,
        tuple(place(int(i), compound) for i in lower),
        tuple(place(int(i), False) for i in upper),
    )


def messenger_y(xi: float) -> float:
    """Return the height at which the messenger wire is drawn at a share of a span.

    Examples
    --------
    >>> messenger_y(0.0), messenger_y(0.5), messenger_y(1.0)
    (24.0, 52.0, 24.0)
    """
    return _TOP + 112.0 * xi * (1.0 - xi)
