"""The figures of a page over the length of a line: profile, height errors, plan, tensions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html import drawing
from catenaria.report.html.drawing import Drawing, Trace, colour, plain, wire_colour
from catenaria.report.html.thinning import thinned
from catenaria.results import FormResult, WireForm

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]
Window = tuple[float, float]
Drawer = Callable[[FormResult, Window, set[str]], list[Trace]]

_MOST = 450.0  # m of line beside each other in one figure
_MOST_WINDOWS = 12
_HEIGHT = 320
_IN_PLANE = 1e-6  # m
_ONCE = ("stitch wire", "mid-point anchor")  # roles of which there are many wires: one label for all


def profile_figures(result: FormResult, most: float = _MOST) -> list[Drawing]:
    """Draw the heights of all wires with their droppers, seen from the side, `most` metres in one figure."""
    return list(_in_windows(result, "profile", "Profile: heights of all wires", "height [m]", _profile, most))


def height_figures(result: FormResult, tolerance: float | None) -> list[Drawing]:
    """Draw contact wires above what is wanted at droppers, with the tolerance there [m]."""

    def draw(result: FormResult, window: Window, named: set[str]) -> list[Trace]:
        return _above_wanted(result, window, named, tolerance)

    title = "Contact wire against wanted heights"
    return list(_in_windows(result, "heights", title, "above wanted [mm]", draw))


def plan_figures(result: FormResult, most: float = _MOST) -> list[Drawing]:
    """Draw the lateral offsets of all wires with arms, seen from above; nothing if all lie in one plane."""
    if all(float(np.abs(wire.profile.lateral).max()) < _IN_PLANE for wire in result.wires):
        return []
    title = "Plan: lateral offsets of all wires"
    return list(_in_windows(result, "plan", title, "to the left [m]", _plan, most))


def tension_figures(result: FormResult) -> list[Drawing]:
    """Draw the tension along every wire that supports hold."""
    wires = [wire for wire in result.wires if wire.name in result.supports.wire]
    return [_tension(result, wire, number) for number, wire in enumerate(wires, start=1)]


def support_places(result: FormResult) -> dict[str, float]:
    """Return the chainages of all supports by name [m]."""
    return dict(zip(result.supports.support, result.supports.chainage.tolist(), strict=True))


def extent(result: FormResult) -> Window:
    """Return the first and the last chainage of any wire [m]."""
    chainages = [wire.profile.chainage for wire in result.wires]
    return min(float(x.min()) for x in chainages), max(float(x.max()) for x in chainages)


def _windows(result: FormResult, most: float) -> Iterator[Window]:
    """Yield the parts of the line, all equally long."""
    start, end = extent(result)
    count = min(max(math.ceil((end - start) / most), 1), _MOST_WINDOWS)
    yield from pairwise(np.linspace(start, end, count + 1).tolist())


def _in_windows(
    result: FormResult, name: str, title: str, quantity: str, draw: Drawer, most: float = _MOST
) -> Iterator[Drawing]:
    """Draw the parts of a line below each other to the same scale."""
    windows = list(_windows(result, most))
    parts = [draw(result, window, set()) for window in windows]
    low, high = _reach([trace for part in parts for trace in part])
    supports = support_places(result)
    for number, (window, data) in enumerate(zip(windows, parts, strict=True), start=1):
        label = title if len(windows) == 1 else f"{title}, {window[0]:.0f} m to {window[1]:.0f} m"
        layout = drawing.layout(window, quantity, supports, range=[low, high])
        yield Drawing(f"{name}-{number}", label, _HEIGHT, data, layout)


def _reach(traces: list[Trace]) -> Window:
    y = [value for trace in traces for value in trace["y"] if value is not None]
    low, high = min(y, default=0.0), max(y, default=0.0)
    margin = 0.06 * (high - low) or 0.1
    return low - margin, high + margin


def _within(x: FloatArray, window: Window) -> Mask:
    return (window[0] <= x) & (x <= window[1])


def _wires(
    result: FormResult, window: Window, named: set[str], across: Callable[[WireForm], FloatArray], hover: str
) -> list[Trace]:
    """Draw all wires; what is across is their height or lateral offset."""
    traces: list[Trace] = []
    for wire in result.wires:
        profile = wire.profile
        here = np.flatnonzero(_within(profile.chainage, window))
        if here.size < 2:
            continue
        x, y = profile.chainage[here], across(wire)[here]
        here = here[thinned(x, (y, profile.tension[here]))]
        group = wire.role if wire.role in _ONCE else wire.name
        trace = drawing.line(
            profile.chainage[here],
            across(wire)[here],
            wire.name,
            wire_colour(wire.name, wire.role),
            hover,
            extra=(profile.height[here], 1e3 * profile.lateral[here], profile.tension[here]),
            legend=group not in named,
        )
        named.add(group)
        traces.append(trace | {"name": plain(group), "legendgroup": plain(group)})
    return traces


_AT = "chainage %{x:.2f} m<br>height %{customdata[0]:.4f} m<br>to the left %{customdata[1]:.1f} mm<br>"
_HOVER = _AT + "tension %{customdata[2]:.0f} N"


def _profile(result: FormResult, window: Window, named: set[str]) -> list[Trace]:
    droppers = result.droppers
    here = np.flatnonzero(_within(droppers.x, window))
    traces = _wires(result, window, named, lambda wire: wire.profile.height, _HOVER)
    x, low, high = droppers.x[here], droppers.height[here], droppers.messenger_height[here]
    green, texts = colour("dropper"), [_dropper(result, int(i)) for i in here]
    slack = droppers.slack[here]
    traces.append(drawing.bars(x, low, high, "dropper", green))
    traces.append(drawing.points(x, low, "dropper", green, texts, size=5, legend=False))
    traces.append(drawing.points(x, high, "dropper", green, texts, size=5, legend=False))
    if slack.any():
        marked = [text for text, loose in zip(texts, slack, strict=True) if loose]
        middle = 0.5 * (low + high)[slack]
        traces.append(
            drawing.points(x[slack], middle, "slack dropper", colour("fails"), marked, symbol="x", size=8)
        )
    return traces


def _dropper(result: FormResult, i: int) -> str:
    d = result.droppers
    return (
        f"<b>dropper {d.span[i]}.{d.number[i]}</b><br>chainage {d.x[i]:.2f} m<br>length {d.length[i]:.4f} m, "
        f"cut to {d.cut_length[i]:.4f} m<br>force below {d.force_bottom[i]:.1f} N, "
        f"above {d.force_top[i]:.1f} N<br>"
        f"height {d.height[i]:.4f} m, wanted {d.target_height[i]:.4f} m"
    )


def _above_wanted(
    result: FormResult, window: Window, named: set[str], tolerance: float | None
) -> list[Trace]:
    contact = [wire for wire in result.wires if wire.role == "contact wire"]
    lines = [trace for wire in contact for trace in _line_above_wanted(result, wire, window)]
    droppers = result.droppers
    own = np.isin(droppers.lower_wire, [wire.name for wire in contact]) & _within(droppers.x, window)
    here = np.flatnonzero(own)
    texts = [_dropper(result, int(i)) for i in here]
    error = 1e3 * droppers.height_error[here]
    marks = drawing.points(droppers.x[here], error, "at droppers", colour("ink"), texts, size=5)
    return [*([] if tolerance is None else _band(window, 1e3 * tolerance)), *lines, marks]


def _line_above_wanted(result: FormResult, wire: WireForm, window: Window) -> list[Trace]:
    """Draw a contact wire between its first and its last dropper."""
    droppers, profile = result.droppers, wire.profile
    own = np.flatnonzero([name == wire.name for name in droppers.lower_wire])
    if own.size < 2:
        return []
    own = own[np.argsort(droppers.x[own], kind="stable")]
    x = droppers.x[own]
    inside = (max(window[0], float(x[0])), min(window[1], float(x[-1])))
    here = np.flatnonzero(_within(profile.chainage, inside))
    if not here.size:
        return []
    at = profile.chainage[here]
    above = 1e3 * (profile.height[here] - np.interp(at, x, droppers.target_height[own]))
    kept = thinned(at, (above,))
    hover = "chainage %{x:.2f} m<br>%{y:.2f} mm above wanted<br>height %{customdata[0]:.4f} m"
    of, height = wire_colour(wire.name, wire.role), profile.height[here][kept]
    return [drawing.line(at[kept], above[kept], wire.name, of, hover, extra=(height,), digits=4)]


def _band(window: Window, half: float) -> list[Trace]:
    x, name = np.array(window), f"tolerance at droppers: ±{half:g} mm"
    low = drawing.line(
        x, np.full(2, -half), name, colour("band-edge"), "", width=1.0, dash="dash", legend=False
    )
    high = drawing.line(x, np.full(2, half), name, colour("band-edge"), "", width=1.0, dash="dash")
    silent = {"hoverinfo": "skip", "hovertemplate": None}
    return [low | silent, high | silent | {"fill": "tonexty", "fillcolor": colour("band")}]


def _plan(result: FormResult, window: Window, named: set[str]) -> list[Trace]:
    arms, held = result.arms, result.supports
    axis = drawing.line(np.array(window), np.zeros(2), "track", colour("quiet"), "", width=1.0, dash="dash")
    traces = [axis | {"hoverinfo": "skip", "hovertemplate": None}]
    traces += _wires(result, window, named, lambda wire: wire.profile.lateral, _HOVER)
    here = np.flatnonzero(_within(arms.chainage, window))
    if here.size:
        tip = dict(zip(zip(held.support, held.wire, strict=True), held.stagger.tolist(), strict=True))
        tips = np.array([tip[arms.support[i], arms.wire[i]] for i in here])
        x, hinge, ink = arms.chainage[here], arms.hinge_stagger[here], colour("ink")
        traces.append(drawing.bars(x, hinge, tips, "steady arm", ink))
        traces.append(
            drawing.points(x, hinge, "steady arm", ink, [_arm(result, int(i)) for i in here], legend=False)
        )
    return traces


def _arm(result: FormResult, i: int) -> str:
    arms = result.arms
    return (
        f"<b>steady arm at {plain(arms.support[i])}</b>, {arms.registration[i]}<br>"
        f"radial {arms.radial[i]:.1f} N, vertical {arms.vertical[i]:.1f} N<br>"
        f"hinge {1e3 * arms.hinge_stagger[i]:.0f} mm to the left, {arms.hinge_height[i]:.3f} m high"
    )


def _tension(result: FormResult, wire: WireForm, number: int) -> Drawing:
    profile, wanted = wire.profile, wire.target_tension
    kept = thinned(profile.chainage, (profile.tension, profile.moment), most=1500)
    x, tension = profile.chainage[kept], profile.tension[kept]
    hover = (
        "chainage %{x:.2f} m<br>tension %{y:.1f} N<br>height %{customdata[0]:.4f} m<br>"
        "moment %{customdata[1]:.3g} N m"
    )
    extra = (profile.height[kept], profile.moment[kept])
    window = extent(result)
    level = np.array(window)
    held, own = np.full(2, wanted), wire_colour(wire.name, wire.role)
    label, quiet = f"wanted: {wanted:.0f} N", colour("quiet")
    data = [
        drawing.line(level, held, label, quiet, "wanted %{y:.1f} N", dash="dash", width=1.2),
        drawing.line(x, tension, wire.name, own, hover, extra=extra, digits=1),
    ]
    layout = drawing.layout(
        window, "tension [N]", support_places(result), range=_tension_range(tension, wanted), tickformat=".0f"
    )
    return Drawing(f"tension-{number}", f"Tension along the {wire.name}", _HEIGHT, data, layout)


def _tension_range(tension: FloatArray, wanted: float) -> list[float]:
    """Return what the upright axis shows: at least 2 per mille of the tension, not noise."""
    low, high = min(float(tension.min()), wanted), max(float(tension.max()), wanted)
    margin = max(0.06 * (high - low), 1e-3 * wanted)
    return [low - margin, high + margin]
