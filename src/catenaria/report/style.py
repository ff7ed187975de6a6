"""One look for all figures, set on each figure itself and never on matplotlib's global parameters.

Colours are those of Okabe and Ito (2008), which remain distinct with every kind of colour blindness. Margins
and places of labels are fixed, because matplotlib's automatic layouts draw every figure twice. All calls of
matplotlib that take style arguments are in this file, because matplotlib does not declare their types.
"""

# pyright: reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"
CYCLE = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY)
DARK, GREY, FAINT, PALE = "#222222", "#666666", "#AAAAAA", "#DDDDDD"
WIRE_COLOURS = {"contact wire": RED, "messenger wire": BLUE}

DOTS_PER_INCH = 150
_PAGE_DOTS_PER_INCH = 90
_INK = 10.0  # font size [pt]
_WIDTH = 10.0  # of a figure [inch]; so are the margins
_LEFT, _RIGHT, _TOP, _BOTTOM, _BETWEEN = 1.0, 0.25, 1.2, 0.62, 1.05
_SUBTITLE_LINE = 0.19
_LABEL_BELOW, _LABEL_LEFT = 0.28, 0.68
_SHORTEST = 1e-4  # of the longest time, on a logarithmic time axis
_ABOVE_NAMES = 17.0  # from a panel up to its title, over the names of supports [pt]
_MOST_LINES = 60
_MOST_NAMES = 16


def new_figure(
    title: str, subtitle: str, heights: Sequence[float], columns: int = 1
) -> tuple[Figure, list[list[Axes]]]:
    """Make a figure with a grid of panels.

    Parameters
    ----------
    title, subtitle : str
        What the figure shows, and what one must know to read it; the subtitle may have several lines.
    heights : sequence of float
        Height of each row of panels [inch].
    columns : int
        Number of panels in a row.

    Returns
    -------
    Figure
        Not registered with pyplot.
    list of list of Axes
        Panels by row and column.
    """
    above = _TOP + _SUBTITLE_LINE * subtitle.count("\n")
    height = above + sum(heights) + _BETWEEN * (len(heights) - 1) + _BOTTOM
    pitch = (_WIDTH - _RIGHT) / columns
    figure = Figure(figsize=(_WIDTH, height), facecolor="white")
    panels: list[list[Axes]] = []
    top = height - above
    for row in heights:
        size = ((pitch - _LEFT) / _WIDTH, row / height)
        lefts = [(_LEFT + i * pitch) / _WIDTH for i in range(columns)]
        panels.append([figure.add_axes((left, (top - row) / height, *size)) for left in lefts])
        top -= row + _BETWEEN
    figure.text(0.02, 1 - 0.35 / height, title, fontsize=_INK + 4, fontweight="bold", color=DARK)
    figure.text(0.02, 1 - 0.5 / height, subtitle, fontsize=_INK, color=GREY, va="top", linespacing=1.3)
    return figure, panels


