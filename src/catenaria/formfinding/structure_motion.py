"""The motion of a free structure under its controls until it rests: the dynamic method for structures."""

from __future__ import annotations

from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.controlled_motion import Motion, Observer, move, system_of
from catenaria.formfinding.motion_problem import Tolerances
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.settling import Settled, largest_error
from catenaria.formfinding.structure_statics import ROUNDING, force_scale
from catenaria.mechanics.unknowns import Kind
from catenaria.solvers.outcome import Options, Step
from catenaria.structure.model import StructureModel

FloatArray = NDArray[np.float64]

_LARGEST_FORCE = 1e-2  # N: forces are wanted to a tenth of a newton even with wide bands
_NEGLIGIBLE = 0.05  # part of a dead band that a Newton correction may leave undone
_RESOLVED = 0.02  # part of the width of a velocity law by which a control may err in one time step
_FIRST_STEP = 0.01  # part of the ramp in which next to nothing happens


def move_structure(model: StructureModel, listener: Listener | None = None) -> Motion[StructureModel]:
    """Integrate a structure from its start until it is settled, by the options of its description.

    Parameters
    ----------
    model : StructureModel
        The structure at its start.
    listener : callable, optional
        Receives a `Progress` after every time step.

    Raises
    ------
    NotConvergedError, InfeasibleError
        See `controlled_motion.move`.
    """
    solver = model.structure.solver
    integrator, settle = solver.integrator, solver.settle
    return move(
        model,
        _tolerances(model, integrator.position_tolerance),
        Options(
            max_order=integrator.max_order,
            initial_step=_FIRST_STEP * model.ramp_time or None,
            max_steps=integrator.max_steps,
        ),
        Settled(settle.velocity, settle.dead_bands, settle.remaining_travel),
        integrator.max_time,
        () if listener is None else (_observer(model, listener),),
    )


def _tolerances(model: StructureModel, position: float) -> Tolerances:
    """Return tolerances at which Newton's method leaves no control in doubt about its dead band.

    A cable of length L turns a correction of d metres into EA d/L newtons, as in
    `controlled_motion.tolerances`; positions are known to the last bit at best.
    """
    controls, heights = model.controls(model.system), model.structure.heights
    bands = [c.law.e0 for name, c in zip(model.parameter, controls, strict=True) if name not in heights]
    least = min(_LARGEST_FORCE, _NEGLIGIBLE * min(bands, default=np.inf))
    compliance = min(float(chain.knots[-1]) / chain.section.EA for chain in model.chains.values())
    extent = float(np.abs(model.start[model.system.unknowns.where(Kind.POSITION)]).max())
    return Tolerances(
        position,
        _parameter_errors(model, position),
        max(least * compliance, ROUNDING * extent),
        force_scale(model, least)[model.system.unknowns.where(Kind.MULTIPLIER)],
    )


def _parameter_errors(model: StructureModel, position: float) -> FloatArray:
    """Return the error of each control parameter that leaves its law resolved [m]."""
    errors: list[float] = []
    tensions, balances = model.structure.tensions, model.structure.balances
    for name, control in zip(model.parameter, model.controls(model.system), strict=True):
        width = _RESOLVED * (control.law.e1 - control.law.e0)
        if name in tensions:
            wire = next(at.wire for at in model.joints if at.name == tensions[name].joint)
            width *= float(wire.knots[-1]) / (2.0 * wire.section.EA)
        errors.append(position if name in balances else min(position, width))
    return np.array(errors)


def _observer(model: StructureModel, listener: Listener) -> Observer:
    names, begin = tuple(model.parameter) or ("",), perf_counter()

    def observe(step: Step) -> None:
        bands, control, _ = largest_error(model.controls(system_of(step)), step.t, step.y)
        listener(
            Progress(
                stage="motion",
                stage_number=1,
                stage_count=1,
                time=step.t,
                step_size=step.h,
                step=step.number,
                order=step.order,
                worst_control=names[control],
                worst_error_in_bands=bands,
                elapsed=perf_counter() - begin,
            )
        )

    return observe
