"""Lines in space laid out by hand, without a line file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from catenaria.discretise.mesh import Grading
from catenaria.discretise.spatial.layout import (
    HoldKind,
    Holds,
    LaidCantilever,
    LaidDroppers,
    LaidMasses,
    LaidTies,
    LaidWire,
    Layout,
    Role,
)
from catenaria.discretise.wire_setup import TensionSetup
from catenaria.line.alignment import Alignment, Frames
from catenaria.line.track import Track
from catenaria.mechanics.chain import Section
from catenaria.mechanics.controls.velocity_law import VelocityLaw

LAW = VelocityLaw(1e-3, 1.0, 100.0)
NOWHERE = (np.nan, np.nan, np.nan)
STRING = Section(EA=1e7, EJ=0.0, rhoA=1.0)
STRAIGHT = Alignment.of(Track(), 0.0)


@dataclass(frozen=True)
class Rope:
    """A wire between two ends, given by chainage, lateral offset and height; no ends: a tied wire."""

    ends: tuple[tuple[float, float, float], tuple[float, float, float]] | None
    force: float = 10e3
    section: Section = STRING
    name: str = "messenger wire"
    role: Role = "messenger wire"
    pulled: tuple[bool, bool] = (True, True)
    at_end: bool = True

    def laid(self, alignment: Alignment) -> LaidWire:
        tension = TensionSetup(self.force, "reaction", self.at_end, LAW)
        chainage, lateral, height = np.zeros((3, 2)) if self.ends is None else np.array(self.ends).T
        frame = alignment.frames(chainage)
        own = self.pulled if self.ends is not None else (False, False)
        outwards = frame.along * np.array([[-1.0], [1.0]])
        return LaidWire(
            self.name, self.role, self.section, tension, own, frame.point(lateral, height), outwards
        )


@dataclass(frozen=True)
class Hold:
    """A support; `hinge` in global axes."""

    wire: int
    chainage: float
    height: float
    lateral: float = 0.0
    kind: HoldKind = "sliding"
    friction: float = 0.0
    compliance: tuple[float, float] = (0.0, 0.0)
    lift: float = np.nan
    hinge: tuple[float, float, float] = NOWHERE
    arm_length: float = 0.0
    arm_mass: float = 0.0
    side: float = 0.0


@dataclass(frozen=True)
class Dropper:
    """A dropper."""

    lower: int
    upper: int
    chainage: float
    height: float
    flexibility: float = 1e-6
    rhoA: float = 0.0
    mass_bottom: float = 0.0
    mass_top: float = 0.0


@dataclass(frozen=True)
class Tie:
    """An end of a tied wire."""

    wire: int
    end: int
    host: int
    chainage: float


@dataclass(frozen=True)
class Mass:
    """A point mass."""

    wire: int
    chainage: float
    mass: float


def column(rows: Sequence[Any], name: str) -> np.ndarray:
    kind = np.int64 if name in ("wire", "end", "host", "lower", "upper") else np.float64
    return np.array([getattr(row, name) for row in rows], dtype=kind)


def holds(rows: Sequence[Hold], alignment: Alignment) -> Holds:
    frame = alignment.frames(column(rows, "chainage"))
    values = {field.name: column(rows, field.name) for field in fields(Hold) if field.name != "kind"}
    place = values.pop("lateral"), values.pop("height")
    del values["chainage"]
    values["hinge"] = values["hinge"].reshape(-1, 3)
    values["compliance"] = values["compliance"].reshape(-1, 2)
    return Holds(
        **values,
        support=np.arange(len(rows)),
        frame=frame,
        X=frame.point(*place),
        kind=tuple(row.kind for row in rows),
    )


def droppers(rows: Sequence[Dropper], frame: Frames) -> LaidDroppers:
    values: dict[str, Any] = {
        field.name: column(rows, field.name) for field in fields(Dropper) if field.name != "chainage"
    }
    count = len(rows)
    return LaidDroppers(**values, span=np.ones(count, np.int64), number=1 + np.arange(count), frame=frame)


def lay(
    ropes: Sequence[Rope],
    held: Sequence[Hold] = (),
    hung: Sequence[Dropper] = (),
    tied: Sequence[Tie] = (),
    massive: Sequence[Mass] = (),
    cantilevers: Sequence[LaidCantilever] = (),
    g: float = 9.8,
    alignment: Alignment = STRAIGHT,
) -> Layout:
    """Return a layout; droppers and ties must be in order, holds by wire and chainage."""

    def frames(rows: Sequence[Any]) -> Frames:
        return alignment.frames(column(rows, "chainage"))

    return Layout(
        wires=tuple(rope.laid(alignment) for rope in ropes),
        holds=holds(held, alignment),
        droppers=droppers(hung, frames(hung)),
        ties=LaidTies(column(tied, "wire"), column(tied, "end"), column(tied, "host"), frames(tied)),
        masses=LaidMasses(
            tuple(f"mass {i}" for i in range(len(massive))),
            column(massive, "wire"),
            frames(massive),
            column(massive, "mass"),
        ),
        cantilevers=tuple(cantilevers),
        height_law=LAW,
        grading=Grading((0.1, 0.3), 2.4),
        gauss_points=3,
        g=g,
        ramp_time=5.0,
        damping=(0.0, 0.0),
    )


@pytest.fixture(scope="session")
def drawn() -> SimpleNamespace:
    """What lines are laid out with."""
    return SimpleNamespace(rope=Rope, hold=Hold, dropper=Dropper, tie=Tie, mass=Mass, lay=lay)


@pytest.fixture(scope="session")
def curved() -> Callable[..., Alignment]:
    """Return the alignment of one curve of 2 km without transitions."""

    def along(radius: float, cant: float = 0.0, start: float = 0.0) -> Alignment:
        curve = {"start": start, "length": 2000.0, "radius": radius, "cant": cant}
        return Alignment.of(Track.model_validate({"curves": (curve,)}), 0.0)

    return along