def describe(axes: Axes, title: str, x: str, y: str) -> None:
    """Write the title of a panel and the quantity and unit of its axes, and draw a quiet grid."""
    axes.set_title(title, loc="left", fontsize=_INK + 1, color=DARK, y=1.0, pad=_ABOVE_NAMES)
    axes.set_xlabel(x, fontsize=_INK, color=DARK)
    axes.set_ylabel(y, fontsize=_INK, color=DARK)
    axes.tick_params(labelsize=_INK - 1, color=GREY, labelcolor=DARK)
    axes.grid(visible=True, color=PALE, linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.margins(x=0.01, y=0.08)
    wide, high = _inches(axes)
    axes.get_xaxis().set_label_coords(0.5, -_LABEL_BELOW / high)
    axes.get_yaxis().set_label_coords(-_LABEL_LEFT / wide, 0.5)
    if axes.get_yscale() == "linear":
        axes.ticklabel_format(axis="y", useOffset=False)


def logarithmic(axes: Axes) -> None:
    """Give a panel a logarithmic vertical scale."""
    axes.set_yscale("log")
    _plain_ticks(axes.get_yaxis())


def logarithmic_both_ways(axes: Axes, y: FloatArray) -> None:
    """Give a panel a vertical scale that is linear about zero and logarithmic for the larger values of y."""
    largest = float(np.max(np.abs(y)))
    if largest > 0.0:
        decades = 10.0 ** (np.floor(np.log10(largest)) - np.arange(3))
        axes.set_yscale("symlog", linthresh=float(decades[-1]))
        _plain_ticks(axes.get_yaxis())
        axes.set_yticks(np.concatenate((-decades, [0.0], decades[::-1])))


def logarithmic_time(axes: Axes, t: FloatArray) -> None:
    """Give a panel a logarithmic time axis, which shows the start and the long approach alike."""
    axes.set_xscale("log")
    _plain_ticks(axes.get_xaxis())
    axes.set_xlim(max(float(t[t > 0.0][0]), _SHORTEST * float(t[-1])), float(t[-1]))


def count_along(axes: Axes, numbers: FloatArray, *, logarithmic: bool = False) -> None:
    """Give a panel a horizontal axis that counts things, with a tick at each of the numbers."""
    if logarithmic:
        axes.set_xscale("log")
    _plain_ticks(axes.get_xaxis())
    axes.set_xticks(np.unique(numbers))


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
    """Draw separate points."""
    axes.plot(x, y, color=colour, label=label, linestyle="", marker="o", markersize=4.0, zorder=3)


def bars(axes: Axes, x: FloatArray, low: FloatArray, high: FloatArray, label: str) -> None:
    """Draw a vertical line from `low` to `high` at each x."""
    axes.vlines(x, low, high, color=GREEN, linewidth=1.2, label=label, zorder=1.5)


def write_beside(axes: Axes, x: float, y: float, text: str) -> None:
    """Write upright text to the left of a point, centred on it."""
    axes.text(x, y, text, rotation=90, ha="right", va="center", fontsize=_INK - 1.5, color=DARK)


def level(axes: Axes, y: float, label: str) -> None:
    """Draw a horizontal line across a panel."""
    axes.axhline(y, color=DARK, linewidth=1.1, linestyle=(0, (4, 3)), label=label, zorder=1.5)


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
                fontsize=_INK - 1,
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


def legend(axes: Axes, columns: int, length: float = 1.3) -> None:
    """Add a legend of all labelled lines above the data, for which the panel is extended upwards.

    Line styles need longer pieces of line, of `length` letters, than colours do.
    """
    rows = -(-len(axes.get_legend_handles_labels()[1]) // columns)
    part = (0.08 + 0.2 * rows) / _inches(axes)[1]
    scale = axes.get_yaxis().get_transform()
    low, high = scale.transform(np.array(axes.get_ylim()))
    bottom, top = scale.inverted().transform(np.array([low, high + (high - low) * part / (1.0 - part)]))
    axes.set_ylim(float(bottom), float(top))
    axes.legend(
        loc="upper right",
        ncols=columns,
        fontsize=_INK - 1,
        facecolor="white",
        edgecolor="none",
        framealpha=1.0,
        borderaxespad=0.2,
        handlelength=length,
        columnspacing=0.9,
    )


def legend_above(axes: Axes) -> None:
    """Add a legend above the panel, at the right of its title, where it covers no line of the panel."""
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=len(axes.get_legend_handles_labels()[1]),
        fontsize=_INK - 1,
        frameon=False,
        borderaxespad=_ABOVE_NAMES / (_INK - 1),
        borderpad=0.0,
        handlelength=1.3,
        columnspacing=0.9,
    )


def state_exaggeration(axes: Axes, y_unit: float) -> None:
    """Add to the lower label how much larger the vertical scale is; `y_unit` is the unit of y in metres."""
    wide, high = _inches(axes)
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    factor = high / (y_unit * (y1 - y0)) * (x1 - x0) / wide
    axes.set_xlabel(
        f"{axes.get_xlabel()}; vertical scale {float(f'{factor:.2g}'):g} times the horizontal one"
    )


def save(figure: Figure, file: Path, *, compact: bool = False) -> Path:
    """Write a figure as PNG without anything in it that depends on the day or the program's version.

    A compact one is for pages: coarser, and compressed as far as it goes, which takes longer.
    """
    dpi, level = (_PAGE_DOTS_PER_INCH, 9) if compact else (DOTS_PER_INCH, 1)
    figure.savefig(file, dpi=dpi, metadata={"Software": None}, pil_kwargs={"compress_level": level})
    return file


def _plain_ticks(axis: Axis) -> None:
    """Label powers of ten as plain numbers, because typesetting formulas takes longer than all else."""
    axis.minorticks_off()
    axis.set_major_formatter("{x:g}")


def _inches(axes: Axes) -> tuple[float, float]:
    box, (wide, high) = axes.get_position(), axes.figure.get_figure(root=True).get_size_inches()
    return box.width * wide, box.height * high
