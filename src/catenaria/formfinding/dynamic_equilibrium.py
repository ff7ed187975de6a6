"""The dynamic equilibrium method of Yang et al. 2017: three steps to the form of a catenary, section 3.2.3.

First step: the contact wire alone, carried by the lower cables of the droppers, is pulled to its tension
while the droppers lift it to the wanted heights; the forces T_cd that they need are read. Second step: the
messenger wire alone is pulled to its tension while the upper cables of the droppers are drawn down until each
carries T_cd and the dropper's weight, eq. (23). Third step: the length of each dropper is the difference in
height of its two clamps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.history import control_names, control_units, history
from catenaria.discretise.read_back import stage, support_strain_tension, wire_form
from catenaria.discretise.restart import start_from, with_full_gravity
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.discretise.wire_setup import WireSetup
from catenaria.errors import InconsistentInputError
from catenaria.formfinding.controlled_motion import Motion, move, system_of, tolerances
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.settling import Settled, largest_error
from catenaria.formfinding.versions import versions
from catenaria.line import Line
from catenaria.results.form import Controls, Counters, Droppers, FormResult, Stage, Supports
from catenaria.solvers.outcome import Options, Step

FloatArray = NDArray[np.float64]

_STAGES = 3
_FIRST_STEP = 0.01  # part of the ramp in which next to nothing happens


@dataclass(frozen=True)
class DynamicEquilibrium:
    """The method, ready to be run on lines.

    Parameters
    ----------
    listener : callable, optional
        Is told after every time step how far the motion is.
    """

    listener: Listener | None = None

    def find_form(self, line: Line, start: FormResult | None = None) -> FormResult:
        """Find the form of a line.

        Parameters
        ----------
        line : Line
            What the engineer describes.
        start : FormResult, optional
            An earlier result from which both steps begin instead of straight, unstrained wires (Fig. 2).

        Returns
        -------
        FormResult

        Raises
        ------
        NotConvergedError
            If a step does not come to rest.
        InconsistentInputError
            If `start` does not fit the line.
        """
        begin = perf_counter()
        contact = self._step(line, contact_wire_setup(line), 1, start, begin)
        foot_height = clamp_height(contact)
        foot_force = -contact.z[contact.model.clamp_force[:, 2]]
        messenger = self._step(line, messenger_wire_setup(line, foot_force, foot_height), 2, start, begin)
        self._tell(Progress("lengths", 3, _STAGES, elapsed=perf_counter() - begin))
        return compose(line, contact, messenger)

    def _step(
        self, line: Line, setup: WireSetup, number: int, start: FormResult | None, begin: float
    ) -> Motion:
        self._tell(Progress(setup.name, number, _STAGES, elapsed=perf_counter() - begin))
        if start is None:
            model = build_wire_model(setup)
        else:
            earlier = _stage_of(start, setup.name)
            model = start_from(build_wire_model(with_full_gravity(setup)), earlier)
        options = line.solver.dynamic
        return move(
            model,
            tolerances(model, options.integrator.position_tolerance),
            Options(
                max_order=options.integrator.max_order,
                initial_step=_FIRST_STEP * options.ramp_time,
                max_steps=options.integrator.max_steps,
            ),
            Settled(options.settle.velocity, options.settle.dead_bands, options.settle.remaining_travel),
            options.integrator.max_time,
            self._observers(model, number, begin),
        )

    def _observers(self, model: WireModel, number: int, begin: float) -> tuple[Callable[[Step], None], ...]:
        """Return the observer that tells the listener about accepted time steps, if there is a listener."""
        listener = self.listener
        if listener is None:
            return ()
        names = control_names(model)

        def observe(step: Step) -> None:
            bands, batch, place = largest_error(model.controls(system_of(step)), step.t, step.y)
            elapsed = perf_counter() - begin
            worst = names[batch + place]
            listener(
                Progress(
                    model.setup.name,
                    number,
                    _STAGES,
                    step.t,
                    step.h,
                    step.number,
                    step.order,
                    worst,
                    bands,
                    elapsed,
                )
            )

        return (observe,)

    def _tell(self, progress: Progress) -> None:
        if self.listener is not None:
            self.listener(progress)


def clamp_height(motion: Motion) -> FloatArray:
    """Return the height of the wire at every dropper [m]."""
    feet = np.array([cable.nodes[0, 2] for cable in motion.model.cables])
    return motion.z[feet]


def compose(line: Line, contact: Motion, messenger: Motion) -> FormResult:
    """Carry out the third step and gather what was found."""
    motions = (contact, messenger)
    names = tuple(support.name for support in line.supports)
    held = tuple(names[i] for i in line.contact_support_indices)
    return FormResult(
        name=line.name,
        method="dynamic",
        stop_reason="; ".join(f"{motion.model.setup.name}: {motion.solution.reason}" for motion in motions),
        droppers=dropper_schedule(line, contact, messenger),
        wires=tuple(wire_form(motion.model, motion.controls[0], motion.t, motion.z) for motion in motions),
        supports=_supports(motions, (held, names)),
        controls=_controls(motions),
        histories=tuple(
            history(motion.model, motion.solution, held_by)
            for motion, held_by in zip(motions, (held, names), strict=True)
        ),
        counters=tuple(_counters(motion) for motion in motions),
        stages=tuple(stage(motion.model, motion.z) for motion in motions),
        inputs=line.model_dump(mode="json"),
        versions=versions(),
    )


def dropper_schedule(line: Line, contact: Motion, messenger: Motion) -> Droppers:
    """Return the third step: lengths from the two clamps' heights, and the lengths to cut."""
    kind = line.dropper
    foot, top = clamp_height(contact), clamp_height(messenger)
    length = top - foot
    force_bottom = -contact.z[contact.model.clamp_force[:, 2]]
    force_top = messenger.z[messenger.model.clamp_force[:, 2]]
    inner_force = 0.5 * (
        force_top - kind.clamp_mass_top * line.gravity + force_bottom + kind.clamp_mass_bottom * line.gravity
    )
    unstressed = length / stretch(inner_force, line.conductors[kind.conductor].EA)
    span = np.array(line.dropper_span)
    target = np.array(line.dropper_target_height)
    return Droppers(
        span=span + 1,
        number=np.concatenate(
            [np.arange(1, np.count_nonzero(span == i) + 1) for i in range(len(line.spans))]
        ),
        x=np.array(line.dropper_x),
        length=length,
        unstressed_length=unstressed,
        cut_length=unstressed - kind.clamp_height_top - kind.clamp_height_bottom,
        force_top=force_top,
        force_bottom=force_bottom,
        height=foot,
        target_height=target,
        height_error=foot - target,
        messenger_height=top,
        force_error=messenger.controls[1].error(messenger.t, messenger.z),
        contact_coordinate=contact.z[contact.model.clamp_s],
        messenger_coordinate=messenger.z[messenger.model.clamp_s],
        on_contact=_on_wire(contact),
        on_messenger=_on_wire(messenger),
    )


