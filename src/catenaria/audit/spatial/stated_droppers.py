"""The droppers of a line in space: between which wires they hang, where, and for what heights."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.spatial.stations import AUXILIARY, CONTACT, MESSENGER, SECOND, Stations
from catenaria.audit.stated import Conductor, Inputs, dropper_places, listed, read_conductor, wanted_heights
from catenaria.audit.track import Across

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class StatedDroppers:
    """All droppers in order of chainage; of those at one chainage the lower first.

    Attributes
    ----------
    lower, upper : tuple of str
        Names of the wires between which they hang.
    span, number : tuple of int
        Span and number within it, both from 1; those below an auxiliary messenger and above it by themselves.
    chainage, height : FloatArray, shape (n,)
        Where they hang [m], and the wanted height of the lower wire above the canted track [m].
    across : Across
        The planes across the track there.
    conductor : Conductor
        Cross-section.
    rigid : bool
        Whether they do not stretch.
    mass_bottom, mass_top, clamp_heights : float
        Of both clamps [kg], [m].
    may_be_slack : bool
        Whether one that would have to push hangs slack, with the lower wire above its wanted height.
    """

    lower: tuple[str, ...]
    upper: tuple[str, ...]
    span: tuple[int, ...]
    number: tuple[int, ...]
    chainage: FloatArray
    height: FloatArray
    across: Across
    conductor: Conductor
    rigid: bool
    mass_bottom: float
    mass_top: float
    clamp_heights: float
    may_be_slack: bool


class _Dropper(NamedTuple):
    chainage: float
    height: float
    lower: str
    upper: str
    span: int
    number: int


def read_droppers(inputs: Inputs, stations: Stations) -> StatedDroppers:
    """Return all droppers of the echo of a line file."""
    droppers = [*_of_contact_wires(inputs, stations), *_of_auxiliary(inputs, stations)]
    droppers.sort(key=lambda dropper: dropper.chainage)
    chainage = np.array([dropper.chainage for dropper in droppers], dtype=np.float64)
    kind = inputs["dropper"]
    return StatedDroppers(
        lower=tuple(dropper.lower for dropper in droppers),
        upper=tuple(dropper.upper for dropper in droppers),
        span=tuple(dropper.span for dropper in droppers),
        number=tuple(dropper.number for dropper in droppers),
        chainage=chainage,
        height=np.array([dropper.height for dropper in droppers], dtype=np.float64),
        across=stations.track.across(chainage),
        conductor=read_conductor(inputs, kind["conductor"]),
        rigid=kind["model"] == "rigid",
        mass_bottom=kind["clamp_mass_bottom"],
        mass_top=kind["clamp_mass_top"],
        clamp_heights=kind["clamp_height_top"] + kind["clamp_height_bottom"],
        may_be_slack=kind["slack"] == "allowed",
    )


def _of_contact_wires(inputs: Inputs, stations: Stations) -> Iterator[_Dropper]:
    second = inputs["second_contact_wire"]
    for i, span in enumerate(inputs["spans"]):
        x, heights = dropper_places(span["droppers"]), wanted_heights(inputs, i).tolist()
        for n, (place, height) in enumerate(zip(x, heights, strict=True)):
            at = float(stations.chainage[i]) + place
            both = second is not None and second["droppers"] == "both"
            wires = (CONTACT, SECOND) if both else (CONTACT if second is None or n % 2 == 0 else SECOND,)
            for k, wire in enumerate(wires, start=1 + n * len(wires)):
                yield _Dropper(at, height, wire, _bearer(inputs, stations, at), i + 1, k)


def _bearer(inputs: Inputs, stations: Stations, at: float) -> str:
    """Return the wire from which a contact wire's dropper hangs."""
    for i in stations.stitched:
        if abs(at - stations.chainage[i]) < 0.5 * inputs["stitch_wire"]["length"]:
            return f"stitch wire {stations.names[i]}"
    return MESSENGER if inputs["auxiliary_messenger"] is None else AUXILIARY


def _of_auxiliary(inputs: Inputs, stations: Stations) -> Iterator[_Dropper]:
    for i, (start, span) in enumerate(
        zip(stations.chainage.tolist(), inputs["spans"], strict=False), start=1
    ):
        upper = span["auxiliary"]
        if upper is not None:
            x = dropper_places(upper["droppers"])
            heights = listed(upper["height"], len(x))
            for k, (place, height) in enumerate(zip(x, heights, strict=True), start=1):
                yield _Dropper(start + place, height, AUXILIARY, MESSENGER, i, k)
