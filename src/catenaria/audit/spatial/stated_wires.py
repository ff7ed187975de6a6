"""The wires of a line in space: what they are made of, where they are held and where they end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.spatial.stated_holds import StatedHolds, read_holds
from catenaria.audit.spatial.stations import AUXILIARY, CONTACT, MESSENGER, SECOND, Stations
from catenaria.audit.stated import Conductor, Inputs, StatedWire, read_conductor

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class SpatialWire(StatedWire):
    """A wire in space.

    Attributes
    ----------
    holds : StatedHolds
        How the supports hold it.
    pulled : tuple of bool
        Whether a device pulls its start and its end.
    tied : bool
        Whether its ends are clamped to other wires; then `ends` are not used.
    """

    holds: StatedHolds
    pulled: tuple[bool, bool]
    tied: bool


def read_wires(inputs: Inputs, stations: Stations) -> tuple[SpatialWire, ...]:
    """Return all wires: contact wires, auxiliary messenger, messenger, stitch wires, mid-point anchors."""
    return (*_long_wires(inputs, stations), *_tied_wires(inputs, stations))


def _long_wires(inputs: Inputs, stations: Stations) -> Iterator[SpatialWire]:
    for name, there in (
        (CONTACT, True),
        (SECOND, inputs["second_contact_wire"] is not None),
        (AUXILIARY, inputs["auxiliary_messenger"] is not None),
        (MESSENGER, True),
    ):
        if there:
            key = CONTACT if name == SECOND else name  # the second one is like the first
            yield _long_wire(inputs, stations, name, inputs[key.replace(" ", "_")])


def _long_wire(inputs: Inputs, stations: Stations, name: str, wire: dict[str, Any]) -> SpatialWire:
    tension = wire["tension"]
    pulled = tension["pulled"] in ("both", "start"), tension["pulled"] in ("both", "end")
    holds = read_holds(stations, name, tension["pulled"])
    ends = [_end(stations, name, wire, i) for i in (0, -1)]
    out = [end - held for end, held in zip(ends, holds.place[[0, -1]], strict=True)]
    return SpatialWire(
        name=name,
        conductor=_worn(read_conductor(inputs, wire["conductor"]), wire["wear"]),
        support_name=holds.name,
        support=holds.place,
        ends=np.array(ends),
        outwards=np.array([way / np.linalg.norm(way) for way in out]),
        tension=tension["force"] * tension["device"]["efficiency"],
        measure=tension["measure"],
        at_end=tension["at"] == "end",
        holds=holds,
        pulled=pulled,
        tied=False,
    )


def _end(stations: Stations, name: str, wire: dict[str, Any], i: int) -> FloatArray:
    """Return where a wire is anchored: straight on along the track from its first or last support [m]."""
    anchor: dict[str, float | None] = wire["anchor_start" if i == 0 else "anchor_end"] or {}
    lateral, height = stations.held(name, i) or (0.0, 0.0)
    own = anchor.get("stagger"), anchor.get("height"), anchor.get("distance")
    lateral = lateral if own[0] is None else own[0] + stations.beside(name)
    height = height if own[1] is None else own[1]
    distance = float(wire["tail"]) if own[2] is None else own[2]
    at = stations.across.take(np.array([i]))
    out = distance * (-1.0 if i == 0 else 1.0)
    return at.point(np.array([lateral]), np.array([height]))[0] + out * at.along[0]


def _worn(conductor: Conductor, wear: float) -> Conductor:
    """Return what wear leaves: area and mass in proportion, the second moment of area with its square."""
    left = 1.0 - wear
    return Conductor(conductor.name, conductor.EA * left, conductor.EJ * left**2, conductor.rhoA * left)


def _tied_wires(inputs: Inputs, stations: Stations) -> Iterator[SpatialWire]:
    stitch, anchor = inputs["stitch_wire"], inputs["mid_point"]
    for i in stations.stitched:
        yield _tied(inputs, stations, f"stitch wire {stations.names[i]}", stitch)
    if anchor is not None:
        for number in (1, 2):
            yield _tied(inputs, stations, f"mid-point anchor {number}", anchor)


def _tied(inputs: Inputs, stations: Stations, name: str, kind: dict[str, Any]) -> SpatialWire:
    """Return a wire whose force at its end is prescribed, and its length is found for it."""
    nowhere = np.full((2, 3), np.nan)
    return SpatialWire(
        name=name,
        conductor=read_conductor(inputs, kind["conductor"]),
        support_name=(),
        support=np.empty((0, 3)),
        ends=nowhere,
        outwards=nowhere,
        tension=kind["tension"],
        measure="reaction",
        at_end=True,
        holds=read_holds(stations, name, "both"),
        pulled=(False, False),
        tied=True,
    )
