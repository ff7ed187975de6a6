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


def dropper_traces(result: FormResult, window: Window) -> list[Trace]:
    """Draw droppers from wire to wire, and mark those that are slack."""
    droppers = result.droppers
    here = np.flatnonzero(window.mask(droppers.x))
    x, low, high = droppers.x[here], droppers.height[here], droppers.messenger_height[here]
    green, names = colour("dropper"), dropper_names(result)
    texts = [dropper_text(result, i, names[i]) for i in here.tolist()]
    traces = [
        drawing.bars(x, low, high, "dropper", green),
        drawing.points(x, low, "dropper", green, texts, size=5, legend=False),
        drawing.points(x, high, "dropper", green, texts, size=5, legend=False),
    ]
    slack = droppers.slack[here]
    if slack.any():
        marked = [text for text, loose in zip(texts, slack, strict=True) if loose]
        middle = 0.5 * (low + high)[slack]
        traces.append(
            drawing.points(x[slack], middle, "slack dropper", colour("fails"), marked, symbol="x", size=8)
        )
    return traces


def dropper_text(result: FormResult, i: int, name: str) -> str:
    """Return what is said of a dropper of that name."""
    d = result.droppers
    return (
        f"<b>{name}</b><br>chainage {d.x[i]:.2f} m<br>length {d.length[i]:.4f} m, "
        f"cut to {d.cut_length[i]:.4f} m<br>force below {d.force_bottom[i]:.1f} N, "
        f"above {d.force_top[i]:.1f} N<br>"
        f"height {d.height[i]:.4f} m, wanted {d.target_height[i]:.4f} m"
    )


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
