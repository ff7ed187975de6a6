"""A result as a piece of HTML for notebooks: a sketch of its profile, its wires, and the verdicts."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from catenaria.api.summary import facts
from catenaria.results import FormResult, WireForm

FloatArray = NDArray[np.float64]

_WIDTH, _HEIGHT, _MARGIN = 720.0, 110.0, 6.0  # of the sketch [px]
_MOST_POINTS = 400  # of a wire in the sketch
_MOST_WIRES = 6  # in the table
_COLUMNS = ("wire", "tension [N]", "wanted [N]", "unstressed length [m]", "sag [mm]")
_TOLD = ("line", "droppers", "errors", "audit", "rebuild")


@dataclass(frozen=True)
class Frame:
    """Which part of chainage and height the sketch shows: all of the line.

    Attributes
    ----------
    start, end, low, high : float
        Limits of chainage and height [m].
    """

    start: float
    end: float
    low: float
    high: float

    @classmethod
    def around(cls, form: FormResult) -> Frame:
        """Return the frame of a result."""
        chainage = np.concatenate([wire.profile.chainage for wire in form.wires])
        height = np.concatenate([wire.profile.height for wire in form.wires])
        return cls(*(float(limit) for part in (chainage, height) for limit in (part.min(), part.max())))

    def place(self, chainage: FloatArray, height: FloatArray) -> list[list[float]]:
        """Return points of the sketch, x to the right and y downwards [px]."""
        wide, high = _WIDTH - 2.0 * _MARGIN, _HEIGHT - 2.0 * _MARGIN
        x = _MARGIN + wide * (chainage - self.start) / (self.end - self.start)
        y = _MARGIN + high * (self.high - height) / ((self.high - self.low) or 1.0)
        return np.column_stack((x, y)).tolist()


def as_html(form: FormResult) -> str:
    """Return the HTML; it takes the colours of text and paper from the page around it."""
    told = facts(form)
    rows = "".join(
        f'<tr><th style="text-align: left">{label}</th>'
        f'<td style="text-align: left">{escape(told[label])}</td></tr>'
        for label in _TOLD
    )
    return (
        '<div class="catenaria-result" style="max-width: 46em">'
        f"<b>{escape(form.name or 'a line without name')}</b>, method {escape(form.method)}"
        f"{sketch(form)}{_wire_table(form)}<table>{rows}</table></div>"
    )


def sketch(form: FormResult) -> str:
    """Return heights of all wires over chainage, with droppers, as an SVG that is as wide as its place."""
    frame, droppers = Frame.around(form), form.droppers
    feet = frame.place(droppers.x, droppers.height)
    tops = frame.place(droppers.x, droppers.messenger_height)
    bars = "".join(f"M{x:.1f} {foot:.1f}V{top:.1f}" for (x, foot), (_, top) in zip(feet, tops, strict=True))
    wires = "".join(_drawn(wire, frame) for wire in form.wires)
    return (
        f'<svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" style="width: 100%; display: block" role="img">'
        "<title>Heights of all wires, not to scale</title>"
        f'<path d="{bars}" stroke="currentColor" stroke-width="0.6" fill="none" opacity="0.6"/>{wires}</svg>'
    )


def _drawn(wire: WireForm, frame: Frame) -> str:
    stride = -(-wire.profile.chainage.size // _MOST_POINTS)
    points = frame.place(wire.profile.chainage[::stride], wire.profile.height[::stride])
    text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{text}" stroke="{_colour(wire)}" stroke-width="1.4" fill="none"/>'


def _colour(wire: WireForm) -> str:
    from catenaria.report.style import wire_colour  # imports matplotlib, which is slow

    return wire_colour(wire.name, wire.role)


def _wire_table(form: FormResult) -> str:
    head = "".join(f"<th>{column}</th>" for column in _COLUMNS)
    rows = "".join(_row(wire) for wire in form.wires[:_MOST_WIRES])
    hidden = len(form.wires) - _MOST_WIRES
    if hidden > 0:
        rows += f'<tr><td colspan="{len(_COLUMNS)}">and {hidden} more</td></tr>'
    return f'<table style="white-space: nowrap"><tr>{head}</tr>{rows}</table>'


def _row(wire: WireForm) -> str:
    cells = (
        f'<span style="color: {_colour(wire)}">&#9632;</span> {escape(wire.name)}',
        f"{wire.tension:.1f}",
        f"{wire.target_tension:.1f}",
        f"{wire.unstressed_length:.4f}",
        f"{1e3 * wire.sag:.2f}",
    )
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