def _on_wire(motion: Motion) -> FloatArray:
    """Return the forces of droppers and clamps on the wire, shape (n, 3), without those of guides."""
    force = -motion.z[motion.model.clamp_force]
    along = 0.0 if motion.model.setup.droppers.guided else 1.0
    return force * np.array([along, 1.0, 1.0])


def _supports(motions: tuple[Motion, ...], names: tuple[tuple[str, ...], ...]) -> Supports:
    models = [motion.model for motion in motions]
    force = np.concatenate([motion.z[motion.model.support_force] for motion in motions])
    return Supports(
        support=tuple(name for held in names for name in held),
        wire=tuple(model.setup.name for model in models for _ in model.support_s),
        x=np.concatenate([model.setup.support_x for model in models]),
        z=np.concatenate([np.full(model.support_s.size, model.setup.height) for model in models]),
        force_x=force[:, 0],
        force_y=force[:, 1],
        force_z=force[:, 2],
        tension=np.concatenate([support_strain_tension(motion.model, motion.z) for motion in motions]),
        sliding_coordinate=np.concatenate([motion.z[motion.model.support_s] for motion in motions]),
    )


def _controls(motions: tuple[Motion, ...]) -> Controls:
    batches = [(motion, control) for motion in motions for control in motion.controls]
    target = np.concatenate([control.target for _, control in batches])
    error = np.concatenate([control.error(motion.t, motion.z) for motion, control in batches])
    return Controls(
        name=tuple(name for motion in motions for name in control_names(motion.model)),
        unit=tuple(unit for motion in motions for unit in control_units(motion.model)),
        target=target,
        value=target + error,
        error=error,
        dead_band=np.concatenate([np.full(control.target.size, control.law.e0) for _, control in batches]),
        parameter=np.concatenate([motion.z[control.parameter] for motion, control in batches]),
    )


def _counters(motion: Motion) -> Counters:
    work = motion.solution.counters
    return Counters(
        step=motion.model.setup.name,
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


def _stage_of(result: FormResult, name: str) -> Stage:
    for candidate in result.stages:
        if candidate.step == name:
            return candidate
    raise InconsistentInputError(f"the earlier result has no step {name!r} to start from")
