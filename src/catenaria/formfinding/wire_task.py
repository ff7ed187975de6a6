"""One wire to be found at rest with all targets met: with its dropper cables, or alone with their forces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.guess import guess_equilibrium, place_droppers
from catenaria.discretise.hung_wire import HungWire, copy_wire
from catenaria.discretise.wire_alone import WireAlone, build_wire_alone
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.discretise.wire_setup import WireSetup
from catenaria.formfinding.free_motion import Names
from catenaria.formfinding.rest import Clamped, Rest
from catenaria.formfinding.static_problem import statics
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.system import System

FloatArray = NDArray[np.float64]

_BAND = (1e-3, 1e-6)  # N and m, within which targets count as met in the result


@dataclass(frozen=True)
class WireTask:
    """What finds a wire at rest needs to know of it.

    Attributes
    ----------
    hung : HungWire
        The wire.
    system : System
        Equilibrium and targets.
    guess : callable
        Returns unknowns near the rest of the wire it is given, which may have another tension.
    clamped, rest : callable
        Return what was found from the unknowns: at the droppers, and all of it.
    parts : tuple
        Names of parts, each with the indices of its unknowns, for messages.
    """

    hung: HungWire
    system: System
    guess: Callable[[HungWire], FloatArray]
    clamped: Callable[[FloatArray], Clamped]
    rest: Callable[[FloatArray], Rest]
    parts: Names


def wire_alone_task(setup: WireSetup, names: tuple[str, ...]) -> WireTask:
    """Return the task for a wire with guided droppers, of which only the forces matter."""
    model = build_wire_alone(setup)
    forces = [(name, index) for name, index in zip(names, model.clamp_force, strict=True)]
    return WireTask(
        model.hung,
        model.system,
        lambda hung: replace(model, hung=hung).guess(),
        lambda z: Clamped.of_wire_alone(model, z),
        lambda z: _with_cables(model, z),
        [*_wire_parts(model.hung), *forces, ("a dropper clamp", model.hung.clamp_s)],
    )


def wire_with_cables_task(setup: WireSetup, names: tuple[str, ...]) -> WireTask:
    """Return the task for a wire with the dropper cables of the paper, guided or frictionless."""
    model = build_wire_model(replace(setup, gravity_ramp=Ramp(0.0)))
    droppers = model.droppers
    travels = ((f"the travel of {name}", at) for name, at in zip(names, droppers.travel, strict=True))
    cables = ((name, chain.nodes) for name, chain in zip(names, droppers.chains, strict=True))
    clamps = np.concatenate((model.clamp_s, droppers.clamp_force.ravel()))
    ends = ("the far end of a dropper", droppers.free_force)
    return WireTask(
        model,
        statics(model.system, model.system.unknowns.start),
        lambda hung: guess_equilibrium(replace(model, setup=hung.setup, tensioned=hung.tensioned)),
        lambda z: _rest(model, z).clamped,
        lambda z: _rest(model, z),
        [*_wire_parts(model), *travels, *cables, ("a dropper clamp", clamps), ends],
    )


def guessed_clamps(setup: WireSetup, names: tuple[str, ...]) -> Clamped:
    """Return what a taut wire would be clamped with, for lines that are not found."""
    task = wire_alone_task(setup, names)
    return task.clamped(task.guess(task.hung))


def _wire_parts(hung: HungWire) -> list[tuple[str, NDArray[np.int64]]]:
    wire = hung.setup.name
    supports = np.concatenate((hung.support_s, hung.support_force.ravel()))
    return [
        (f"the {wire}", hung.wire.nodes),
        (f"the pull at the ends of the {wire}", hung.pull),
        (f"a support of the {wire}", supports),
        (f"an end of the {wire}", hung.end_force),
    ]


def _rest(model: WireModel, z: FloatArray) -> Rest:
    return Rest(model, 0.0, z, (_BAND[0], _BAND[1] if model.setup.droppers.up else _BAND[0]))


def _with_cables(alone: WireAlone, z: FloatArray) -> Rest:
    """Return the same rest with the dropper cables of the guessed length that carry the found forces."""
    model = build_wire_model(replace(alone.hung.setup, gravity_ramp=Ramp(0.0)))
    complete = model.system.unknowns.start.copy()
    copy_wire(model, alone.hung, z, complete)
    upwards = 1.0 if model.setup.droppers.up else -1.0
    place_droppers(model, complete, -upwards * z[alone.clamp_force])
    return _rest(model, complete)
