"""What is drawn of samples: bands between percentiles, histograms, shares as bars with names."""

# pyright: reportUnknownMemberType=false

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from catenaria.report.style import BLUE, DARK, INK, RED, SKY

FloatArray = NDArray[np.float64]


def between(axes: Axes, x: FloatArray, low: FloatArray, high: FloatArray, dark: float, label: str) -> None:
    """Shade what lies between two curves; `dark` is the opacity, 0 to 1."""
    axes.fill_between(x, low, high, color=BLUE, alpha=dark, linewidth=0.0, label=label)


def histogram(axes: Axes, values: FloatArray, edges: FloatArray, label: str) -> None:
    """Draw how many values there are between each two edges, as bars."""
    axes.hist(values, edges.tolist(), color=SKY, label=label)


def outline(axes: Axes, values: FloatArray, edges: FloatArray, label: str) -> None:
    """Draw the same as a line of steps."""
    axes.stairs(np.histogram(values, edges)[0], edges, color=RED, linewidth=1.2, label=label)


def upright(axes: Axes, x: float, label: str) -> None:
    """Draw a vertical line across a panel."""
    axes.axvline(x, color=DARK, linewidth=1.1, linestyle=(0, (4, 3)), label=label)


def named_shares(axes: Axes, names: tuple[str, ...], share: FloatArray) -> None:
    """Draw shares as horizontal bars in percent, the first one on top, each with its name beside it."""
    at = np.arange(len(names))
    axes.barh(at, 100.0 * share, color=SKY, height=0.7)
    for y, (name, value) in enumerate(zip(names, share.tolist(), strict=True)):
        text = f"{name}: {100.0 * value:.2g} %"
        axes.annotate(
            text,
            (100.0 * value, y),
            (12, 0),
            textcoords="offset points",
            va="center",
            fontsize=INK - 1,
            color=DARK,
        )
    axes.set_yticks([])
    axes.set_ylim(len(names) - 0.4, -0.6)


def reach(axes: Axes, right: float) -> None:
    """Let a panel begin at 0 and reach to the right as far as is said."""
    axes.set_xlim(0.0, right)
