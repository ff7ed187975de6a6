"""Where along the line droppers and the ends of tied wires hold on to other wires."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from catenaria.line.base import Path

if TYPE_CHECKING:
    from catenaria.line.dropper import Droppers
    from catenaria.line.line import Line
    from catenaria.line.point_mass import WireName


@dataclass(frozen=True)
class Place:
    """A clamp on a wire.

    Parameters
    ----------
    wire : str
        The wire on which it is.
    chainage : float
        Where it is [m].
    what : str
        What is clamped there.
    path : tuple of str and int
        The field of the file that says so.
    """

    wire: WireName
    chainage: float
    what: str
    path: Path


def dropper_places(line: Line) -> Iterator[Place]:
    """Yield the clamps of all droppers on the wires that run along the line.

    Droppers of two contact wires count for both, those that hang from a stitch wire for the messenger wire.
    """
    compound = line.auxiliary_messenger is not None
    lower: list[WireName] = ["contact wire", "auxiliary messenger" if compound else "messenger wire"]
    if line.second_contact_wire is not None:
        lower.append("second contact wire")
    for i, (start, span) in enumerate(zip(line.support_x, line.spans, strict=False)):
        yield from _of_droppers(span.droppers, start, lower, ("spans", i, "droppers"))
        if span.auxiliary is not None:
            upper: list[WireName] = ["auxiliary messenger", "messenger wire"]
            path = ("spans", i, "auxiliary", "droppers")
            yield from _of_droppers(span.auxiliary.droppers, start, upper, path)


def _of_droppers(droppers: Droppers, start: float, wires: list[WireName], path: Path) -> Iterator[Place]:
    for i, x in enumerate(droppers.x):
        for wire in wires:
            yield Place(wire, start + x, "a dropper", (*path, *droppers.place(i)))


def tie_places(line: Line) -> Iterator[Place]:
    """Yield the ends of stitch wires and mid-point anchors on the wires that run along the line."""
    for i in line.stitched_supports:
        half = line.stitch_wire.length / 2.0 if line.stitch_wire is not None else 0.0
        for sign in (-1.0, 1.0):
            at = line.support_x[i] + sign * half
            yield Place("messenger wire", at, "the end of a stitch wire", ("stitch_wire", "length"))
    anchor = line.mid_point
    names = [support.name for support in line.supports]
    if anchor is None or anchor.support not in names:
        return
    at = line.support_x[names.index(anchor.support)]
    for sign in (-1.0, 1.0):
        what = "the end of a mid-point anchor"
        yield Place("messenger wire", at + sign * anchor.reach, what, ("mid_point", "reach"))
        yield Place("contact wire", at + sign * anchor.clearance, what, ("mid_point", "clearance"))
