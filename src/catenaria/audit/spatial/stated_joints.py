"""What is clamped to wires of a line in space besides droppers: ends of other wires, and masses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.spatial.stations import CONTACT, LONG, MESSENGER, SECOND, Stations
from catenaria.audit.stated import Inputs
from catenaria.audit.track import Across

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class StatedTies:
    """Ends of wires, 0 the start and 1 the end, clamped to their hosts at chainages [m]."""

    wire: tuple[str, ...]
    end: tuple[int, ...]
    host: tuple[str, ...]
    chainage: FloatArray
    across: Across


@dataclass(frozen=True)
class StatedMasses:
    """Point masses [kg] on wires at chainages [m], in order of wires and chainage."""

    name: tuple[str, ...]
    wire: tuple[str, ...]
    chainage: FloatArray
    mass: FloatArray
    across: Across


class _Tie(NamedTuple):
    wire: str
    end: int
    host: str
    chainage: float


def read_ties(inputs: Inputs, stations: Stations) -> StatedTies:
    """Return where stitch wires and mid-point anchors are clamped to other wires."""
    ties = [*_of_stitch_wires(inputs, stations), *_of_anchors(inputs, stations)]
    chainage = np.array([tie.chainage for tie in ties], dtype=np.float64)
    return StatedTies(
        tuple(tie.wire for tie in ties),
        tuple(tie.end for tie in ties),
        tuple(tie.host for tie in ties),
        chainage,
        stations.track.across(chainage),
    )


def _of_stitch_wires(inputs: Inputs, stations: Stations) -> Iterator[_Tie]:
    for i in stations.stitched:
        for end, sign in enumerate((-1.0, 1.0)):
            at = stations.chainage[i] + 0.5 * sign * inputs["stitch_wire"]["length"]
            yield _Tie(f"stitch wire {stations.names[i]}", end, MESSENGER, float(at))


def _of_anchors(inputs: Inputs, stations: Stations) -> Iterator[_Tie]:
    anchor = inputs["mid_point"]
    if anchor is not None:
        middle = float(stations.chainage[stations.names.index(anchor["support"])])
        far, near = anchor["reach"], anchor["clearance"]
        yield _Tie("mid-point anchor 1", 0, MESSENGER, middle - far)
        yield _Tie("mid-point anchor 1", 1, CONTACT, middle - near)
        yield _Tie("mid-point anchor 2", 0, CONTACT, middle + near)
        yield _Tie("mid-point anchor 2", 1, MESSENGER, middle + far)


class _Mass(NamedTuple):
    name: str
    wire: str
    chainage: float
    mass: float


def read_masses(inputs: Inputs, stations: Stations) -> StatedMasses:
    """Return the masses of the file and the clamps of steady arms, one for each contact wire."""
    masses = [_Mass(m["name"], m["wire"], m["chainage"], m["mass"]) for m in inputs["point_masses"]]
    masses += _clamps(inputs, stations)
    masses.sort(key=lambda mass: (LONG.index(mass.wire), mass.chainage))
    chainage = np.array([mass.chainage for mass in masses], dtype=np.float64)
    return StatedMasses(
        tuple(mass.name for mass in masses),
        tuple(mass.wire for mass in masses),
        chainage,
        np.array([mass.mass for mass in masses], dtype=np.float64),
        stations.track.across(chainage),
    )


def _clamps(inputs: Inputs, stations: Stations) -> Iterator[_Mass]:
    wires = (CONTACT,) if inputs["second_contact_wire"] is None else (CONTACT, SECOND)
    for chainage, support in zip(stations.chainage.tolist(), stations.supports, strict=True):
        arm = None if support["contact_wire"] is None else support["contact_wire"]["arm"]
        if arm is not None and arm["clamp_mass"] > 0.0:
            for wire in wires:
                yield _Mass(f"clamp at {support['name']}", wire, chainage, arm["clamp_mass"])
