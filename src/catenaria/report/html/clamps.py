"""Where clamps sit on the wires, by unstressed length: what is marked before the wires are tensioned."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.report.html.table import Table, column
from catenaria.report.names import dropper_names
from catenaria.results import FormResult

Place = tuple[str, str, float, float]  # wire, what is clamped, chainage, unstressed length

_TIED = {"stitch wire": "Stitch wires", "mid-point anchor": "Mid-point anchors"}
_SAME = 1e-6  # m


def clamp_tables(result: FormResult) -> list[Table]:
    """Return what is clamped to each wire and at which unstressed length from its start.

    Notes
    -----
    Stitch wires and mid-point anchors, of which there are many short ones, stand in one table for each kind.
    """
    places = sorted(_places(result), key=lambda place: (place[3], place[1]))
    titles: dict[str, list[str]] = {}
    for wire in result.wires:
        title = _TIED.get(wire.role, f"{wire.name[:1].upper()}{wire.name[1:]}")
        titles.setdefault(title, []).append(wire.name)
    found = {title: [p for name in names for p in places if p[0] == name] for title, names in titles.items()}
    return [_table(title, rows, len(titles[title]) > 1) for title, rows in found.items() if rows]


def masses_apart(result: FormResult) -> NDArray[np.bool_]:
    """Return which point masses are not clamps of steady arms, whose places supports already tell."""
    masses, held = result.masses, result.supports
    own = np.array(held.wire, dtype=np.str_)[:, None] == np.array(masses.wire, dtype=np.str_)
    near = np.abs(held.sliding_coordinate[:, None] - masses.coordinate) < _SAME
    return ~(own & near).any(axis=0)


def _places(result: FormResult) -> Iterator[Place]:
    droppers, ties, masses, held = result.droppers, result.ties, result.masses, result.supports
    named, x = dropper_names(result), droppers.x.tolist()
    yield from zip(droppers.lower_wire, named, x, droppers.contact_coordinate.tolist(), strict=True)
    yield from zip(droppers.upper_wire, named, x, droppers.messenger_coordinate.tolist(), strict=True)
    yield from zip(ties.host, ties.wire, ties.chainage.tolist(), ties.coordinate.tolist(), strict=True)
    supports = [f"support {name}" for name in held.support]
    yield from zip(held.wire, supports, held.chainage.tolist(), held.sliding_coordinate.tolist(), strict=True)
    for i in np.flatnonzero(masses_apart(result)).tolist():
        yield masses.wire[i], masses.name[i] or "mass", float(masses.chainage[i]), float(masses.coordinate[i])


def _table(title: str, rows: list[Place], several: bool) -> Table:
    wire = [column("wire", "", [row[0] for row in rows])] if several else []
    return Table(
        f"{title}: {len(rows)} places",
        (
            *wire,
            column("clamp of", "", [row[1] for row in rows]),
            column("chainage", "m", [row[2] for row in rows], ".3f"),
            column("unstressed length from start", "m", [row[3] for row in rows], ".4f"),
        ),
        open=False,
    )
