"""Clamps that would stand in each other's way, or where there is no wire for them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from catenaria.line.base import Path, Problem, closest
from catenaria.line.places import Place, dropper_places, tie_places

if TYPE_CHECKING:
    from catenaria.line.line import Line
    from catenaria.line.tied_wire import MidPoint, StitchWire

_ROOM: Final = 0.3  # m between the clamp of a tied wire and another one
_APART: Final = 0.01  # m between a point mass and a clamp, so that there is a wire between the two
_ROUNDING: Final = 1e-9  # m


def clamp_problems(line: Line) -> Iterator[Problem]:
    """Find stitch wires, mid-point anchors and point masses that do not go with the rest of the line."""
    if line.stitch_wire is not None:
        yield from _stitch(line, line.stitch_wire)
    for i, support in enumerate(line.supports):
        path = ("supports", i, "stitch_wire")
        if support.stitch_wire and line.stitch_wire is None:
            yield Problem(path, True, "false or nothing: stitch_wire does not say what the line's are like")
        elif support.stitch_wire and i in (0, len(line.supports) - 1):
            yield Problem(path, True, "false: the messenger wire ends beyond this support")
    if line.mid_point is not None:
        yield from _mid_point(line, line.mid_point)
    if len(line.supports) == len(line.spans) + 1:
        droppers, ties = list(dropper_places(line)), list(tie_places(line))
        yield from _crowded(line, droppers, ties)
        yield from _masses(line, [*droppers, *ties])


def _stitch(line: Line, stitch: StitchWire) -> Iterator[Problem]:
    if line.auxiliary_messenger is not None:
        allowed = "nothing: stitch wires and an auxiliary messenger do not go together"
        yield Problem(("stitch_wire",), stitch, allowed)
    spans = [length for i in line.stitched_supports for length in _beside(line, i)]
    if spans and stitch.length >= min(spans):
        allowed = f"less than {min(spans):g} m, the shortest span beside a stitch wire"
        yield Problem(("stitch_wire", "length"), stitch.length, f"{allowed}, half of which it may take")


def _beside(line: Line, support: int) -> list[float]:
    """Return the lengths of the spans beside a support."""
    return [line.spans[i].length for i in (support - 1, support) if 0 <= i < len(line.spans)]


def _mid_point(line: Line, anchor: MidPoint) -> Iterator[Problem]:
    names = [support.name for support in line.supports]
    path = ("mid_point", "support")
    if anchor.support not in names:
        inner = ", ".join(names[1:-1])
        yield Problem(
            path, anchor.support, f"one of the inner supports: {inner}{closest(anchor.support, names)}"
        )
        return
    at = names.index(anchor.support)
    if at in (0, len(names) - 1):
        yield Problem(path, anchor.support, "an inner support: the messenger wire ends beyond this one")
    elif line.supports[at].contact_wire is None:
        yield Problem(path, anchor.support, "a support that holds the contact wire")
    if anchor.reach <= anchor.clearance:
        allowed = f"more than {anchor.clearance:g} m, the clearance on the contact wire"
        yield Problem(("mid_point", "reach"), anchor.reach, allowed)
    spans = _beside(line, at)
    if spans and anchor.reach >= min(spans):
        yield Problem(("mid_point", "reach"), anchor.reach, f"less than {min(spans):g} m, the span beside it")


def _crowded(line: Line, droppers: list[Place], ties: list[Place]) -> Iterator[Problem]:
    """Find clamps that are too near to those of tied wires."""
    for tie in ties:
        for dropper in droppers:
            if dropper.wire == tie.wire and abs(dropper.chainage - tie.chainage) < _ROOM - _ROUNDING:
                yield Problem(dropper.path, dropper.chainage, _away(line, tie, dropper.path))
    stitches = [tie for tie in ties if tie.path[0] == "stitch_wire"]
    for tie in ties:
        if tie.path == ("mid_point", "reach") and any(
            abs(end.chainage - tie.chainage) < _ROOM - _ROUNDING for end in stitches
        ):
            allowed = f"{_ROOM:g} m or more from where stitch wires end"
            yield Problem(tie.path, tie.chainage, allowed)


def _away(line: Line, tie: Place, path: Path) -> str:
    """Say where in the span of a dropper the end of a tied wire is."""
    span = path[1]
    start = line.support_x[span] if isinstance(span, int) else 0.0
    return f"{_ROOM:g} m or more from {tie.chainage - start:.6g} m, {tie.what} on the {tie.wire}"


def _masses(line: Line, clamps: list[Place]) -> Iterator[Problem]:
    missing = {
        "second contact wire": line.second_contact_wire is None,
        "auxiliary messenger": line.auxiliary_messenger is None,
    }
    first, last = line.support_x[0], line.support_x[-1]
    for i, mass in enumerate(line.point_masses):
        path: Path = ("point_masses", i)
        if missing.get(mass.wire, False):
            yield Problem((*path, "wire"), mass.wire, f"a wire of this line, which has no {mass.wire}")
        if mass.chainage <= first or mass.chainage >= last:
            allowed = f"between {first:g} and {last:g} m, the first and the last support"
            yield Problem((*path, "chainage"), mass.chainage, allowed)
        near = [c for c in clamps if c.wire == mass.wire and abs(c.chainage - mass.chainage) < _APART]
        if near:
            where = f"{near[0].chainage:.6g} m, where {near[0].what} is clamped to the {mass.wire}"
            allowed = f"{_APART * 1e3:g} mm or more from {where}: a mass there is that of a clamp"
            yield Problem((*path, "chainage"), mass.chainage, allowed)
