"""Where supports, droppers, ties and masses sit on the wires, for fitters who mark them beforehand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from catenaria.report.columns import Columns
from catenaria.report.names import dropper_names
from catenaria.results import FormResult


class _Mark(NamedTuple):
    """A place on a wire, by its unstressed coordinate."""

    wire: int
    s: float
    chainage: float
    what: str
    support: bool


def clamp_columns(result: FormResult) -> Columns:
    """Return everything that is clamped to the wires, wire by wire and along each.

    Distances are unstressed: along a wire that lies on the ground, from its start, from the mark before, and
    from where its first support holds it (NaN for wires without supports).
    """
    marks = sorted(_marks(result))
    wire = np.array([mark.wire for mark in marks], dtype=np.int64)
    s = np.array([mark.s for mark in marks], dtype=np.float64)
    first = np.full(len(result.wires), np.nan)
    for mark in reversed(marks):
        if mark.support:
            first[mark.wire] = mark.s
    names = [form.name for form in result.wires]
    return {
        "wire": [names[mark.wire] for mark in marks],
        "mark": [mark.what for mark in marks],
        "chainage_m": [mark.chainage for mark in marks],
        "from_start_m": s,
        "from_mark_before_m": np.where(np.diff(wire, prepend=-1) == 0, np.diff(s, prepend=0.0), s),
        "from_first_support_m": s - first[wire],
    }


def _marks(result: FormResult) -> Iterator[_Mark]:
    index = {form.name: k for k, form in enumerate(result.wires)}
    droppers, supports, ties, masses = result.droppers, result.supports, result.ties, result.masses
    names = dropper_names(result)
    ends = zip(ties.end.tolist(), ties.wire, strict=True)
    held = [f"support {name}" for name in supports.support]
    tied = [f"{('start', 'end')[end]} of {wire}" for end, wire in ends]
    for wires, what, s, chainage, support in (
        (supports.wire, held, supports.sliding_coordinate, supports.chainage, True),
        (droppers.lower_wire, names, droppers.contact_coordinate, droppers.x, False),
        (droppers.upper_wire, names, droppers.messenger_coordinate, droppers.x, False),
        (ties.host, tied, ties.coordinate, ties.chainage, False),
        (masses.wire, list(masses.name), masses.coordinate, masses.chainage, False),
    ):
        for wire, mark, at, x in zip(wires, what, s.tolist(), chainage.tolist(), strict=True):
            yield _Mark(index[wire], at, x, mark, support)
