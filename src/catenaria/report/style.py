"""One look for all figures, set on each figure itself and never on matplotlib's global parameters.

Colours are those of Okabe and Ito (2008), which remain distinct with every kind of colour blindness. Margins
and places of labels are fixed, because matplotlib's automatic layouts draw every figure twice. All calls of
matplotlib that take style arguments are in this file, in `draw` and in `scales`, because matplotlib does not
declare their types.
"""

# pyright: reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"
CYCLE = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY)
DARK, GREY, FAINT, PALE = "#222222", "#666666", "#AAAAAA", "#DDDDDD"
WIRE_COLOURS = {
    "contact wire": RED,
    "second contact wire": ORANGE,
    "auxiliary messenger": SKY,
    "messenger wire": BLUE,
    "stitch wire": PURPLE,
    "mid-point anchor": GREY,
}

DOTS_PER_INCH = 150
_PAGE_DOTS_PER_INCH = 90
INK = 10.0  # font size [pt]
_WIDTH = 10.0  # of a figure [inch]; so are the margins
_LEFT, _RIGHT, _TOP, _BOTTOM, _BETWEEN = 1.0, 0.25, 1.2, 0.62, 1.05
_SUBTITLE_LINE = 0.19
_LABEL_BELOW, _LABEL_LEFT = 0.28, 0.68
_ABOVE_NAMES = 17.0  # from a panel up to its title, over the names of supports [pt]


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
    figure.text(0.02, 1 - 0.35 / height, title, fontsize=INK + 4, fontweight="bold", color=DARK)
    figure.text(0.02, 1 - 0.5 / height, subtitle, fontsize=INK, color=GREY, va="top", linespacing=1.3)
    return figure, panels


def wire_colour(name: str, role: str) -> str:
    """Return the colour of a wire: that of its name or, of many wires of one role, that of their role."""
    return WIRE_COLOURS.get(name, WIRE_COLOURS.get(role, DARK))


def describe(axes: Axes, title: str, x: str, y: str) -> None:
    """Write the title of a panel and the quantity and unit of its axes, and draw a quiet grid."""
    axes.set_title(title, loc="left", fontsize=INK + 1, color=DARK, y=1.0, pad=_ABOVE_NAMES)
    axes.set_xlabel(x, fontsize=INK, color=DARK)
    axes.set_ylabel(y, fontsize=INK, color=DARK)
    axes.tick_params(labelsize=INK - 1, color=GREY, labelcolor=DARK)
    axes.grid(visible=True, color=PALE, linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.margins(x=0.01, y=0.08)
    wide, high = inches(axes)
    axes.get_xaxis().set_label_coords(0.5, -_LABEL_BELOW / high)
    axes.get_yaxis().set_label_coords(-_LABEL_LEFT / wide, 0.5)
    if axes.get_yscale() == "linear":
        axes.ticklabel_format(axis="y", useOffset=False)


def legend(axes: Axes, columns: int, length: float = 1.3) -> None:
    """Add a legend of all labelled lines above the data, for which the panel is extended upwards.

    Line styles need longer pieces of line, of `length` letters, than colours do.
    """
    rows = -(-len(axes.get_legend_handles_labels()[1]) // columns)
    part = (0.08 + 0.2 * rows) / inches(axes)[1]
    scale = axes.get_yaxis().get_transform()
    low, high = scale.transform(np.array(axes.get_ylim()))
    bottom, top = scale.inverted().transform(np.array([low, high + (high - low) * part / (1.0 - part)]))
    axes.set_ylim(float(bottom), float(top))
    axes.legend(
        loc="upper right",
        ncols=columns,
        fontsize=INK - 1,
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
        fontsize=INK - 1,
        frameon=False,
        borderaxespad=_ABOVE_NAMES / (INK - 1),
        borderpad=0.0,
        handlelength=1.3,
        columnspacing=0.9,
    )


def save(figure: Figure, file: Path, *, compact: bool = False) -> Path:
    """Write a figure as PNG without anything in it that depends on the day or the program's version.

    A compact one is for pages: coarser, and compressed as far as it goes, which takes longer.
    """
    dpi, level = (_PAGE_DOTS_PER_INCH, 9) if compact else (DOTS_PER_INCH, 1)
    figure.savefig(file, dpi=dpi, metadata={"Software": None}, pil_kwargs={"compress_level": level})
    return file


def inches(axes: Axes) -> tuple[float, float]:
    """Return width and height of a panel [inch]."""
    box, (wide, high) = axes.get_position(), axes.figure.get_figure(root=True).get_size_inches()
    return box.width * wide, box.height * high
