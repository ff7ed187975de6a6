"""How large a line may be that is solved after every edit."""

from __future__ import annotations

from typing import Final

from catenaria.errors import UnsupportedError
from catenaria.line import Line
from catenaria.line.solver import Mesh

MOST_ELEMENTS: Final = 100_000  # some seconds and some gigabytes


def refuse_long_waits(line: Line) -> None:
    """Refuse a line of so many elements that nobody would wait for its form in a browser.

    Raises
    ------
    UnsupportedError
        With the command that solves it.
    """
    count = element_bound(line)
    if count > MOST_ELEMENTS:
        raise UnsupportedError(
            f"the mesh has up to {count} elements; the studio takes {MOST_ELEMENTS}. Try: fewer or longer "
            "elements in `mesh`, fewer spans, or `catenaria solve` for this line"
        )


def element_bound(line: Line) -> int:
    """Return a number of elements that all wires together do not exceed by much."""
    mesh: Mesh = line.solver.mesh
    droppers = sum(len(span.droppers.x) for span in line.spans)
    length = sum(span.length for span in line.spans)
    wires = 2 + (line.auxiliary_messenger is not None) + (line.second_contact_wire is not None)
    held = droppers + len(line.supports)
    by_rule = 2 * (len(mesh.fine) + 1) * held + int(length / mesh.largest_element)
    return wires * mesh.refine * (mesh.even or by_rule)
