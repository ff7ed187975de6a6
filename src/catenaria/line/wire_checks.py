"""Wires besides contact and messenger wire, and where wires end: what the line must say of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from catenaria.line.base import Problem
from catenaria.line.profile import between

if TYPE_CHECKING:
    from catenaria.line.line import Line
    from catenaria.line.wire import Anchor

_WIDEST: Final = 0.5  # m between two contact wires
_FARTHEST: Final = 0.5  # m from the line between the auxiliary messenger's supports to a wanted height
_LONGEST: Final = 200.0  # m from the last support to an anchor
_STEEPEST: Final = 0.25  # of a wire on its way to an anchor
_ROUNDING: Final = 1e-9  # m


def wire_problems(line: Line) -> Iterator[Problem]:
    """Find what supports and spans lack, or say too much, of the wires that the line has."""
    second = line.second_contact_wire
    if second is not None and second.spacing >= _WIDEST:
        path = ("second_contact_wire", "spacing")
        yield Problem(path, second.spacing, f"less than {_WIDEST:g} m, as 40 mm")
    if line.auxiliary_messenger is None:
        yield from _superfluous(line)
    else:
        yield from _incomplete(line)
        yield from _auxiliary_heights(line)
    yield from _anchors(line)


def _superfluous(line: Line) -> Iterator[Problem]:
    allowed = "nothing: the line has no auxiliary_messenger"
    for i, support in enumerate(line.supports):
        if support.auxiliary_messenger is not None:
            yield Problem(("supports", i, "auxiliary_messenger"), support.auxiliary_messenger, allowed)
    for i, span in enumerate(line.spans):
        if span.auxiliary is not None:
            yield Problem(("spans", i, "auxiliary"), span.auxiliary, allowed)


def _incomplete(line: Line) -> Iterator[Problem]:
    for i, support in enumerate(line.supports):
        if support.auxiliary_messenger is None:
            allowed = "a height: every support must hold the auxiliary messenger"
            yield Problem(("supports", i, "auxiliary_messenger"), None, allowed, "missing")
    for i, span in enumerate(line.spans):
        if span.auxiliary is None and span.droppers.x:
            allowed = "the droppers that hold the auxiliary messenger, and its height at them"
            yield Problem(("spans", i, "auxiliary"), None, allowed, "missing")


def _auxiliary_heights(line: Line) -> Iterator[Problem]:
    places = zip(line.support_x, line.supports, strict=False)
    held = [(x, s.auxiliary_messenger.height) for x, s in places if s.auxiliary_messenger is not None]
    for i, (start, span) in enumerate(zip(line.support_x, line.spans, strict=False)):
        if span.auxiliary is None:
            continue
        for j, (x, height) in enumerate(zip(span.auxiliary.droppers.x, span.auxiliary.heights, strict=False)):
            level = between(held, start + x)
            if abs(height - level) > _FARTHEST + _ROUNDING:
                listed = (j,) if isinstance(span.auxiliary.height, tuple) else ()
                allowed = f"within {_FARTHEST:g} m of {level:g} m, the line between its supports"
                yield Problem(("spans", i, "auxiliary", "height", *listed), height, allowed)
                if not listed:
                    break


def _anchors(line: Line) -> Iterator[Problem]:
    for field in ("contact_wire", "messenger_wire", "auxiliary_messenger"):
        wire = getattr(line, field)
        for end, support in (("anchor_start", 0), ("anchor_end", -1)):
            anchor: Anchor | None = getattr(wire, end, None)
            if anchor is None or not line.supports:
                continue
            lateral, height = _held(line, field, support)
            distance = wire.tail if anchor.distance is None else anchor.distance
            for problem in _anchor(anchor, distance, lateral, height):
                yield Problem((field, end, *problem.path), problem.found, problem.allowed)


def _held(line: Line, field: str, support: int) -> tuple[float, float | None]:
    """Return lateral offset and height at which the first or last support holds a wire."""
    at = line.supports[support]
    if field == "messenger_wire":
        return at.messenger_offset, at.messenger_height
    if field == "contact_wire":
        return at.stagger, at.contact_wire.height if at.contact_wire is not None else None
    return at.messenger_offset, at.auxiliary_messenger.height if at.auxiliary_messenger is not None else None


def _anchor(anchor: Anchor, distance: float, lateral: float, height: float | None) -> Iterator[Problem]:
    if distance > _LONGEST:
        yield Problem(("distance",), anchor.distance, f"at most {_LONGEST:g} m")
        return
    away = _STEEPEST * distance
    for field, found, held in (("height", anchor.height, height), ("stagger", anchor.stagger, lateral)):
        if found is not None and held is not None and abs(found - held) > away + _ROUNDING:
            allowed = f"within {away:g} m of {held:g} m, as at the support, for an anchor {distance:g} m away"
            yield Problem((field,), found, allowed)
