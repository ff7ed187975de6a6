"""Where droppers hang, and between which wires."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from catenaria.discretise.spatial.lay_wires import (
    AUXILIARY,
    CONTACT,
    MESSENGER,
    SECOND,
    stitch_name,
)
from catenaria.discretise.spatial.layout import LaidDroppers
from catenaria.line import Line


class _Dropper(NamedTuple):
    """One dropper; the names of its wires, place in the file and along the line, wanted height below."""

    lower: str
    upper: str
    span: int
    number: int
    chainage: float
    height: float


def lay_droppers(line: Line, index: Mapping[str, int]) -> LaidDroppers:
    """Return all droppers, in order of chainage.

    Parameters
    ----------
    line : Line
        The line.
    index : mapping of str to int
        Indices of the wires by name.
    """
    droppers = [*_lower_droppers(line), *_upper_droppers(line)]
    droppers.sort(key=lambda dropper: dropper.chainage)  # stable: a contact wire's before an upper one
    kind, n = line.dropper, len(droppers)
    conductor = line.conductor(kind.conductor)
    return LaidDroppers(
        lower=np.array([index[dropper.lower] for dropper in droppers], dtype=np.int64),
        upper=np.array([index[dropper.upper] for dropper in droppers], dtype=np.int64),
        span=np.array([dropper.span for dropper in droppers], dtype=np.int64),
        number=np.array([dropper.number for dropper in droppers], dtype=np.int64),
        frame=line.alignment.frames(np.array([dropper.chainage for dropper in droppers])),
        height=np.array([dropper.height for dropper in droppers]),
        flexibility=np.full(n, 0.0 if kind.model == "rigid" else 1.0 / conductor.EA),
        rhoA=np.full(n, conductor.rhoA),
        mass_bottom=np.full(n, kind.clamp_mass_bottom),
        mass_top=np.full(n, kind.clamp_mass_top),
        may_be_slack=kind.slack == "allowed",
    )


def _lower_droppers(line: Line) -> Iterator[_Dropper]:
    """Yield the droppers of the contact wires, numbered within each span."""
    places = zip(line.dropper_span, line.dropper_x, line.dropper_target_height, strict=True)
    otherwise = MESSENGER if line.auxiliary_messenger is None else AUXILIARY
    stitches = _stitches(line)
    span, number = -1, 0
    for at, chainage, height in places:
        if at != span:
            span, number = at, 0
        near = (name for name, x, reach in stitches if abs(chainage - x) < reach)
        upper = next(near, otherwise)
        for wire in _held_wires(line, number + 1):
            number += 1
            yield _Dropper(wire, upper, span + 1, number, chainage, height)


def _held_wires(line: Line, number: int) -> tuple[str, ...]:
    """Return which contact wires are held at a place: both, or odd numbers the first, even the second."""
    second = line.second_contact_wire
    if second is None:
        return (CONTACT,)
    if second.droppers == "both":
        return CONTACT, SECOND
    return (CONTACT if number % 2 else SECOND,)


def _stitches(line: Line) -> tuple[tuple[str, float, float], ...]:
    """Return names of the stitch wires, chainages of their supports, and how far they reach from there."""
    if line.stitch_wire is None:
        return ()
    x, reach = line.support_x, line.stitch_wire.length / 2.0
    return tuple((stitch_name(line.supports[i]), x[i], reach) for i in line.stitched_supports)


def _upper_droppers(line: Line) -> Iterator[_Dropper]:
    """Yield the droppers between auxiliary messenger and messenger wire, numbered within each span."""
    for i, (start, span) in enumerate(zip(line.support_x, line.spans, strict=False)):
        if span.auxiliary is not None:
            places = zip(span.auxiliary.droppers.x, span.auxiliary.heights, strict=True)
            for number, (x, height) in enumerate(places, start=1):
                yield _Dropper(AUXILIARY, MESSENGER, i + 1, number, start + x, height)
