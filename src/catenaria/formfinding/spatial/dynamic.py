"""The dynamic equilibrium method in space: from the motion of a whole line to its form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.film import some_states
from catenaria.discretise.history import control_errors
from catenaria.discretise.spatial.film import film_droppers, film_wires
from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.discretise.spatial.model import FULL, SpatialModel
from catenaria.discretise.spatial.read_supports import hold_strain_tension
from catenaria.discretise.spatial.restart import start_from
from catenaria.formfinding.controlled_motion import Motion
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.spatial.gather import gather
from catenaria.formfinding.spatial.motion import MovingLine, at_start, move_line
from catenaria.formfinding.spatial.slack import with_slack
from catenaria.line import Line
from catenaria.line.alignment import Alignment
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.results.film import Film
from catenaria.results.form import Counters, FormResult, History
from catenaria.solvers.outcome import Solution

FloatArray = NDArray[np.float64]

_BANDS = 2.0  # of heights, by which the wire of a slack dropper may be too low


def find_by_motion(
    line: Line,
    listener: Listener | None,
    start: FormResult | None = None,
    filmed: Callable[[Film], None] | None = None,
    frames: int = 100,
) -> FormResult:
    """Find the form of a line in space by moving it until it rests.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    listener : callable or None
        Is told after every time step how far the motion is.
    start : FormResult, optional
        An earlier result to begin from, under full gravity, instead of the weightless line.
    filmed : callable, optional
        Receives a film of each motion when it is over.
    frames : int
        How many states a film has at most.

    Raises
    ------
    NotConvergedError, InfeasibleError, SingularError, InconsistentInputError
        See `catenaria.formfinding.dynamic_equilibrium.DynamicEquilibrium.find_form`.
    """
    if listener is not None:
        listener = _timed(listener)
        listener(Progress("line", 1, 2))
    moving = at_start(lay_out(line))
    if start is not None:
        moving = MovingLine.of(start_from(moving.model, start), 0.0)

    def find(slack: NDArray[np.bool_], before: Motion[MovingLine] | None) -> Motion[MovingLine]:
        begin = moving if before is None else moving.at(before.z, slack)
        motion = move_line(begin, line.solver.dynamic, listener)
        if filmed is not None:
            filmed(_film(motion, line.alignment, frames))
        return motion

    motions = with_slack(
        moving.model, find, lambda motion: motion.z, _BANDS * moving.model.layout.height_law.e0
    )
    bands = tuple(control.law.e0 for control in motions[-1].controls)
    joints = _joint_names(line, moving.model)
    return gather(
        line,
        moving.model,
        motions[-1].z,
        "dynamic",
        "; ".join(motion.solution.reason for motion in motions),
        tuple(map(_counters, motions)),
        tuple(_history(motion.model, motion.solution, joints) for motion in motions),
        bands,
    )


def _timed(listener: Listener) -> Listener:
    """Return a listener that is told as well for how long there has been work."""
    begin = perf_counter()
    return lambda progress: listener(replace(progress, elapsed=perf_counter() - begin))


def _energies(model: SpatialModel, z: FloatArray) -> FloatArray:
    """Return the axial and the bending term of (8) of all wires [J], shape (2,)."""
    energies = model.elements.energies(z).sum(axis=0)
    if model.has_pieces:
        energies += model.pieces(FULL).energies(z).sum(axis=0)
    return energies


def _joint_names(line: Line, model: SpatialModel) -> tuple[str, ...]:
    """Return the names of all places at which supports hold wires."""
    holds = model.layout.holds
    supports: list[int] = holds.support.tolist()
    wires: list[int] = holds.wire.tolist()
    pairs = zip(supports, wires, strict=True)
    return tuple(f"{line.supports[i].name}, {model.layout.wires[k].name}" for i, k in pairs)


def _history(moving: MovingLine, solution: Solution, joint_names: tuple[str, ...]) -> History:
    """Return control errors, parameters, tensions at supports and energies at every accepted time step."""
    model, controls = moving.model, moving.controls(moving.system)
    parameter = np.concatenate([control.parameter for control in controls])
    steps = list(zip(solution.t.tolist(), solution.y, solution.yd, strict=True))
    energies = np.array([_energies(model, z) for _, z, _ in steps])
    first = model.end_force[0]
    return History(
        step=moving.name,
        time=solution.t,
        step_size=solution.h,
        order=solution.order,
        control_name=moving.control_names,
        control_unit=moving.control_units,
        error=np.array([control_errors(controls, t, z) for t, z, _ in steps]),
        parameter=solution.y[:, parameter],
        velocity=solution.yd[:, parameter],
        joint_name=joint_names,
        joint_tension=np.array([hold_strain_tension(model, z) for _, z, _ in steps]),
        reaction=np.linalg.norm(solution.y[:, first], axis=2),
        kinetic=np.array([moving.inertia.kinetic_energy(zd) for _, _, zd in steps]),
        axial=energies[:, 0],
        bending=energies[:, 1],
    )


def _film(motion: Motion[MovingLine], alignment: Alignment, frames: int) -> Film:
    """Return at most `frames` states of a motion."""
    moving, ramp = motion.model, Ramp(motion.model.ramp_time)
    states = some_states(motion.solution, frames)
    unknowns, controls = [z for _, z in states], moving.controls(moving.system)
    laid, units = moving.model.layout.wires, moving.control_units
    return Film(
        step=moving.name,
        time=np.array([t for t, _ in states]),
        gravity=np.array([ramp(t) for t, _ in states]),
        wire=tuple(wire.name for wire in laid),
        role=tuple(wire.role for wire in laid),
        wires=film_wires(moving.model, alignment, unknowns),
        droppers=film_droppers(moving.model, unknowns),
        control_name=moving.control_names,
        control_quantity=tuple("tension" if unit == "N" else "height" for unit in units),
        control_unit=units,
        error=np.array([control_errors(controls, t, z) for t, z in states]),
    )


def _counters(motion: Motion[MovingLine]) -> Counters:
    work = motion.solution.counters
    return Counters(
        step=motion.model.name,
        simulated_time=motion.t,
        wall_time=motion.wall_time,
        steps=work.steps,
        rejected=work.rejected,
        newton_failures=work.newton_failures,
        residuals=work.residuals,
        jacobians=work.jacobians,
        factorisations=work.factorisations,
        unknowns=motion.system.size,
    )
