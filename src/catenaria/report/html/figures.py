"""The figures of a page over the length of a line: profile, height errors, plan, tensions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html import drawing
from catenaria.report.html.drawing import Drawing, Trace, colour, wire_colour
from catenaria.report.html.marks import arm_traces, dropper_points, dropper_traces, mass_traces
from catenaria.report.html.thinning import INTERVALS, simplified, thinned
from catenaria.report.html.windows import MOST, Window, extent, support_places, windows
from catenaria.results import FormResult, Profile, WireForm

__all__ = [
    "extent",
    "height_figures",
    "plan_figures",
    "profile_figures",
    "support_places",
    "tension_figures",
]

FloatArray = NDArray[np.float64]
Drawer = Callable[[Window], list[Trace]]

_HEIGHT = 320
_MARGIN = 0.012  # of a figure's width on either side, for marks and names at its edges
_IN_PLANE = 1e-6  # m
_THIN, _THICK = 1.8, 4.0  # width of lines [px]
_FEWEST = 8  # intervals or points of a short wire
_LEAST = 100  # points of a wire as long as the figure
_ONCE = ("stitch wire", "mid-point anchor")  # roles of which there are many wires: one trace for all


def profile_figures(result: FormResult, most: float = MOST, tolerance: float | None = None) -> list[Drawing]:
    """Draw the heights of all wires with their droppers, seen from the side, `most` metres in one figure.

    Points that straight lines between the others meet within a tolerance [m], if there is one, are left out.
    """
    height = _Across(lambda profile: profile.height, tolerance)

    def draw(window: Window) -> list[Trace]:
        wires = _wires(result.wires, window, height)
        return [*wires, *dropper_traces(result, window), *mass_traces(result, window)]

    return list(_in_windows(result, "profile", "Heights of all wires", "height [m]", draw, most))


def height_figures(result: FormResult, tolerance: float | None) -> list[Drawing]:
    """Draw contact wires above what is wanted at droppers, with the tolerance there [m]."""

    def draw(window: Window) -> list[Trace]:
        return _above_wanted(result, window, tolerance)

    title = "Contact wire against wanted heights"
    return list(_in_windows(result, "heights", title, "above wanted [mm]", draw, MOST))


def plan_figures(result: FormResult, most: float = MOST, tolerance: float | None = None) -> list[Drawing]:
    """Draw the lateral offsets of all wires with arms, seen from above; nothing if all lie in one plane.

    Notes
    -----
    Where wires are above each other, the contact wire is drawn on those that carry it, which are broader.
    """
    if all(float(np.abs(wire.profile.lateral).max()) < _IN_PLANE for wire in result.wires):
        return []
    lateral = _Across(lambda profile: profile.lateral, tolerance)

    def draw(window: Window) -> list[Trace]:
        axis = drawing.line(
            np.array(window.extent), np.zeros(2), "track", colour("quiet"), "", width=1.0, dash="dash"
        )
        silent = axis | {"hoverinfo": "skip", "hovertemplate": None}
        contact = [wire for wire in result.wires if wire.role == "contact wire"]
        above = [wire for wire in result.wires if wire.role != "contact wire"]
        lines = [
            *_wires(above, window, lateral, _THICK),
            *_wires(contact, window, lateral),
        ]
        return [silent, *lines, *arm_traces(result, window)]

    return list(_in_windows(result, "plan", "Lateral offsets of all wires", "to the left [m]", draw, most))


def tension_figures(result: FormResult, tolerance: float | None = None) -> list[Drawing]:
    """Draw the tension along every wire that supports hold; the tolerance is a part of its range."""
    wires = [wire for wire in result.wires if wire.name in result.supports.wire]
    return [_tension(result, wire, number, tolerance) for number, wire in enumerate(wires, start=1)]


def with_margins(extent: tuple[float, float]) -> tuple[float, float]:
    """Return what an axis shows of a part of a line.

    Examples
    --------
    >>> with_margins((0.0, 100.0))
    (-1.2, 101.2)
    """
    margin = _MARGIN * (extent[1] - extent[0])
    return extent[0] - margin, extent[1] + margin


def _in_windows(
    result: FormResult, name: str, title: str, quantity: str, draw: Drawer, most: float
) -> Iterator[Drawing]:
    """Draw the parts of a line below each other to the same scale."""
    parts = windows(result, most)
    traces = [draw(window) for window in parts]
    low, high = _reach([trace for part in traces for trace in part])
    supports = support_places(result)
    for number, (window, data) in enumerate(zip(parts, traces, strict=True), start=1):
        label = title if len(parts) == 1 else f"{title}, {window.label}"
        layout = drawing.layout(with_margins(window.extent), quantity, supports, range=[low, high])
        yield Drawing(f"{name}-{number}", label, _HEIGHT, data, layout)


def _reach(traces: list[Trace]) -> tuple[float, float]:
    y = [value for trace in traces for value in trace["y"] if value is not None]
    low, high = min(y, default=0.0), max(y, default=0.0)
    margin = 0.06 * (high - low) or 0.1
    return low - margin, high + margin


@dataclass(frozen=True)
class _Across:
    """What of a wire is drawn over the chainage, and how far what is drawn may be off it, if at all."""

    of: Callable[[Profile], FloatArray]
    tolerance: float | None

    def points(self, wire: WireForm, window: Window) -> FloatArray:
        """Return chainage, what is drawn, and what is said of each point, and a gap behind the last one."""
        profile = wire.profile
        here = np.flatnonzero(window.mask(profile.chainage))
        if not here.size:
            return np.empty((5, 0))
        x, y = profile.chainage[here], self.of(profile)[here]
        share = float(np.ptp(x)) / (window.extent[1] - window.extent[0])
        if self.tolerance is None:
            here = here[thinned(x, (y, profile.tension[here]), max(round(share * INTERVALS), _FEWEST))]
        else:
            here = here[simplified(x, y, self.tolerance, max(round(share * _LEAST), _FEWEST))]
        said = (profile.height[here], 1e3 * profile.lateral[here], profile.tension[here])
        drawn = np.stack((profile.chainage[here], self.of(profile)[here], *said))
        return np.pad(drawn, ((0, 0), (0, 1)), constant_values=np.nan)


_HOVER = (
    "chainage %{x:.2f} m<br>height %{customdata[0]:.4f} m<br>to the left %{customdata[1]:.1f} mm<br>"
    "tension %{customdata[2]:.0f} N"
)


def _wires(wires: Sequence[WireForm], window: Window, drawn: _Across, width: float = _THIN) -> list[Trace]:
    """Draw wires, many of one role in one trace with gaps between them, which browsers draw faster."""
    groups: dict[str, list[WireForm]] = {}
    for wire in wires:
        groups.setdefault(wire.role if wire.role in _ONCE else wire.name, []).append(wire)
    traces: list[Trace] = []
    for name, members in groups.items():
        parts = [part for wire in members if (part := drawn.points(wire, window)).shape[1] > 2]
        if parts:
            x, y, *extra = np.concatenate(parts, axis=1)[:, :-1]
            of = wire_colour(name, members[0].role)
            traces.append(drawing.line(x, y, name, of, _HOVER, extra=extra, width=width))
    return traces


def _above_wanted(result: FormResult, window: Window, tolerance: float | None) -> list[Trace]:
    contact = [wire for wire in result.wires if wire.role == "contact wire"]
    lines = [trace for wire in contact for trace in _line_above_wanted(result, wire, window)]
    droppers = result.droppers
    own = np.isin(droppers.lower_wire, [wire.name for wire in contact]) & window.mask(droppers.x)
    here = np.flatnonzero(own)
    error = 1e3 * droppers.height_error[here]
    marks = dropper_points(result, here, error, "at droppers", colour("ink"))
    return [*([] if tolerance is None else _band(window, 1e3 * tolerance)), *lines, marks]


def _line_above_wanted(result: FormResult, wire: WireForm, window: Window) -> list[Trace]:
    """Draw a contact wire between its first and its last dropper."""
    droppers, profile = result.droppers, wire.profile
    own = np.flatnonzero([name == wire.name for name in droppers.lower_wire])
    if own.size < 2:
        return []
    own = own[np.argsort(droppers.x[own], kind="stable")]
    x = droppers.x[own]
    inside = (profile.chainage >= x[0]) & (profile.chainage <= x[-1]) & window.mask(profile.chainage)
    here = np.flatnonzero(inside)
    if not here.size:
        return []
    at = profile.chainage[here]
    above = 1e3 * (profile.height[here] - np.interp(at, x, droppers.target_height[own]))
    kept = thinned(at, (above,))
    hover = (
        "chainage %{x:.2f} m<br>%{y:.2f} mm above wanted<br>height %{customdata[0]:.4f} m<br>"
        "tension %{customdata[1]:.0f} N"
    )
    of, extra = wire_colour(wire.name, wire.role), (profile.height[here][kept], profile.tension[here][kept])
    return [drawing.line(at[kept], above[kept], wire.name, of, hover, extra=extra, digits=4)]


def _band(window: Window, half: float) -> list[Trace]:
    x, name = np.array(window.extent), f"tolerance at droppers: ±{half:g} mm"
    low = drawing.line(
        x, np.full(2, -half), name, colour("band-edge"), "", width=1.0, dash="dash", legend=False
    )
    high = drawing.line(x, np.full(2, half), name, colour("band-edge"), "", width=1.0, dash="dash")
    silent = {"hoverinfo": "skip", "hovertemplate": None}
    return [low | silent, high | silent | {"fill": "tonexty", "fillcolor": colour("band")}]


def _tension(result: FormResult, wire: WireForm, number: int, tolerance: float | None) -> Drawing:
    profile, wanted = wire.profile, wire.target_tension
    if tolerance is None:
        kept = thinned(profile.chainage, (profile.tension, profile.moment), most=1500)
    else:
        kept = simplified(profile.chainage, profile.tension, tolerance * float(np.ptp(profile.tension)))
    x, tension = profile.chainage[kept], profile.tension[kept]
    hover = (
        "chainage %{x:.2f} m<br>tension %{y:.1f} N<br>height %{customdata[0]:.4f} m<br>"
        "moment %{customdata[1]:.3g} N m"
    )
    extra = (profile.height[kept], profile.moment[kept])
    whole = extent(result)
    level = np.array(whole)
    held, own = np.full(2, wanted), wire_colour(wire.name, wire.role)
    label, quiet = f"wanted: {wanted:.0f} N", colour("quiet")
    data = [
        drawing.line(level, held, label, quiet, "wanted %{y:.1f} N", dash="dash", width=1.2),
        drawing.line(x, tension, wire.name, own, hover, extra=extra, digits=1),
    ]
    shown = _tension_range(tension, wanted)
    layout = drawing.layout(
        with_margins(whole), "tension [N]", support_places(result), range=shown, tickformat=".0f"
    )
    return Drawing(f"tension-{number}", f"Tension along the {wire.name}", _HEIGHT, data, layout)


def _tension_range(tension: FloatArray, wanted: float) -> list[float]:
    """Return what the upright axis shows: at least 2 per mille of the tension, not noise."""
    low, high = min(float(tension.min()), wanted), max(float(tension.max()), wanted)
    margin = max(0.06 * (high - low), 1e-3 * wanted)
    return [low - margin, high + margin]
