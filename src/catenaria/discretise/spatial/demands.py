"""What is demanded of a line in space: tensions and heights, as targets or as controls."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.model import FULL, SpatialModel
from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.control import Controls, Measure
from catenaria.mechanics.controls.measures import ReactionTension, StrainTension
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.controls.track_height import TrackHeight
from catenaria.mechanics.controls.value import Value
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.system import System

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class TensionDemand:
    """The prescribed tension of one wire.

    Attributes
    ----------
    wire : int
        Index of the wire.
    parameter : IntArray, shape (1,)
        What is found: its pull, or how much longer it is.
    measure : Measure
        What is measured.
    target : float
        What it shall be [N].
    law : VelocityLaw
        How fast the parameter follows.
    sense : float
        -1 for pieces: one that is longer is less tight.
    """

    wire: int
    parameter: IntArray
    measure: Measure
    target: float
    law: VelocityLaw
    sense: float = 1.0


def tension_demands(model: SpatialModel, z: FloatArray) -> Iterator[TensionDemand]:
    """Yield what is demanded of each wire; measures fit z."""
    for k, wire in enumerate(model.layout.wires):
        tension = wire.tension
        end = 1 if tension.at_end else 0
        if wire.tied:
            ties = model.layout.ties
            la = model.tie_force[(ties.wire == k) & (ties.end == end)]
            measure = ReactionTension(la, _outwards(model, k, end))
            yield TensionDemand(k, model.piece[[k]], measure, tension.force, tension.law, -1.0)
            continue
        if tension.measure == "strain":
            held = model.hold_s[model.layout.holds.wire == k][[-end]]
            measure = StrainTension(model.wires[k], held, model.wires[k].locate(z[held]))
        else:
            measure = ReactionTension(model.end_force[k, [end]], wire.outwards[[end]])
        yield TensionDemand(k, model.pull[[k]], measure, tension.force, tension.law)


def _outwards(model: SpatialModel, wire: int, end: int) -> FloatArray:
    """Return the direction in which the guess of a wire leaves its start (0) or its end (1), shape (1, 3)."""
    course = model.guess.courses[wire]
    slope = course.place(np.array([end * course.length]))[1]
    return np.copysign(1.0, end - 0.5) * slope / np.linalg.norm(slope)


def heights(model: SpatialModel, z: FloatArray, only: Mask | None = None) -> TrackHeight:
    """Return the heights of lower wires above the canted track, as a measure that fits z.

    Parameters
    ----------
    model : SpatialModel
        The line.
    z : FloatArray, shape (n,)
        Unknowns.
    only : NDArray of bool, shape (n_droppers,), optional
        At which droppers, all if left out.
    """
    droppers = model.layout.droppers
    only = np.ones(model.length.size, dtype=np.bool_) if only is None else only
    on, s = Strands.on(model.wires, droppers.lower[only]), model.lower_s[only]
    return TrackHeight(on, s, on.locate(z[s]), droppers.frame.origin[only], droppers.frame.up[only])


def to_find(model: SpatialModel, z: FloatArray, slack: Mask | None = None) -> System:
    """Return the system in which tensions and heights are targets, with joints that fit z.

    Droppers of the mask `slack`, shape (n_droppers,), shall carry nothing instead.
    """
    slack = np.zeros(model.length.size, dtype=np.bool_) if slack is None else slack
    demands: list[Contribution] = list(_tensions(model, z))
    height = model.layout.droppers.height[~slack]
    demands.append(Targets(model.length[~slack], heights(model, z, ~slack), height))
    demands += _nothing(model, slack)
    return model.system(z, demands, FULL, built=False)


def to_move(model: SpatialModel, z: FloatArray, ramp: Ramp, slack: Mask | None = None) -> System:
    """Return the system in which controls pull ends and change lengths while gravity grows, without inertia.

    Droppers push as well as they pull on their way, and their masses act as weights only. Those of the mask
    `slack`, shape (n_droppers,), carry nothing and have no control.
    """
    slack = np.zeros(model.length.size, dtype=np.bool_) if slack is None else slack
    demands: list[Contribution] = [*_controls(model, z, ramp, ~slack), *_nothing(model, slack)]
    return model.system(z, demands, ramp, built=False)


def _nothing(model: SpatialModel, slack: Mask) -> Iterator[Targets]:
    """Yield that slack droppers carry nothing, whatever their lengths."""
    if slack.any():
        nothing = np.zeros(np.count_nonzero(slack))
        yield Targets(model.length[slack], Value(model.density[slack]), nothing)


def _controls(model: SpatialModel, z: FloatArray, velocity: Ramp, taut: Mask) -> Iterator[Controls]:
    """Yield the controls of tensions, one a wire, and of the heights at some droppers."""
    at_once = FULL
    for demand in tension_demands(model, z):
        target = np.array([demand.target])
        yield Controls(demand.parameter, demand.measure, target, demand.law, velocity, at_once, demand.sense)
    droppers, law = model.layout.droppers, model.layout.height_law
    target, measure = droppers.height[taut], heights(model, z, taut)
    yield Controls(model.length[taut], measure, target, law, velocity, at_once, -1.0)


def weightless(model: SpatialModel, z: FloatArray) -> System:
    """Return the line without gravity, tensioned, with droppers that carry nothing: a start for motions."""
    demands: list[Contribution] = [
        *_tensions(model, z),
        *_nothing(model, np.ones(model.length.size, np.bool_)),
    ]
    free = replace(model.layout, g=0.0, holds=model.layout.holds.without_lift())
    return replace(model, layout=free).system(z, demands, FULL, built=False)


def as_built(model: SpatialModel, z: FloatArray, *, may_push: bool = False) -> System:
    """Return the system in which lengths, pulls and clamps are those of z: no targets, no guides."""
    return model.system(z, [], FULL, built=True, only_pull=not may_push)


def _tensions(model: SpatialModel, z: FloatArray) -> Iterator[Targets]:
    for demand in tension_demands(model, z):
        yield Targets(demand.parameter, demand.measure, np.array([demand.target]))
