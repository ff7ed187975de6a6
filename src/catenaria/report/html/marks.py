"""What is drawn beside the wires: droppers, steady arms and point masses, each with what is said of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html import drawing
from catenaria.report.html.clamps import masses_apart
from catenaria.report.html.drawing import Trace, colour, plain
from catenaria.report.html.windows import Window
from catenaria.report.names import dropper_names
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

_MARK = 5  # size of marks [px]
_MOST_MARKED = 100  # droppers in one figure: marks of more touch each other, and take half of its time
_DROPPER = (
    "<b>%{text}</b><br>chainage %{x:.2f} m<br>length %{customdata[0]:.4f} m, "
    "cut to %{customdata[1]:.4f} m<br>force below %{customdata[2]:.1f} N, above %{customdata[3]:.1f} N<br>"
    "height %{customdata[4]:.4f} m, wanted %{customdata[5]:.4f} m"
)


def dropper_traces(result: FormResult, window: Window) -> list[Trace]:
    """Draw droppers from wire to wire, with marks at their ends unless they are many, and those slack."""
    droppers = result.droppers
    here = np.flatnonzero(window.mask(droppers.x))
    x, low, high = droppers.x[here], droppers.height[here], droppers.messenger_height[here]
    names, said = _said(result, here)
    size = _MARK if here.size <= _MOST_MARKED else 0
    traces = [
        drawing.bars(x, low, high, "dropper", colour("dropper"), names, _DROPPER, extra=said, size=size)
    ]
    slack = droppers.slack[here]
    if slack.any():
        middle, red = 0.5 * (low + high)[slack], colour("fails")
        traces.append(dropper_points(result, here[slack], middle, "slack dropper", red, symbol="x", size=8))
    return traces


def dropper_points(
    result: FormResult,
    here: IntArray,
    y: FloatArray,
    name: str,
    of: str,
    *,
    symbol: str = "circle",
    size: int = _MARK,
) -> Trace:
    """Return a point for each of some droppers, with its lengths, forces and heights."""
    names, said = _said(result, here)
    x = result.droppers.x[here]
    return drawing.points(x, y, name, of, names, _DROPPER, extra=said, symbol=symbol, size=size)


def _said(result: FormResult, here: IntArray) -> tuple[list[str], list[FloatArray]]:
    """Return the names of some droppers, and the numbers in `_DROPPER`."""
    d, names = result.droppers, dropper_names(result)
    said = (d.length, d.cut_length, d.force_bottom, d.force_top, d.height, d.target_height)
    places: list[int] = here.tolist()
    return [names[i] for i in places], [values[here] for values in said]


def mass_traces(result: FormResult, window: Window) -> list[Trace]:
    """Mark insulators, clamps and other masses at their heights, but not the clamps of steady arms."""
    masses = result.masses
    here = np.flatnonzero(masses_apart(result) & window.mask(masses.chainage))
    if not here.size:
        return []
    x, height = masses.chainage[here], np.concatenate([_height(result, int(i)) for i in here])
    texts = [
        f"<b>{plain(masses.name[i] or 'mass')}</b> on the {plain(masses.wire[i])}<br>"
        f"chainage {masses.chainage[i]:.2f} m<br>height {z:.4f} m<br>mass {masses.mass[i]:g} kg"
        for i, z in zip(here.tolist(), height.tolist(), strict=True)
    ]
    return [drawing.points(x, height, "point mass", colour("ink"), texts, symbol="diamond", size=8)]


def _height(result: FormResult, i: int) -> FloatArray:
    profile = result.wire(result.masses.wire[i]).profile
    return np.interp(result.masses.coordinate[i : i + 1], profile.s, profile.height)


def arm_traces(result: FormResult, window: Window) -> list[Trace]:
    """Draw steady arms from above."""
    arms, held = result.arms, result.supports
    here = np.flatnonzero(window.mask(arms.chainage))
    if not here.size:
        return []
    tip = dict(zip(zip(held.support, held.wire, strict=True), held.stagger.tolist(), strict=True))
    tips = np.array([tip[arms.support[i], arms.wire[i]] for i in here])
    x, hinge, ink = arms.chainage[here], arms.hinge_stagger[here], colour("ink")
    texts = [_arm_text(result, int(i)) for i in here]
    return [
        drawing.bars(x, hinge, tips, "steady arm", ink),
        drawing.points(x, hinge, "steady arm", ink, texts, legend=False),
    ]


def _arm_text(result: FormResult, i: int) -> str:
    arms = result.arms
    return (
        f"<b>steady arm at {plain(arms.support[i])}</b>, {arms.registration[i]}<br>"
        f"chainage {arms.chainage[i]:.2f} m, on the {plain(arms.wire[i])}<br>"
        f"radial {arms.radial[i]:.1f} N, vertical {arms.vertical[i]:.1f} N<br>"
        f"hinge {1e3 * arms.hinge_stagger[i]:.0f} mm to the left, {arms.hinge_height[i]:.3f} m high"
    )
