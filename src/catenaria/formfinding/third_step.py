"""The third step, and the gathering of all that was found, whatever way led to the equilibrium."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.history import control_names, control_units
from catenaria.discretise.read_back import stage, support_strain_tension, wire_form
from catenaria.formfinding.refusals import refuse_impossible
from catenaria.formfinding.rest import Clamped, Rest
from catenaria.formfinding.versions import versions
from catenaria.line import Line
from catenaria.results.form import Controls, Counters, Droppers, FormResult, History, Supports

FloatArray = NDArray[np.float64]


def gather(
    line: Line,
    method: str,
    reason: str,
    contact: Rest,
    messenger: Rest,
    counters: tuple[Counters, ...],
    histories: tuple[History, ...] = (),
) -> FormResult:
    """Carry out the third step and gather what was found.

    Parameters
    ----------
    line : Line
        The line.
    method, reason : str
        Name of the method, and why it stopped.
    contact, messenger : Rest
        Where the first and the second step ended.
    counters, histories
        Work, and the course of the steps if there was one.

    Raises
    ------
    InfeasibleError
        If the schedule cannot be built; see `refuse_impossible`.
    """
    steps = (contact, messenger)
    clamped = contact.clamped, messenger.clamped
    droppers = dropper_schedule(line, *clamped)
    refuse_impossible(line, droppers, clamped)
    return FormResult(
        name=line.name,
        method=method,
        stop_reason=reason,
        droppers=droppers,
        wires=tuple(wire_form(step.model, step.controls[0], step.t, step.z) for step in steps),
        supports=_supports(steps, support_names(line)),
        controls=_controls(steps),
        histories=histories,
        counters=counters,
        stages=tuple(stage(step.model, step.z) for step in steps),
        inputs=line.model_dump(mode="json"),
        versions=versions(),
    )


def support_names(line: Line) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the names of the supports that hold the contact wire, and of those that hold the messenger."""
    names = tuple(support.name for support in line.supports)
    return tuple(names[i] for i in line.contact_support_indices), names


def dropper_schedule(line: Line, contact: Clamped, messenger: Clamped) -> Droppers:
    """Return the third step: lengths between the two clamps, and the lengths to cut."""
    kind = line.dropper
    length = np.linalg.norm(messenger.position - contact.position, axis=1)
    force_bottom, force_top = contact.lift, -messenger.lift
    inner_force = 0.5 * (
        force_top - kind.clamp_mass_top * line.gravity + force_bottom + kind.clamp_mass_bottom * line.gravity
    )
    unstressed = length / stretch(inner_force, line.conductor(kind.conductor).EA)
    span = np.array(line.dropper_span)
    target = np.array(line.dropper_target_height)
    return Droppers(
        lower_wire=(contact.setup.name,) * span.size,
        upper_wire=(messenger.setup.name,) * span.size,
        span=span + 1,
        number=np.concatenate(
            [np.arange(1, np.count_nonzero(span == i) + 1) for i in range(len(line.spans))]
        ),
        x=np.array(line.dropper_x),
        position_bottom=contact.position,
        position_top=messenger.position,
        stagger_bottom=contact.position[:, 1].copy(),
        stagger_top=messenger.position[:, 1].copy(),
        length=length,
        unstressed_length=unstressed,
        cut_length=unstressed - kind.clamp_height_top - kind.clamp_height_bottom,
        force_top=force_top,
        force_bottom=force_bottom,
        height=contact.height,
        target_height=target,
        height_error=contact.height - target,
        messenger_height=messenger.height,
        force_error=messenger.error,
        contact_coordinate=contact.s,
        messenger_coordinate=messenger.s,
        on_contact=contact.on_wire,
        on_messenger=messenger.on_wire,
    )


def _supports(steps: tuple[Rest, ...], names: tuple[tuple[str, ...], ...]) -> Supports:
    models = [step.model for step in steps]
    x = np.concatenate([model.setup.support_x for model in models])
    z = np.concatenate([np.full(model.support_s.size, model.setup.height) for model in models])
    force = np.concatenate([step.z[step.model.support_force] for step in steps])
    return Supports(
        support=tuple(name for held in names for name in held),
        wire=tuple(model.setup.name for model in models for _ in model.support_s),
        kind=("sliding",) * x.size,
        x=x,
        y=np.zeros_like(x),
        z=z,
        chainage=x,
        stagger=np.zeros_like(x),
        height=z,
        force_x=force[:, 0],
        force_y=force[:, 1],
        force_z=force[:, 2],
        force_lateral=force[:, 1],
        tension=np.concatenate([support_strain_tension(step.model, step.z) for step in steps]),
        sliding_coordinate=np.concatenate([step.z[step.model.support_s] for step in steps]),
    )


def _controls(steps: tuple[Rest, ...]) -> Controls:
    batches = [(step, control) for step in steps for control in step.controls]
    target = np.concatenate([control.target for _, control in batches])
    error = np.concatenate([control.error(step.t, step.z) for step, control in batches])
    return Controls(
        name=tuple(name for step in steps for name in control_names(step.model)),
        unit=tuple(unit for step in steps for unit in control_units(step.model)),
        target=target,
        value=target + error,
        error=error,
        dead_band=np.concatenate(
            [
                np.full(control.target.size, band)
                for step in steps
                for control, band in zip(step.controls, step.bands, strict=True)
            ]
        ),
        parameter=np.concatenate([step.z[control.parameter] for step, control in batches]),
    )
