"""What is drawn into panels: lines, points, bands, and the marks of supports and droppers."""

# pyright: reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from catenaria.report.style import DARK, FAINT, GREEN, GREY, INK, PALE

FloatArray = NDArray[np.float64]

_MOST_LINES = 60
_MOST_NAMES = 16


def line(
    axes: Axes,
    x: FloatArray,
    y: FloatArray,
    colour: str,
    label: str = "",
    *,
    width: float = 1.6,
    style: str | tuple[int, tuple[float, ...]] = "-",
) -> None:
    """Draw one line; without a label it is not in the legend."""
    axes.plot(x, y, color=colour, label=label or "_", linewidth=width, linestyle=style)


def lines(axes: Axes, x: FloatArray, y: FloatArray, colour: str, noun: str, *, width: float = 0.6) -> None:
    """Draw the columns of `y` as thin lines, one for each `noun`; if there are very many, only some."""
    count = y.shape[1]
    stride = -(-count // _MOST_LINES)
    text = f"each {noun}" if stride == 1 else f"1 in {stride} {noun}s"
    for i in range(0, count, stride):
        line(axes, x, y[:, i], colour, "" if i else text, width=width)


def points(axes: Axes, x: FloatArray, y: FloatArray, colour: str, label: str) -> None:
    """Draw separate points; without a label they are not in the legend."""
    axes.plot(x, y, color=colour, label=label or "_", linestyle="", marker="o", markersize=4.0, zorder=3)


def bars(
    axes: Axes, x: FloatArray, low: FloatArray, high: FloatArray, label: str, colour: str = GREEN
) -> None:
    """Draw a vertical line from `low` to `high` at each x."""
    axes.vlines(x, low, high, color=colour, linewidth=1.2, label=label, zorder=1.5)


def write_beside(axes: Axes, x: float, y: float, text: str) -> None:
    """Write upright text to the left of a point, centred on it."""
    axes.text(x, y, text, rotation=90, ha="right", va="center", fontsize=INK - 1.5, color=DARK)


def level(axes: Axes, y: float, label: str) -> None:
    """Draw a horizontal line across a panel; without a label it is not in the legend."""
    axes.axhline(y, color=DARK, linewidth=1.1, linestyle=(0, (4, 3)), label=label or "_", zorder=1.5)


def band(axes: Axes, middle: float, half: float, label: str) -> None:
    """Shade a horizontal band across a panel."""
    axes.axhspan(middle - half, middle + half, color=PALE, linewidth=0.0, label=label, zorder=0.5)


def mark_supports(axes: Axes, supports: Mapping[str, float], held: Collection[str] | None = None) -> None:
    """Mark supports by a dashed line, with their name above it unless there are many.

    Supports that do not hold the wire of the panel, those not in `held`, are marked lightly.
    """
    for name, x in supports.items():
        holds = held is None or name in held
        colour, dashes = (GREY, (5, 4)) if holds else (FAINT, (1, 3))
        axes.axvline(x, color=colour, linewidth=0.8, linestyle=(0, dashes), zorder=1)
        if len(supports) <= _MOST_NAMES:
            axes.annotate(
                name,
                (x, 1.0),
                (0, 4),
                xycoords=axes.get_xaxis_transform(),
                textcoords="offset points",
                ha="center",
                fontsize=INK - 1,
                color=colour,
            )


def mark_droppers(axes: Axes, x: FloatArray) -> None:
    """Mark droppers by a triangle at the lower edge."""
    axes.plot(
        x,
        0.0 * x,
        color=DARK,
        label="dropper",
        linestyle="",
        marker="^",
        markersize=5.0,
        zorder=3,
        transform=axes.get_xaxis_transform(),
        clip_on=False,
    )
