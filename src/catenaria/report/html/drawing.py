"""Figures for Plotly as plain data: traces, layouts, and colours that follow the theme of the page.

A colour is the name of a property of the style sheet, ``var(--contact)``: the page's script puts in what it
is when it draws, so that one figure serves light, dark and paper.
"""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Trace = dict[str, Any]

_CLEAR = "rgba(0,0,0,0)"
_MOST_NAMES = 12  # of supports above one panel; of more, every second one is named, or every third...
_COLOURS = {
    "contact wire": "contact",
    "second contact wire": "second",
    "auxiliary messenger": "auxiliary",
    "messenger wire": "messenger",
    "stitch wire": "stitch",
    "mid-point anchor": "anchor",
}


@dataclass(frozen=True)
class Drawing:
    """One figure.

    Attributes
    ----------
    id : str
        Of its place in the page.
    label : str
        What it shows, for those who cannot see it.
    height : int
        On the screen [px].
    data, layout
        What Plotly draws.
    """

    id: str
    label: str
    height: int
    data: list[Trace]
    layout: dict[str, Any]


def colour(name: str) -> str:
    """Return a colour of the style sheet.

    Examples
    --------
    >>> colour("ink")
    'var(--ink)'
    """
    return f"var(--{name})"


def wire_colour(name: str, role: str) -> str:
    """Return the colour of a wire by its name or, of many of one role, by their role."""
    return colour(_COLOURS.get(name, _COLOURS.get(role, "ink")))


def plain(text: str) -> str:
    """Return a text in which Plotly finds no tags."""
    return html.escape(text, quote=False)


def numbers(values: FloatArray, digits: int) -> list[float | None]:
    """Return rounded numbers, which take fewer letters; what is not a number leaves a gap."""
    rounded: list[float] = (np.round(values, digits) + 0.0).tolist()
    return [value if value == value else None for value in rounded]


def line(
    x: FloatArray,
    y: FloatArray,
    name: str,
    of: str,
    hover: str,
    *,
    extra: Sequence[FloatArray] = (),
    digits: int = 5,
    width: float = 1.8,
    dash: str = "solid",
    legend: bool = True,
) -> Trace:
    """Return a line with what is said of its points; `extra` are further numbers for that."""
    trace: Trace = {
        "type": "scatter",
        "mode": "lines",
        "name": plain(name),
        "legendgroup": plain(name),
        "showlegend": legend,
        "x": numbers(x, 3),
        "y": numbers(y, digits),
        "line": {"color": of, "width": width, "dash": dash},
        "hovertemplate": f"<b>{plain(name)}</b><br>{hover}<extra></extra>",
    }
    return trace | _customdata(extra)


def points(
    x: FloatArray,
    y: FloatArray,
    name: str,
    of: str,
    texts: Sequence[str],
    hover: str = "%{text}",
    *,
    extra: Sequence[FloatArray] = (),
    symbol: str = "circle",
    size: int = 6,
    legend: bool = True,
) -> Trace:
    """Return separate points, each with a text for what is said of it; `extra` are numbers for that."""
    trace: Trace = {
        "type": "scatter",
        "mode": "markers",
        "name": plain(name),
        "legendgroup": plain(name),
        "showlegend": legend,
        "x": numbers(x, 3),
        "y": numbers(y, 5),
        "marker": {"color": of, "size": size, "symbol": symbol},
        "text": list(texts),
        "hovertemplate": f"{hover}<extra></extra>",
    }
    return trace | _customdata(extra)


def _customdata(extra: Sequence[FloatArray]) -> Trace:
    return {"customdata": list(zip(*(numbers(values, 4) for values in extra), strict=True))} if extra else {}


def bars(
    x: FloatArray,
    low: FloatArray,
    high: FloatArray,
    name: str,
    of: str,
    texts: Sequence[str] = (),
    hover: str = "",
    *,
    extra: Sequence[FloatArray] = (),
    size: int = 0,
    legend: bool = True,
) -> Trace:
    """Return upright lines, all in one trace, with marks of a size at their ends and `texts` as of points."""
    gap = np.full(x.size, np.nan)
    trace: Trace = {
        "type": "scatter",
        "mode": "lines+markers" if size else "lines",
        "name": plain(name),
        "legendgroup": plain(name),
        "showlegend": legend,
        "x": numbers(np.column_stack((x, x, gap)).ravel(), 3),
        "y": numbers(np.column_stack((low, high, gap)).ravel(), 5),
        "line": {"color": of, "width": 1.3},
    }
    if size:
        trace["marker"] = {"color": of, "size": size}
    if not texts:
        return trace | {"hoverinfo": "skip"}
    said = {"text": [text for text in texts for _ in range(3)], "hovertemplate": f"{hover}<extra></extra>"}
    return trace | said | _customdata([np.repeat(values, 3) for values in extra])


def layout(
    x: tuple[float, float], quantity: str, supports: Mapping[str, float], **more: Any
) -> dict[str, Any]:
    """Return axes with chainage below, and marks of supports.

    Parameters
    ----------
    x : tuple of float
        First and last chainage [m].
    quantity : str
        Label of the upright axis.
    supports : mapping of str to float
        Chainages by name [m].
    **more
        Further properties of the upright axis.
    """
    here = sorted((at, name) for name, at in supports.items() if x[0] <= at <= x[1])
    named = here[:: max(-(-len(here) // _MOST_NAMES), 1)]
    axis = {"gridcolor": colour("grid"), "linecolor": colour("grid"), "zeroline": False, "ticks": "outside"}
    axis |= {"tickcolor": colour("grid")}
    return {
        "xaxis": axis | {"title": {"text": "chainage [m]"}, "range": list(x), "showgrid": False},
        "yaxis": axis | {"title": {"text": quantity, "standoff": 8}, "automargin": True} | more,
        "shapes": [_upright(at) for at, _ in here],
        "annotations": [_name(name, at) for at, name in named],
        "hovermode": "closest",
        "dragmode": "zoom",
        "font": {"family": "system-ui, sans-serif", "size": 12, "color": colour("ink")},
        "paper_bgcolor": _CLEAR,
        "plot_bgcolor": _CLEAR,
        "hoverlabel": {
            "bgcolor": colour("card"),
            "bordercolor": colour("line"),
            "font": {"color": colour("ink")},
            "align": "left",
        },
        "modebar": {"bgcolor": _CLEAR, "color": colour("line"), "activecolor": colour("ink")},
        "legend": {"orientation": "h", "x": 0, "y": 1.12, "xanchor": "left", "yanchor": "bottom"},
        "margin": {"l": 64, "r": 16, "t": 64, "b": 44},
    }


def _upright(x: float) -> dict[str, Any]:
    style = {"color": colour("line"), "width": 1, "dash": "dot"}
    return {
        "type": "line", "xref": "x", "yref": "paper", "x0": x, "x1": x, "y0": 0, "y1": 1, "line": style,
        "layer": "below",
    }  # fmt: skip


def _name(name: str, x: float) -> dict[str, Any]:
    return {
        "text": plain(name), "x": x, "y": 1, "xref": "x", "yref": "paper", "yanchor": "bottom",
        "showarrow": False, "font": {"size": 11, "color": colour("quiet")},
    }  # fmt: skip
