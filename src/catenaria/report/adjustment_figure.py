"""The figure of an adjustment: deviations from the wanted heights, and what is done to which droppers."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from catenaria.report import draw, style
from catenaria.results.adjustment import Adjustment

_MM = 1e3


def adjustment_figure(study: Adjustment) -> Figure:
    """Draw deviations measured, before and after with the tolerance, and the changes of lengths below."""
    count, droppers = study.count, study.droppers
    text = (
        f"{count} of {droppers.change.size} droppers adjusted, in steps of {_MM * study.step:g} mm. Largest "
        f"deviation at droppers: {_MM * study.largest_deviation(droppers.height_before):.1f} mm before,\n"
        f"{_MM * study.largest_deviation(droppers.height_after):.1f} mm after. "
        "Dots: measured at droppers, less the wanted height."
    )
    title = f"Adjustment: {study.line}" if study.line else "Adjustment"
    names = list(dict.fromkeys(_checked_wires(study)))
    figure, panels = style.new_figure(title, text, [2.8] * len(names) + [1.8])
    for name, (axes,) in zip(names, panels, strict=False):
        _draw_heights(axes, study, name)
    (axes,) = panels[-1]
    x, change = droppers.chainage[droppers.adjusted], _MM * droppers.change[droppers.adjusted]
    draw.bars(axes, x, 0.0 * change, change, "change of length", style.RED)
    draw.points(axes, x, change, style.RED, "")
    draw.line(axes, droppers.chainage[[0, -1]], np.zeros(2), style.DARK, width=0.8)
    style.describe(axes, f"({chr(97 + len(names))}) longer (+) or shorter (-)", "chainage [m]", "change [mm]")
    _mark(axes, study)
    return figure


def _checked_wires(study: Adjustment) -> list[str]:
    pairs = zip(study.droppers.lower_wire, study.droppers.checked.tolist(), strict=True)
    return [name for name, checked in pairs if checked]


def _draw_heights(axes: Axes, study: Adjustment, name: str) -> None:
    droppers, points = study.droppers, study.points
    own = np.array([wire == name for wire in droppers.lower_wire], dtype=np.bool_)
    x, wanted = droppers.chainage[own], droppers.wanted_height[own]
    draw.band(axes, 0.0, _MM * study.tolerance, f"± {_MM * study.tolerance:g} mm")
    draw.line(axes, x, _MM * (droppers.height_before[own] - wanted), style.ORANGE, "before", width=1.2)
    draw.line(axes, x, _MM * (droppers.height_after[own] - wanted), style.BLUE, "after")
    at = np.array([wire == name for wire in points.wire], dtype=np.bool_) & (points.span > 0)
    expected = np.interp(points.chainage[at], x, wanted)
    draw.points(axes, points.chainage[at], _MM * (points.height[at] - expected), style.DARK, "measured")
    style.describe(axes, f"(a) {name}" if name == "contact wire" else f"(b) {name}", "", "deviation [mm]")
    _mark(axes, study)
    style.legend_above(axes)


def _mark(axes: Axes, study: Adjustment) -> None:
    supports = dict(zip(study.supports, study.support_chainage.tolist(), strict=True))
    draw.mark_supports(axes, supports)
