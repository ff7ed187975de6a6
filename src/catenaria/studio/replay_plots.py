"""Figures of a replay: the line in one of the states that were filmed, and the course of control errors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import accumulate
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html import drawing
from catenaria.report.html.drawing import Drawing, Trace, colour, wire_colour
from catenaria.report.html.thinning import thinned
from catenaria.results.film import Film, Polylines
from catenaria.studio.plots import Figure, as_figure

FloatArray = NDArray[np.float64]
Across = Callable[[Polylines], FloatArray]

_MOST: Final = 300  # parts of a wire of which each keeps its extremes: a frame has to be small
_IN_PLANE: Final = 1e-6  # m
_HOVER: Final = "chainage %{x:.2f} m<br>%{y:.4f} m"

# How the error of what is controlled is called, drawn and told: label, colour, digits.
_ERRORS: Final[Mapping[str, tuple[str, str, int]]] = {
    "tension": ("tension", "ink", 1),
    "height": ("height at droppers", "dropper", 3),
    "dropper force": ("force of droppers", "messenger", 2),
}
_SHOWN_UNIT: Final = {"N": ("N", 1.0, 1e-3), "m": ("mm", 1e3, 1e-4)}  # errors below the last are drawn there


def frame_count(films: Sequence[Film]) -> int:
    """Return the number of states of all films, one after the other."""
    return sum(film.time.size for film in films)


def running(films: Sequence[Film], frame: int) -> tuple[int, int]:
    """Return the film that a frame belongs to, and its state there.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> films = [SimpleNamespace(time=np.arange(n)) for n in (3, 4)]
    >>> running(films, 1), running(films, 4)
    ((0, 1), (1, 1))
    """
    begins = list(accumulate((film.time.size for film in films), initial=0))
    number = int(np.searchsorted(begins[1:-1], frame, side="right"))
    return number, frame - begins[number]


def places(films: Sequence[Film], frame: int) -> list[tuple[Film, int]]:
    """Return the films to be drawn and the states that they are in.

    Wires that do not move in the running film have done so, or wait for theirs; of several films of the same
    wires there is only the running one.
    """
    number, at = running(films, frame)
    moving = set(films[number].wire)
    drawn: list[tuple[Film, int]] = []
    for i, film in enumerate(films):
        if i == number:
            drawn.append((film, at))
        elif moving.isdisjoint(film.wire):
            drawn.append((film, film.time.size - 1 if i < number else 0))
    return drawn


def frame_figures(
    films: Sequence[Film], frame: int, supports: Mapping[str, float], dark: bool
) -> list[Figure]:
    """Draw all wires and droppers in one state: their heights, and in space also their lateral offsets.

    Parameters
    ----------
    films : sequence of Film
        All films of one line.
    frame : int
        From 0 to `frame_count` - 1.
    supports : mapping of str to float
        Chainages by name [m].
    dark : bool
        For which theme.
    """
    shown = places(films, frame)
    data = _named_once(trace for film, at in shown for trace in _state(film, at, _height, droppers=True))
    layout = _axes(films, _height, "height [m]", supports)
    figures = [Drawing("replay", "Motion, seen from the side", 270, data, layout)]
    if any(float(np.abs(film.wires.lateral).max()) > _IN_PLANE for film in films):
        layout = _axes(films, _lateral, "to the left [m]", supports)
        ends: FloatArray = np.array(layout["xaxis"]["range"])
        track = drawing.line(ends, np.zeros(2), "track", colour("quiet"), "", width=1.0, dash="dash")
        silent: Trace = {"hoverinfo": "skip", "hovertemplate": None}
        wires = _named_once(trace for film, at in shown for trace in _state(film, at, _lateral))
        figures.append(
            Drawing("replay-plan", "Motion, seen from above", 220, [track | silent, *wires], layout)
        )
    return [as_figure(one, dark) for one in figures]


def error_figure(films: Sequence[Film], frame: int, dark: bool) -> Figure:
    """Draw the largest control error of every kind in all states, and where the replay is."""
    begins = list(accumulate((film.time.size for film in films), initial=0))
    count = begins.pop()
    x = np.arange(count, dtype=np.float64)
    data: list[Trace] = []
    for quantity, (label, of, _) in _ERRORS.items():
        drawn, unit = np.full(count, np.nan), ""
        for film, begin in zip(films, begins, strict=True):
            if quantity in film.control_quantity:
                error, unit, least = _largest(film, quantity)
                drawn[begin : begin + error.size] = np.maximum(error, least)
        if unit:
            hover = f"state %{{x:.0f}}<br>%{{y:.3g}} {unit}"
            data.append(drawing.line(x, drawn, f"{label} [{unit}]", colour(of), hover, digits=9))
    motions = {film.step: float(begin) for film, begin in zip(films, begins, strict=True)}
    if len(films) == 1:
        motions = {}
    window = -0.5, count - 0.5
    layout = drawing.layout(window, "largest error", motions, type="log", exponentformat="none")
    layout["xaxis"]["title"] = {"text": "state of the replay"}
    layout["annotations"] = [note | {"xanchor": "left"} for note in layout["annotations"]]
    style = {"color": colour("ink"), "width": 1.5}
    cursor = {"type": "line", "xref": "x", "yref": "paper", "x0": frame, "x1": frame, "y0": 0, "y1": 1}
    layout["shapes"] = [*layout["shapes"], cursor | {"line": style}]
    return as_figure(Drawing("errors", "Control errors", 230, data, layout), dark)


def told(films: Sequence[Film], frame: int) -> str:
    """Say in words what one state shows."""
    number, at = running(films, frame)
    film = films[number]
    motion = f"{number + 1} of {len(films)}: " if len(films) > 1 else ""
    parts = [f"{motion}{film.step}, {film.time[at]:.1f} s"]
    if film.gravity[at] < 1.0:
        part = film.gravity[at]
        parts.append(f"{100.0 * part:.0f} % of gravity" if part > 0.0 else "without gravity")
    for quantity, (_, _, digits) in _ERRORS.items():
        if quantity in film.control_quantity:
            error, unit, _ = _largest(film, quantity)
            parts.append(f"{quantity} error {error[at]:.{digits}f} {unit}")
    if at == film.time.size - 1:
        parts.append("at rest")
    return " · ".join(parts)


def _largest(film: Film, quantity: str) -> tuple[FloatArray, str, float]:
    """Return the largest error of one kind in every state, its unit, and what is too small to be drawn."""
    own = [i for i, of in enumerate(film.control_quantity) if of == quantity]
    unit, factor, least = _SHOWN_UNIT[film.control_unit[own[0]]]
    return factor * np.abs(film.error[:, own]).max(axis=1), unit, least


def _height(lines: Polylines) -> FloatArray:
    return lines.height


def _lateral(lines: Polylines) -> FloatArray:
    return lines.lateral


def _axes(
    films: Sequence[Film], across: Across, quantity: str, supports: Mapping[str, float]
) -> dict[str, Any]:
    """Return axes that hold every state."""
    lines = [part for film in films for part in (film.wires, film.droppers) if part.node_count.size]
    x, y = [part.chainage for part in lines], [across(part) for part in lines]
    low, high = min(float(part.min()) for part in y), max(float(part.max()) for part in y)
    margin = 0.06 * (high - low) or 0.1
    window = min(float(part.min()) for part in x), max(float(part.max()) for part in x)
    return drawing.layout(window, quantity, supports, range=[low - margin, high + margin], automargin=False)


def _state(film: Film, at: int, across: Across, *, droppers: bool = False) -> Iterator[Trace]:
    """Draw all droppers in one line with gaps, and so all wires of one colour, named by their role then."""
    if droppers and film.droppers.node_count.size:
        lines, breaks = film.droppers, np.cumsum(film.droppers.node_count)[:-1]
        x, y = (np.insert(values[at], breaks, np.nan) for values in (lines.chainage, across(lines)))
        name = "dropper" if bool(np.all(lines.node_count == 2)) else "dropper cable"
        yield drawing.line(x, y, name, colour("dropper"), _HOVER, digits=4, width=1.0)
    of_colour: dict[str, list[int]] = {}
    for i, (name, role) in enumerate(zip(film.wire, film.role, strict=True)):
        of_colour.setdefault(wire_colour(name, role), []).append(i)
    for of, which in of_colour.items():
        x, y = _with_gaps([_wire(film.wires, i, at, across) for i in which])
        name = (film.wire if len(which) == 1 else film.role)[which[0]]
        yield drawing.line(x, y, name, of, _HOVER, digits=4)


def _wire(lines: Polylines, wire: int, at: int, across: Across) -> FloatArray:
    """Return the points of a wire that are drawn, shape (n, 2)."""
    own = lines.nodes(wire)
    x, y = lines.chainage[at, own], across(lines)[at, own]
    return np.column_stack((x, y))[thinned(x, (y,), _MOST)]


def _with_gaps(lines: Sequence[FloatArray]) -> FloatArray:
    """Return lines one after the other, shape (2, n); Plotly breaks a line where a number is missing."""
    gap = np.full((1, 2), np.nan)
    return np.concatenate([part for line in lines for part in (line, gap)][:-1]).T


def _named_once(traces: Iterator[Trace]) -> list[Trace]:
    """Return traces of which those with the same name have one label."""
    there: set[str] = set()
    named: list[Trace] = []
    for trace in traces:
        named.append(trace | {"showlegend": trace["name"] not in there})
        there.add(trace["name"])
    return named
