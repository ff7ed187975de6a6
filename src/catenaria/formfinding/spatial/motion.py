"""The dynamic equilibrium method for a whole line in space: moved by its controls until it rests.

The paper moves one wire after the other from straight, unstrained wires. In space, wires pull at each other
sideways through inclined droppers, so that all of them move together. The motion begins where the line would
rest without weight: wires taut by their tensions, droppers without force. From there gravity grows as in
(31), devices pull at the wires' ends as in (19)-(20), and droppers become longer or shorter by the law (21)
until the contact wire is as high as wanted. The dropper forces (23) need no control: a dropper that hangs
between two wires of one system passes its force on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from catenaria.discretise.spatial.demands import to_move, weightless
from catenaria.discretise.spatial.guess import guess
from catenaria.discretise.spatial.guess import weightless as weightless_guess
from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.model import FULL, SpatialModel, build_model
from catenaria.discretise.spatial.numbering import graded_meshes
from catenaria.discretise.spatial.read_back import control_names, control_units
from catenaria.formfinding.controlled_motion import Motion, move, system_of
from catenaria.formfinding.motion_problem import Tolerances
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.settling import Settled, largest_error
from catenaria.formfinding.spatial.at_rest import parts_of
from catenaria.formfinding.static_problem import find_rest
from catenaria.line import DynamicOptions
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.loads.linear import Inertia, RayleighDamping, assemble
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind
from catenaria.solvers.outcome import Options, Step

FloatArray = NDArray[np.float64]

_FIRST_STEP = 0.01  # part of the ramp in which next to nothing happens
_LARGEST_FORCE = 1e-2  # N: forces are wanted to a tenth of a newton even with wide bands
_NEGLIGIBLE = 0.05  # part of a dead band that a Newton correction may leave undone
_RESOLVED = 0.02  # part of the width of a velocity law by which a control may err in one time step


@dataclass(frozen=True)
class MovingLine:
    """A line in space with inertia and controls, at the start of its motion.

    Attributes
    ----------
    model : SpatialModel
        The line; its unknowns start where the motion does.
    system : System
        At the start.
    inertia : Inertia
        Of all wires; droppers, clamps and masses are weights only.
    ramp_time : float
        Until when gravity and control velocities grow [s].
    slack : NDArray of bool, shape (n_droppers,)
        Droppers that carry nothing.
    """

    model: SpatialModel
    system: System
    inertia: Inertia
    ramp_time: float
    slack: NDArray[np.bool_]

    @property
    def name(self) -> str:
        """Name, for messages."""
        count = np.count_nonzero(self.slack)
        return f"line with {count} slack droppers" if count else "line"

    @property
    def control_names(self) -> tuple[str, ...]:
        """Names of all controls."""
        return self._controlled(control_names(self.model))

    @property
    def control_units(self) -> tuple[str, ...]:
        """Units of their errors."""
        return self._controlled(control_units(self.model))

    def _controlled(self, every: tuple[str, ...]) -> tuple[str, ...]:
        there = np.append(np.ones(len(every) - self.slack.size, dtype=np.bool_), ~self.slack)
        return tuple(name for name, own in zip(every, there, strict=True) if own)

    @classmethod
    def of(cls, model: SpatialModel, ramp_time: float, slack: NDArray[np.bool_] | None = None) -> MovingLine:
        """Return a line that begins to move where its unknowns start, with droppers that carry nothing."""
        start = model.unknowns.start
        slack = np.zeros(model.length.size, dtype=np.bool_) if slack is None else slack
        still, inertia = to_move(model, start, Ramp(ramp_time), slack), _inertia(model)
        parts = (*still.contributions, inertia)
        alpha, beta = model.layout.damping
        if alpha or beta:
            stiffness = assemble(model.elements, model.elements.stiffness(start), start.size)
            parts = (*parts, RayleighDamping(csr_array(alpha * inertia.M + beta * stiffness)))
        return cls(model, System(still.unknowns, parts), inertia, ramp_time, slack)

    def at(self, z: FloatArray, slack: NDArray[np.bool_]) -> MovingLine:
        """Return the line where it has come to rest, to move on with other droppers that carry nothing."""
        return MovingLine.of(replace(self.model, unknowns=replace(self.model.unknowns, start=z)), 0.0, slack)

    def controls(self, system: System) -> tuple[Controls, ...]:
        """Return the controls with the discrete state of the given system: tensions, then heights."""
        return tuple(part for part in system.contributions if isinstance(part, Controls))


def _inertia(model: SpatialModel) -> Inertia:
    mass = assemble(model.elements, model.elements.mass(), model.unknowns.size)
    if model.has_pieces:
        pieces = model.pieces(FULL)
        mass = csr_array(mass + assemble(pieces.elements, pieces.mass(), model.unknowns.size))
    return Inertia(mass)


def at_start(layout: Layout) -> MovingLine:
    """Return a line at rest without weight, from which the motion begins.

    Raises
    ------
    NotConvergedError, InfeasibleError, SingularError
        If there is no such rest.
    """
    full = guess(layout)
    model = build_model(layout, weightless_guess(layout, full), graded_meshes(layout, full))
    z = model.unknowns.start
    root = find_rest(weightless(model, z), z, names=parts_of(model))
    resting = replace(model, unknowns=replace(model.unknowns, start=root.y))
    return MovingLine.of(resting, layout.ramp_time)


def move_line(
    moving: MovingLine, options: DynamicOptions, listener: Listener | None = None
) -> Motion[MovingLine]:
    """Integrate a line from its weightless start until it is settled.

    Parameters
    ----------
    moving : MovingLine
        The line at its start.
    options : DynamicOptions
        Of the dynamic method.
    listener : callable, optional
        Receives a `Progress` after every time step.

    Raises
    ------
    NotConvergedError, InfeasibleError
        See `controlled_motion.move`.
    """
    integrator, settle = options.integrator, options.settle
    return move(
        moving,
        _tolerances(moving, integrator.position_tolerance),
        Options(
            max_order=integrator.max_order,
            initial_step=_FIRST_STEP * options.ramp_time,
            max_steps=integrator.max_steps,
            permc_spec="NATURAL",
        ),
        Settled(settle.velocity, settle.dead_bands, settle.remaining_travel),
        integrator.max_time,
        () if listener is None else (_observer(moving, listener),),
    )


def _tolerances(moving: MovingLine, position: float) -> Tolerances:
    """Return tolerances at which Newton's method leaves no control in doubt about its dead band.

    A step that errs by more than the width of a law would jump across its dead band.
    """
    model, controls = moving.model, moving.controls(moving.system)
    tensions, heights = controls[:-1], controls[-1]
    force = min(_LARGEST_FORCE, _NEGLIGIBLE * min(control.law.e0 for control in tensions))
    compliance = min(chain.knots[-1] / chain.section.EA for chain in model.wires)
    errors = np.full(model.unknowns.size, position)
    for control, chain in zip(tensions, model.wires, strict=True):
        stiffness = 2.0 * chain.section.EA / chain.knots[-1]
        errors[control.parameter] = min(position, _RESOLVED * (control.law.e1 - control.law.e0) / stiffness)
    errors[heights.parameter] = min(position, _RESOLVED * (heights.law.e1 - heights.law.e0))
    parameter = errors[model.unknowns.where(Kind.PARAMETER)]
    return Tolerances(position, parameter, force * float(compliance), force)


def _observer(moving: MovingLine, listener: Listener) -> Callable[[Step], None]:
    """Return what tells the listener about accepted time steps."""
    names = moving.control_names
    tensions = len(moving.model.wires)

    def observe(step: Step) -> None:
        controls = moving.controls(system_of(step))
        bands, batch, place = largest_error(controls, step.t, step.y)
        worst = names[min(batch, tensions) + place]
        listener(Progress(moving.name, 1, 2, step.t, step.h, step.number, step.order, worst, bands))

    return observe
