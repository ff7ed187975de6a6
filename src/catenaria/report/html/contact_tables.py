"""The tables of contact wires, span by span: heights, gradients, lowest points, sags, lateral offsets."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from catenaria.line import Line
from catenaria.report.checks.formulas import gradients
from catenaria.report.html.table import Table, column
from catenaria.results import FormResult, WireForm

FloatArray = NDArray[np.float64]

_MOST_OPEN = 30  # rows: longer tables are folded


def contact_tables(result: FormResult, line: Line) -> list[Table]:
    """Return a table for each contact wire, with a row for each span."""
    wires = [wire for wire in result.wires if wire.role == "contact wire"]
    return [_table(result, line, wire) for wire in wires]


def _table(result: FormResult, line: Line, wire: WireForm) -> Table:
    x, profile = np.array(line.support_x), wire.profile
    names = [support.name for support in line.supports]
    z = np.interp(x, profile.chainage, profile.height)
    slope = gradients(x, z)
    between = [(profile.chainage >= a) & (profile.chainage <= b) for a, b in pairwise(x)]
    lowest = [np.flatnonzero(here)[np.argmin(profile.height[here])] for here in between]
    depth = _depth(result, wire)
    aside = [float(profile.lateral[here][np.argmax(np.abs(profile.lateral[here]))]) for here in between]
    return Table(
        f"{wire.name[:1].upper()}{wire.name[1:]} by span",
        (
            column("span", "", range(1, x.size)),
            column("from", "", names[:-1]),
            column("to", "", names[1:]),
            column("height at start", "m", z[:-1], ".4f"),
            column("at end", "m", z[1:], ".4f"),
            column("gradient", "‰", 1e3 * slope, ".2f"),
            column("change at start", "‰", 1e3 * np.diff(slope, prepend=np.nan), ".2f"),
            column("lowest", "m", profile.height[lowest], ".4f"),
            column("at chainage", "m", profile.chainage[lowest], ".2f"),
            column("sag between droppers", "mm", [1e3 * depth[here].max() for here in between], ".1f"),
            column("furthest aside", "mm", [1e3 * b for b in aside], ".0f"),
        ),
        open=x.size - 1 <= _MOST_OPEN,
    )


def _depth(result: FormResult, wire: WireForm) -> FloatArray:
    """Return how far a wire is below the line through neighbouring droppers and supports that hold it [m]."""
    droppers, held, profile = result.droppers, result.supports, wire.profile
    carried = np.array([name == wire.name for name in droppers.lower_wire], dtype=np.bool_)
    holds = np.array([name == wire.name for name in held.wire], dtype=np.bool_)
    x = np.concatenate([droppers.x[carried], held.chainage[holds]])
    z = np.concatenate([droppers.height[carried], held.height[holds]])
    order = np.argsort(x, kind="stable")
    return np.interp(profile.chainage, x[order], z[order]) - profile.height
