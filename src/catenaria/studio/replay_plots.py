"""Figures of a replay: the wires in one of the states that were filmed, and the course of control errors."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html import drawing
from catenaria.report.html.drawing import Drawing, Trace, colour, wire_colour
from catenaria.results.film import Film
from catenaria.studio.plots import Figure, as_figure

FloatArray = NDArray[np.float64]

_SMALL: Final = {"N": 1e-3, "mm": 1e-6}  # errors below are drawn there, for the axis is logarithmic


def frame_count(films: Sequence[Film]) -> int:
    """Return the number of states of all films, one after the other."""
    return sum(film.time.size for film in films)


def places(films: Sequence[Film], frame: int) -> list[int]:
    """Return the state that each film is in: films before the running one are over, those after it wait.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> films = [SimpleNamespace(time=np.arange(n)) for n in (3, 4)]
    >>> places(films, 1), places(films, 4)
    ([1, 0], [2, 1])
    """
    begins = accumulate((film.time.size for film in films), initial=0)
    return [
        min(max(frame - begin, 0), film.time.size - 1) for film, begin in zip(films, begins, strict=False)
    ]


def running(films: Sequence[Film], frame: int) -> int:
    """Return the index of the film that a frame belongs to."""
    ends = accumulate(film.time.size for film in films)
    return next((i for i, end in enumerate(ends) if frame < end), len(films) - 1)


def frame_figure(films: Sequence[Film], frame: int, dark: bool) -> Figure:
    """Draw all wires and dropper cables in one state."""
    data = [trace for film, at in zip(films, places(films, frame), strict=True) for trace in _state(film, at)]
    heights = np.concatenate([film.position[:, :, 2].ravel() for film in films])
    chainages = np.concatenate([film.position[:, :, 0].ravel() for film in films])
    low, high = float(heights.min()), float(heights.max())
    margin = 0.06 * (high - low) or 0.1
    window = (float(chainages.min()), float(chainages.max()))
    layout = drawing.layout(window, "height [m]", {}, range=[low - margin, high + margin])
    return as_figure(Drawing("replay", "Motion", 300, data, layout), dark)


def error_figure(films: Sequence[Film], frame: int, dark: bool) -> Figure:
    """Draw the largest control error of either kind in every state, and where the replay is."""
    tension = np.concatenate([largest(film, tensions=True) for film in films])
    droppers = [largest(film, tensions=False) for film in films]
    x = np.arange(tension.size, dtype=np.float64)
    hover = "state %{x:.0f}<br>%{y:.3g}"
    data = [drawing.line(x, _drawn(tension, "N"), "tension [N]", colour("ink"), hover, digits=6)]
    begin = 0
    for film, error, of in zip(films, droppers, ("dropper", "messenger"), strict=False):
        unit = "mm" if _unit(film) == "m" else "N"
        name = "height at droppers [mm]" if unit == "mm" else "force of droppers [N]"
        at = x[begin : begin + film.time.size]
        data.append(drawing.line(at, _drawn(error, unit), name, colour(of), hover, digits=9))
        begin += film.time.size
    layout = drawing.layout(
        (0.0, float(max(x.size - 1, 1))), "largest error", {" ": float(frame)}, type="log"
    )
    layout["xaxis"]["title"] = {"text": "state of the replay"}
    return as_figure(Drawing("errors", "Control errors", 240, data, layout), dark)


def told(films: Sequence[Film], frame: int) -> str:
    """Say in words what one state shows."""
    number = running(films, frame)
    film, at = films[number], places(films, frame)[number]
    parts = [f"{film.step}, {film.time[at]:.1f} s", f"tension error {largest(film, tensions=True)[at]:.1f} N"]
    error = float(largest(film, tensions=False)[at])
    if _unit(film) == "m":
        parts.append(f"height error {error:.3f} mm")
    elif _unit(film):
        parts.append(f"dropper force error {error:.2f} N")
    return " · ".join(parts)


def largest(film: Film, *, tensions: bool) -> FloatArray:
    """Return the largest error of the tension, or of the droppers, in every state [N or mm]."""
    own = [i for i, name in enumerate(film.control_name) if name.endswith(" tension") == tensions]
    if not own:
        return np.zeros(film.time.size)
    factor = 1e3 if film.control_unit[own[0]] == "m" else 1.0
    return factor * np.abs(film.error[:, own]).max(axis=1)


def _unit(film: Film) -> str:
    units = [
        unit
        for name, unit in zip(film.control_name, film.control_unit, strict=True)
        if not name.endswith(" tension")
    ]
    return units[0] if units else ""


def _drawn(error: FloatArray, unit: str) -> FloatArray:
    return np.maximum(error, _SMALL[unit])


def _state(film: Film, at: int) -> list[Trace]:
    """Draw a wire and the cables of its droppers in one state."""
    x, z = film.position[at, :, 0], film.position[at, :, 2]
    own = int(film.node_count[0])
    hover = "x %{x:.2f} m<br>height %{y:.4f} m"
    wire = drawing.line(x[:own], z[:own], film.step, wire_colour(film.step, film.step), hover)
    # A gap between two cables: Plotly breaks a line where a number is missing.
    breaks = np.cumsum(film.node_count[1:])[:-1]
    cables: dict[str, Any] = drawing.line(
        np.insert(x[own:], breaks, np.nan),
        np.insert(z[own:], breaks, np.nan),
        f"dropper cables of the {film.step}",
        colour("dropper"),
        hover,
        width=1.2,
    )
    return [cables, wire] if film.node_count.size > 1 else [wire]
