"""What must fit together in a line although every part is right in itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from catenaria.line.base import Path, Problem, closest
from catenaria.line.clamp_checks import clamp_problems
from catenaria.line.conductors import uses
from catenaria.line.installation_checks import installation_problems
from catenaria.line.library import library
from catenaria.line.plausibility import (
    implausible_conductors,
    implausible_heights,
    implausible_sags,
    implausible_tensions,
)
from catenaria.line.wire_checks import wire_problems

if TYPE_CHECKING:
    from catenaria.line.line import Line


def line_problems(line: Line) -> Iterator[Problem]:
    """Find everything that contradicts something else in the line.

    Yields
    ------
    Problem
        One for each contradiction, at the place where it would be mended.
    """
    yield from _unknown_conductors(line)
    yield from _wrong_counts(line)
    yield from _loose_ends(line)
    yield from _names_given_twice(line)
    yield from wire_problems(line)
    yield from clamp_problems(line)
    yield from _wrong_installation(line)
    yield from implausible_conductors(line)
    yield from implausible_tensions(line)
    yield from implausible_heights(line)
    yield from implausible_sags(line)


def _wrong_installation(line: Line) -> Iterator[Problem]:
    if line.installation is not None:
        for problem in installation_problems(line.installation, line):
            yield Problem(("installation", *problem.path), problem.found, problem.allowed, problem.kind)


def _unknown_conductors(line: Line) -> Iterator[Problem]:
    for path, name in uses(line):
        if name not in line.conductors:
            own = ", ".join([*line.conductors, "those of the library"])
            allowed = f"one of the conductors: {own}{closest(name, [*line.conductors, *library()])}"
            yield Problem(path, name, allowed)


def _wrong_counts(line: Line) -> Iterator[Problem]:
    supports, spans = len(line.supports), len(line.spans)
    if supports < 2:
        yield Problem(("supports",), line.supports, "at least two supports that hold the wires")
    elif supports != spans + 1:
        allowed = f"{spans + 1} supports for {spans} spans, or {supports - 1} spans for {supports} supports"
        yield Problem(("supports",), line.supports, allowed)
    if not any(span.droppers.x for span in line.spans):
        yield Problem(("spans",), line.spans, "at least one span with a dropper")
    for i, span in enumerate(line.spans):
        if isinstance(span.contact_wire_height, tuple):
            path = ("spans", i, "contact_wire_height")
            yield from _wrong_heights(path, len(span.contact_wire_height), len(span.droppers.x))
        if span.auxiliary is not None:
            path = ("spans", i, "auxiliary", "height")
            yield from _wrong_heights(path, len(span.auxiliary.heights), len(span.auxiliary.droppers.x))


def _wrong_heights(path: Path, prescribed: int, released: int) -> Iterator[Problem]:
    """Each prescribed height needs one dropper length that is released to fulfil it."""
    if prescribed != released:
        difference = "more" if prescribed > released else "fewer"
        allowed = (
            f"one height, or {released} of them: one for each dropper, whose length it releases; "
            f"{abs(prescribed - released)} {difference} than lengths to release"
        )
        yield Problem(path, prescribed, allowed)


def _loose_ends(line: Line) -> Iterator[Problem]:
    for i in {0, len(line.supports) - 1}:
        if 0 <= i < len(line.supports) and line.supports[i].contact_wire is None:
            which = "first" if i == 0 else "last"
            allowed = f"a height: the {which} support must hold the contact wire"
            yield Problem(("supports", i, "contact_wire"), None, allowed, "missing")


def _names_given_twice(line: Line) -> Iterator[Problem]:
    seen: set[str] = set()
    for i, support in enumerate(line.supports):
        if support.name in seen:
            yield Problem(("supports", i, "name"), support.name, "a name that no other support has")
        seen.add(support.name)
