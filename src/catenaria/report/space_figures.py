"""Figures of lines in space over chainage: from the side, from above, and against the wanted heights."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from catenaria.report import draw, scales, style
from catenaria.results import FormResult, WireForm

FloatArray = NDArray[np.float64]
Drawing = Callable[[Axes, FormResult, tuple[float, float]], None]

CONTACT = "contact wire"
ONCE = ("stitch wire", "mid-point anchor")  # roles of which there are many wires, one label for all

_CHAINAGE = "chainage [m]"
_MOST = 450.0  # m of line beside each other in one panel


def profile_figure(result: FormResult) -> Figure:
    """Draw the heights of all wires with droppers, seen from the side."""
    text = "Heights are normal to the canted track plane."
    slack = int(np.count_nonzero(result.droppers.slack))
    if slack:
        text += f" Of the droppers those that lift nothing are marked: {slack} of {result.droppers.x.size}."
    return _in_rows(result, "Heights of all wires in equilibrium", text, "height [m]", _draw_profile)


def plan_figure(result: FormResult) -> Figure:
    """Draw the lateral offsets of all wires with arms and droppers, seen from above."""
    text = "Offsets from the middle of the track (dashed) in the canted track plane. Dots: hinges of arms."
    return _in_rows(
        result, "Lateral offsets of all wires in equilibrium", text, "to the left [m]", _draw_plan
    )


def wanted_height_figure(result: FormResult) -> Figure:
    """Draw by how much contact wires are higher than the straight lines between wanted heights."""
    title = "Contact wire against wanted heights in equilibrium"
    text = "Counted from straight lines between the heights that are wanted at droppers."
    return _in_rows(result, title, text, "above wanted [mm]", _draw_above_wanted)


def _in_rows(result: FormResult, title: str, text: str, quantity: str, drawing: Drawing) -> Figure:
    """Draw the line in panels below each other, each with a part of it, all to the same scales."""
    windows = list(_windows(result))
    figure, rows = style.new_figure(title, text, [2.2] * len(windows))
    panels = [row[0] for row in rows]
    supports = _supports(result)
    for axes, window in zip(panels, windows, strict=True):
        drawing(axes, result, window)
    limits = np.array([axes.get_ylim() for axes in panels])
    for axes, (start, end) in zip(panels, windows, strict=True):
        style.describe(axes, "", _CHAINAGE, quantity)
        axes.set_xlim(start, end)
        axes.set_ylim(float(limits[:, 0].min()), float(limits[:, 1].max()))
        draw.mark_supports(axes, {name: x for name, x in supports.items() if start <= x <= end})
        scales.state_exaggeration(axes, y_unit=1e-3 if quantity.endswith("[mm]") else 1.0)
    style.legend_above(panels[0])
    return figure


def _windows(result: FormResult) -> Iterator[tuple[float, float]]:
    """Yield the parts of the line in chainage [m], all equally long."""
    start = min(float(wire.profile.chainage[0]) for wire in result.wires)
    end = max(float(wire.profile.chainage[-1]) for wire in result.wires)
    edges = np.linspace(start, end, math.ceil((end - start) / _MOST) + 1).tolist()
    yield from pairwise(edges)


def _supports(result: FormResult) -> dict[str, float]:
    """Return the chainages of all supports by name [m]."""
    return dict(zip(result.supports.support, result.supports.chainage.tolist(), strict=True))


def _draw_profile(axes: Axes, result: FormResult, window: tuple[float, float]) -> None:
    droppers = result.droppers
    _draw_wires(axes, result, window, lambda wire: wire.profile.height)
    here = _within(droppers.x, window)
    draw.bars(axes, droppers.x[here], droppers.height[here], droppers.messenger_height[here], "dropper")
    slack = here & droppers.slack
    if slack.any():
        middle = 0.5 * (droppers.height + droppers.messenger_height)[slack]
        draw.points(axes, droppers.x[slack], middle, style.ORANGE, "slack dropper")


def _draw_plan(axes: Axes, result: FormResult, window: tuple[float, float]) -> None:
    droppers, arms = result.droppers, result.arms
    _draw_wires(axes, result, window, lambda wire: wire.profile.lateral)
    here = _within(droppers.x, window)
    draw.bars(axes, droppers.x[here], droppers.stagger_bottom[here], droppers.stagger_top[here], "dropper")
    held = zip(result.supports.support, result.supports.wire, result.supports.stagger.tolist(), strict=True)
    stagger = {(support, wire): offset for support, wire, offset in held}
    tip = np.array([stagger[arm] for arm in zip(arms.support, arms.wire, strict=True)])
    here = _within(arms.chainage, window)
    if here.any():
        draw.bars(axes, arms.chainage[here], arms.hinge_stagger[here], tip[here], "steady arm", style.DARK)
        draw.points(axes, arms.chainage[here], arms.hinge_stagger[here], style.DARK, "")
    draw.level(axes, 0.0, "")


def _draw_above_wanted(axes: Axes, result: FormResult, window: tuple[float, float]) -> None:
    """Draw contact wires between their first and their last droppers."""
    droppers, lower = result.droppers, np.array(result.droppers.lower_wire)
    for wire in result.wires:
        held = lower == wire.name
        if wire.role != CONTACT or not held.any():
            continue
        x, target, shape = droppers.x[held], droppers.target_height[held], wire.profile
        here = _within(shape.chainage, window) & _within(shape.chainage, (float(x[0]), float(x[-1])))
        above = shape.height[here] - np.interp(shape.chainage[here], x, target)
        colour = style.wire_colour(wire.name, wire.role)
        draw.line(axes, shape.chainage[here], 1e3 * above, colour, wire.name, width=1.2)
        x = x[_within(x, window)]
        draw.line(axes, x, 0.0 * x, style.FAINT, width=0.8)


def _draw_wires(
    axes: Axes, result: FormResult, window: tuple[float, float], offset: Callable[[WireForm], FloatArray]
) -> None:
    named: set[str] = set()
    for wire in result.wires:
        here = _within(wire.profile.chainage, window)
        if not here.any():
            continue
        label = wire.role if wire.role in ONCE else wire.name
        x, colour = wire.profile.chainage[here], style.wire_colour(wire.name, wire.role)
        draw.line(axes, x, offset(wire)[here], colour, "" if label in named else label)
        named.add(label)


def _within(chainage: FloatArray, window: tuple[float, float]) -> NDArray[np.bool_]:
    return (window[0] <= chainage) & (chainage <= window[1])
