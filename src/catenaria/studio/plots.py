"""Figures of the studio: those of the report in one piece each, and a variant drawn over them."""

from __future__ import annotations

import math
from base64 import b64encode
from typing import Any, Final

import numpy as np

from catenaria.report.html import drawing
from catenaria.report.html.drawing import Drawing, Trace, colour
from catenaria.report.html.figures import (
    extent,
    plan_figures,
    profile_figures,
    support_places,
    tension_figures,
)
from catenaria.report.html.thinning import simplified
from catenaria.results import FormResult
from catenaria.studio.compare import Differences, differences
from catenaria.studio.palette import coloured

Figure = dict[str, Any]

_NUMBERS: Final = {"x": "f8", "y": "f4", "customdata": "f4"}  # chainages have more digits
_OFF: Final = 1e-3  # m that lines which are drawn anew after every edit may be off: a tenth of a pixel
_PART: Final = 2e-3  # by which they may be off, of the range of what they show

# Not "responsive": figures in a tab that is being closed would be resized, which Plotly refuses. No list of
# all buttons either: Plotly puts objects into it, with which NiceGUI's comparison of settings does not end.
_CONFIG: Final = {
    "responsive": False,
    "displaylogo": False,
    "plotlyServerURL": "",
    "modeBarButtonsToRemove": ["select2d", "lasso2d", "autoScale2d"],
}


def as_figure(one: Drawing, dark: bool) -> Figure:
    """Return what Plotly draws; zooming stays as it is while data change."""
    layout = coloured(one.layout, dark) | {"height": one.height, "uirevision": one.id, "autosize": True}
    data = [packed(coloured(trace, dark)) for trace in one.data]
    return {"data": data, "layout": layout, "config": _CONFIG}


def packed(trace: Trace) -> Trace:
    """Return a trace whose numbers are written as bytes, which a browser reads and draws in half the time.

    Examples
    --------
    >>> packed({"mode": "lines", "x": [1.0, None]})["x"]
    {'dtype': 'f8', 'bdata': 'AAAAAAAA8D8AAAAAAAD4fw=='}
    """
    return trace | {key: _bytes(trace[key], kind) for key, kind in _NUMBERS.items() if key in trace}


def _bytes(values: list[Any], kind: str) -> dict[str, str]:
    array = np.array(values, dtype=f"<{kind}")
    shape = {"shape": ", ".join(map(str, array.shape))} if array.ndim > 1 else {}
    return {"dtype": kind, "bdata": b64encode(array.tobytes()).decode()} | shape


def profile_plot(result: FormResult, variant: FormResult | None, dark: bool) -> Figure:
    """Draw the heights of all wires, and of a variant behind them."""
    (one,) = profile_figures(result, math.inf, _OFF)
    return as_figure(_over(one, variant, "height"), dark)


def plan_plot(result: FormResult, variant: FormResult | None, dark: bool) -> Figure | None:
    """Draw the lateral offsets of all wires, and of a variant; nothing for lines in a plane."""
    drawings = plan_figures(result, math.inf, _OFF)
    return as_figure(_over(drawings[0], variant, "lateral"), dark) if drawings else None


def tension_plots(result: FormResult, dark: bool) -> list[Figure]:
    """Draw the tension along every wire that supports hold."""
    return [as_figure(one, dark) for one in tension_figures(result, _PART)]


def difference_plots(result: FormResult, variant: FormResult, dark: bool) -> list[Figure]:
    """Draw by how much droppers are longer and the contact wire is higher than in a variant."""
    found, supports, window = differences(result, variant), support_places(result), extent(result)
    lengths = drawing.points(
        found.x, found.cut_length, "droppers", colour("dropper"), _told(found), size=7, legend=False
    )
    stems = drawing.bars(
        found.x, np.zeros(found.x.size), found.cut_length, "droppers", colour("dropper"), legend=False
    )
    reach = float(np.ptp(found.height)) if found.height.size else 0.0  # lines may have no chainage in common
    kept = simplified(found.chainage, found.height, _PART * reach)
    height = drawing.line(
        found.chainage[kept],
        found.height[kept],
        "contact wire",
        colour("contact"),
        "chainage %{x:.2f} m<br>%{y:.2f} mm higher",
        digits=4,
        legend=False,
    )
    parts: list[tuple[str, str, list[Trace]]] = [
        ("longer", "dropper longer by [mm]", [stems, lengths]),
        ("higher", "contact wire higher by [mm]", [height]),
    ]
    return [
        as_figure(Drawing(name, title, 240, data, drawing.layout(window, title, supports)), dark)
        for name, title, data in parts
    ]


def _told(found: Differences) -> list[str]:
    return [
        f"<b>dropper {name}</b><br>{length:+.2f} mm longer<br>{height:+.2f} mm higher"
        for name, length, height in zip(
            found.dropper, found.cut_length.tolist(), found.dropper_height.tolist(), strict=True
        )
    ]


def _over(one: Drawing, variant: FormResult | None, across: str) -> Drawing:
    """Draw the wires of a variant behind a figure, dotted."""
    if variant is None:
        return one
    behind: list[Trace] = []
    for wire in variant.wires:
        x, y = wire.profile.chainage, getattr(wire.profile, across)
        kept = simplified(x, y, _OFF)
        hover = "chainage %{x:.2f} m<br>%{y:.4f} m"
        trace = drawing.line(
            x[kept],
            y[kept],
            "pinned variant",
            colour("quiet"),
            hover,
            width=1.2,
            dash="dot",
            legend=not behind,
        )
        behind.append(trace)
    return Drawing(one.id, one.label, one.height, [*behind, *one.data], one.layout)
