"""Scales of axes: logarithmic ones, those that count, and how much a vertical one is exaggerated."""

# pyright: reportUnknownMemberType=false

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from numpy.typing import NDArray

from catenaria.report.style import inches

FloatArray = NDArray[np.float64]

_SHORTEST = 1e-4  # of the longest time, on a logarithmic time axis


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


def state_exaggeration(axes: Axes, y_unit: float) -> None:
    """Add to the lower label how much larger the vertical scale is; `y_unit` is the unit of y in metres."""
    wide, high = inches(axes)
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    factor = high / (y_unit * (y1 - y0)) * (x1 - x0) / wide
    axes.set_xlabel(
        f"{axes.get_xlabel()}; vertical scale {float(f'{factor:.2g}'):g} times the horizontal one"
    )


def _plain_ticks(axis: Axis) -> None:
    """Label powers of ten as plain numbers, because typesetting formulas takes longer than all else."""
    axis.minorticks_off()
    axis.set_major_formatter("{x:g}")
