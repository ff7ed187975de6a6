"""The tables of a page: dropper schedule, wires, supports, arms, and where clamps sit on the wires."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html.table import Table, column
from catenaria.results import FormResult

_FOLDED_FROM = 5  # tables of one kind: more than these are folded


def dropper_tables(result: FormResult) -> list[Table]:
    """Return the dropper schedule, a table for each span."""
    spans = np.unique(result.droppers.span)
    few = spans.size < _FOLDED_FROM
    return [_dropper_table(result, int(span), few) for span in spans]


def _dropper_table(result: FormResult, span: int, unfolded: bool) -> Table:
    d = result.droppers
    own = np.flatnonzero(d.span == span)
    several = len(set(zip(d.lower_wire, d.upper_wire, strict=True))) > 1
    wires = [
        column("holds", "", [d.lower_wire[i] for i in own]),
        column("from", "", [d.upper_wire[i] for i in own]),
    ]
    return Table(
        f"Span {span}: {own.size} dropper{'s' if own.size != 1 else ''}",
        (
            column("dropper", "", d.number[own]),
            *(wires if several else []),
            column("chainage", "m", d.x[own], ".3f"),
            column("length", "m", d.length[own], ".4f"),
            column("cut to", "m", d.cut_length[own], ".4f"),
            column("unstressed", "m", d.unstressed_length[own], ".4f"),
            column("force above", "N", d.force_top[own], ".1f"),
            column("force below", "N", d.force_bottom[own], ".1f"),
            column("height", "m", d.height[own], ".4f"),
            column("error", "mm", 1e3 * d.height_error[own], ".3f"),
        ),
        open=unfolded,
    )


def wire_table(result: FormResult) -> Table:
    """Return lengths, tensions and sag of all wires."""
    wires = result.wires
    return Table(
        "",
        (
            column("wire", "", [wire.name for wire in wires]),
            column("unstressed length", "m", [wire.unstressed_length for wire in wires], ".4f"),
            column("stretched length", "m", [wire.stretched_length for wire in wires], ".4f"),
            column("wanted tension", "N", [wire.target_tension for wire in wires], ".1f"),
            column("tension", "N", [wire.tension for wire in wires], ".1f"),
            column("least", "N", [wire.tension_min for wire in wires], ".1f"),
            column("largest", "N", [wire.tension_max for wire in wires], ".1f"),
            column("travel", "mm", [1e3 * wire.travel for wire in wires], ".1f"),
            column("sag", "mm", [1e3 * wire.sag for wire in wires], ".2f"),
        ),
    )


def support_table(result: FormResult) -> Table:
    """Return where supports hold wires, and the forces on them."""
    held = result.supports
    return Table(
        "",
        (
            column("support", "", held.support),
            column("wire", "", held.wire),
            column("held by", "", held.kind),
            column("chainage", "m", held.chainage, ".2f"),
            column("stagger", "mm", 1e3 * held.stagger, ".0f"),
            column("height", "m", held.height, ".4f"),
            column("force along", "N", held.force_x, ".1f"),
            column("to the left", "N", held.force_lateral, ".1f"),
            column("upwards", "N", held.force_z, ".1f"),
        ),
    )


def arm_table(result: FormResult) -> Table:
    """Return geometry and forces of all steady arms."""
    arms = result.arms
    return Table(
        "",
        (
            column("support", "", arms.support),
            column("wire", "", arms.wire),
            column("kind", "", arms.registration),
            column("chainage", "m", arms.chainage, ".2f"),
            column("length", "m", arms.length, ".3f"),
            column("hinge aside", "mm", 1e3 * arms.hinge_stagger, ".0f"),
            column("hinge height", "m", arms.hinge_height, ".3f"),
            column("angle", "°", np.degrees(arms.angle), ".2f"),
            column("radial", "N", arms.radial, ".1f"),
            column("vertical", "N", arms.vertical, ".1f"),
            column("wanted", "N", arms.minimum_radial, ".0f"),
        ),
    )


def cantilever_table(result: FormResult) -> Table:
    """Return roots and forces of flexible cantilevers."""
    beams = result.cantilevers
    return Table(
        "",
        (
            column("support", "", beams.support),
            column("root height", "m", beams.root[:, 2], ".3f"),
            column("tip height", "m", beams.tip[:, 2], ".4f"),
            *(column(f"force {axis}", "N", beams.force[:, i], ".1f") for i, axis in enumerate("xyz")),
        ),
    )


def clamp_tables(result: FormResult) -> list[Table]:
    """Return, wire by wire, what is clamped to it and at which unstressed length from its start."""
    tables = (_clamp_table(result, wire.name) for wire in result.wires)
    return [table for table in tables if table.columns[0].cells]


def _clamp_table(result: FormResult, wire: str) -> Table:
    droppers, ties, masses = result.droppers, result.ties, result.masses
    named = [f"dropper {span}.{number}" for span, number in zip(droppers.span, droppers.number, strict=True)]
    parts = [
        _on(wire, droppers.lower_wire, named, droppers.x, droppers.contact_coordinate),
        _on(wire, droppers.upper_wire, named, droppers.x, droppers.messenger_coordinate),
        _on(wire, ties.host, list(ties.wire), ties.chainage, ties.coordinate),
        _on(wire, masses.wire, [name or "mass" for name in masses.name], masses.chainage, masses.coordinate),
        _on(
            wire,
            result.supports.wire,
            [f"support {name}" for name in result.supports.support],
            result.supports.chainage,
            result.supports.sliding_coordinate,
        ),
    ]
    rows = sorted((row for part in parts for row in part), key=lambda row: (row[2], row[0]))
    return Table(
        f"{wire[:1].upper()}{wire[1:]}: {len(rows)}",
        (
            column("clamp of", "", [row[0] for row in rows]),
            column("chainage", "m", [row[1] for row in rows], ".3f"),
            column("unstressed length from the wire's start", "m", [row[2] for row in rows], ".4f"),
        ),
        open=False,
    )


def _on(
    wire: str, wires: tuple[str, ...], names: list[str], x: NDArray[np.float64], s: NDArray[np.float64]
) -> list[tuple[str, float, float]]:
    rows = zip(wires, names, x.tolist(), s.tolist(), strict=True)
    return [(name, at, coordinate) for of, name, at, coordinate in rows if of == wire]
