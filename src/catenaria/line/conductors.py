"""Which conductors a line uses, by name: its own and those of the library."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from catenaria.line.base import Path
from catenaria.line.conductor import Conductor
from catenaria.line.library import library

if TYPE_CHECKING:
    from catenaria.line.line import Line


def uses(line: Line) -> tuple[tuple[Path, str], ...]:
    """Return every place that names a conductor, with the name."""
    parts = (
        ("contact_wire", line.contact_wire),
        ("messenger_wire", line.messenger_wire),
        ("auxiliary_messenger", line.auxiliary_messenger),
        ("stitch_wire", line.stitch_wire),
        ("mid_point", line.mid_point),
        ("dropper", line.dropper),
    )
    return tuple(((field, "conductor"), part.conductor) for field, part in parts if part is not None)


def from_library(line: Line) -> Mapping[str, Conductor]:
    """Return the conductors that the line uses without describing them, as far as the library has them."""
    names = {name for _, name in uses(line) if name not in line.conductors}
    return {name: library()[name] for name in sorted(names) if name in library()}
