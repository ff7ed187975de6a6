"""How large a line may be that is edited in a browser and solved after every edit."""

from __future__ import annotations

import re
import threading
from collections.abc import Mapping
from os import cpu_count
from typing import Final, cast

from catenaria.errors import Fault, LineFileError, UnsupportedError
from catenaria.line import Line
from catenaria.line.solver import Mesh

MOST_ELEMENTS: Final = 100_000  # some seconds and some gigabytes
MOST_MARKS: Final = 20_000  # commas, colons and line breaks of a text: it is read in two or three seconds
MOST_ROWS: Final = 300  # of the tables in which spans and supports are edited
MOST_TYPED: Final = 4_000  # characters in a field of a form

_MARK: Final = re.compile(r"[,:\n]")
_LONG_NUMBER: Final = re.compile(r"(?<![\w.:])\d[\w.:]{1000,}")

AT_ONCE: Final = max(cpu_count() or 1, 2)
SOLVING: Final = threading.BoundedSemaphore(AT_ONCE)  # of all pages together; others wait for their turn
MOVING: Final = threading.BoundedSemaphore(AT_ONCE)  # others are refused: each takes up to a minute


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
            "elements in `mesh`, fewer or shorter spans, or `catenaria solve` for this line"
        )


def refuse_slow_text(text: str, file: str) -> None:
    """Refuse a text that takes long to read: of very many values, or with a number of very many digits.

    Raises
    ------
    LineFileError
        With the place.
    """
    if (found := _LONG_NUMBER.search(text)) is not None:
        line, column = (
            text.count("\n", 0, found.start()) + 1,
            found.start() - text.rfind("\n", 0, found.start()),
        )
        what = f"{found.end() - found.start()} digits in a row"
        raise LineFileError((Fault(file, line, column, "the file", what, "1000 at most"),))
    marks = len(_MARK.findall(text))
    if marks > MOST_MARKS:
        what = f"{marks} commas, colons and lines"
        raise LineFileError((Fault(file, 1, 1, "the file", what, f"{MOST_MARKS} in the studio"),))


def refuse_long_tables(tree: Mapping[str, object], file: str) -> None:
    """Refuse a line of so many spans or supports that a page would not take their fields.

    Raises
    ------
    LineFileError
        With the field.
    """
    for name in ("spans", "supports"):
        rows = tree.get(name)
        count = len(cast("list[object]", rows)) if isinstance(rows, list) else 0
        if count > MOST_ROWS:
            allowed = f"{MOST_ROWS} in the studio; `catenaria solve` takes more"
            raise LineFileError((Fault(file, 1, 1, name, f"{count} of them", allowed),))


def element_bound(line: Line) -> int:
    """Return a number of elements that all wires together do not exceed by much."""
    mesh: Mesh = line.solver.mesh
    droppers = sum(len(span.droppers.x) for span in line.spans)
    length = sum(span.length for span in line.spans)
    wires = 2 + (line.auxiliary_messenger is not None) + (line.second_contact_wire is not None)
    held = droppers + len(line.supports)
    by_rule = 2 * (len(mesh.fine) + 1) * held + int(length / mesh.largest_element)
    return wires * mesh.refine * (mesh.even or by_rule)
