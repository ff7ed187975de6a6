"""The third step, and the gathering of all that was found, whatever way led to the equilibrium."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.history import control_names, control_units
from catenaria.discretise.read_back import stage, support_strain_tension, wire_form
from catenaria.discretise.wire_model import WireModel
from catenaria.errors import InfeasibleError
from catenaria.formfinding.versions import versions
from catenaria.line import Line
from catenaria.mechanics.controls.control import Controls as ControlBatch
from catenaria.results.form import Controls, Counters, Droppers, FormResult, History, Supports

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Rest:
    """Where one step ended.

    Attributes
    ----------
    model : WireModel
        What was brought to rest.
    t : float
        Time, after all ramps [s].
    z : FloatArray
        Unknowns.
    bands : tuple of float
        Within what the tension control and the dropper controls meet their targets [N or m].
    """

    model: WireModel
    t: float
    z: FloatArray
    bands: tuple[float, float]

    @property
    def controls(self) -> tuple[ControlBatch, ControlBatch]:
        """The tension control and the dropper controls in the elements that fit z."""
        tension, droppers = self.model.controls(self.model.system)
        return tension.relocate(self.z) or tension, droppers.relocate(self.z) or droppers


def clamp_height(step: Rest) -> FloatArray:
    """Return the height of the wire at every dropper [m]."""
    feet = np.array([cable.nodes[0, 2] for cable in step.model.droppers.chains])
    return step.z[feet]


def foot_force(step: Rest) -> FloatArray:
    """Return the forces T_cd that the droppers exert on the contact wire [N]."""
    return -step.z[step.model.droppers.clamp_force[:, 2]]


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
    droppers = dropper_schedule(line, contact, messenger)
    refuse_impossible(line, droppers, steps)
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


def dropper_schedule(line: Line, contact: Rest, messenger: Rest) -> Droppers:
    """Return the third step: lengths between the two clamps, and the lengths to cut."""
    kind = line.dropper
    foot, top = clamp_height(contact), clamp_height(messenger)
    length = np.linalg.norm(_clamps(messenger) - _clamps(contact), axis=1)
    force_bottom = foot_force(contact)
    force_top = messenger.z[messenger.model.droppers.clamp_force[:, 2]]
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


def _clamps(step: Rest) -> FloatArray:
    """Return where the droppers are clamped to the wire, shape (n, 3)."""
    return step.z[np.array([cable.nodes[0, :3] for cable in step.model.droppers.chains])]


def refuse_compression(line: Line, force_bottom: FloatArray, contact: Rest) -> None:
    """Refuse a contact wire that droppers would have to push down.

    Parameters
    ----------
    line : Line
        The line.
    force_bottom : FloatArray, shape (n,)
        Forces T_cd [N].
    contact : Rest
        The contact wire at rest: what the error carries.

    Raises
    ------
    InfeasibleError
        Naming the droppers, and what would help.

    Notes
    -----
    A dropper carries what hangs on it less what the tension T lifts by the kink k of the wanted heights,
    T_cd = W - T k: with T_cd < 0, no tension above T W/(W - T_cd) would do.
    """
    pushed = force_bottom < 0.0
    if np.any(pushed):
        carried = _carried(contact)[pushed]
        tension = contact.model.setup.tension.force
        enough = tension * float(np.min(carried / (carried - force_bottom[pushed])))
        advice = (
            "The wanted heights are below where the tension lets the contact wire hang: a smaller pre-sag, a "
            f"tension below about {_two_digits(enough / 1e3)} kN or other dropper positions would help"
        )
        _refuse(line, pushed, force_bottom, "N", "would be in compression", advice, (contact,))


def _two_digits(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _carried(contact: Rest) -> FloatArray:
    """Return what would hang on every dropper if the contact wire had no tension [N]."""
    setup = contact.model.setup
    held = np.union1d(setup.support_x, setup.droppers.x)
    place = np.searchsorted(held, setup.droppers.x)
    bay = 0.5 * (held[np.minimum(place + 1, held.size - 1)] - held[np.maximum(place - 1, 0)])
    return setup.g * (setup.section.rhoA * bay + setup.droppers.clamp_mass)


def refuse_impossible(line: Line, droppers: Droppers, steps: tuple[Rest, Rest]) -> None:
    """Refuse a schedule that cannot be built.

    Parameters
    ----------
    line : Line
        The line.
    droppers : Droppers
        The schedule.
    steps : tuple of Rest
        Contact wire and messenger at rest: what the error carries.

    Raises
    ------
    InfeasibleError
        Naming droppers that would be in compression or without length, and what would help.
    """
    refuse_compression(line, droppers.force_bottom, steps[0])
    distance = droppers.messenger_height - droppers.height
    _refuse(line, distance <= 0.0, distance, "m", "would stand upside down", _SLACK, steps)
    cut = droppers.cut_length
    _refuse(line, cut <= 0.0, cut, "m", "would be cut to nothing", _SHORT, steps)


def _refuse(
    line: Line,
    wrong: NDArray[np.bool_],
    size: FloatArray,
    unit: str,
    what: str,
    advice: str,
    partial: tuple[Rest, ...],
) -> None:
    if np.any(wrong):
        sizes = [f"{value:.4g} {unit}" for value in size[wrong]]
        where = _named(line, np.flatnonzero(wrong), sizes)
        raise InfeasibleError(f"droppers {what}: {where}. {advice}", partial)


def _numbers(line: Line) -> NDArray[np.int64]:
    """Return the number of every dropper within its span, shape (n,)."""
    span = np.array(line.dropper_span, dtype=np.int64)
    return np.arange(span.size) - np.searchsorted(span, span) + 1


def dropper_names(line: Line) -> tuple[str, ...]:
    """Return the names of all droppers: numbers within spans."""
    spans = line.dropper_span
    return tuple(f"dropper {n} in span {i + 1}" for n, i in zip(_numbers(line), spans, strict=True))


def _named(line: Line, droppers: NDArray[np.intp], sizes: list[str]) -> str:
    """Return numbers within spans with sizes; the span is named if there are several."""
    span = np.array(line.dropper_span)[droppers]
    numbers = _numbers(line)[droppers]
    named = [f"{n} ({size})" for n, size in zip(numbers, sizes, strict=True)]
    if len(line.spans) == 1:
        return ", ".join(named)
    return "; ".join(
        ", ".join(name for name, at in zip(named, span, strict=True) if at == i) + f" in span {i + 1}"
        for i in np.unique(span)
    )


_SLACK = "The messenger sags below the contact wire: more tension or higher supports would help"
_SHORT = "The clamps bridge more than there is between the wires: check the clamp heights"


def _on_wire(step: Rest) -> FloatArray:
    """Return the forces of droppers and clamps on the wire, shape (n, 3), without those of guides."""
    force = -step.z[step.model.droppers.clamp_force]
    along = 0.0 if step.model.setup.droppers.guided else 1.0
    return force * np.array([along, 1.0, 1.0])


def _supports(steps: tuple[Rest, ...], names: tuple[tuple[str, ...], ...]) -> Supports:
    models = [step.model for step in steps]
    force = np.concatenate([step.z[step.model.support_force] for step in steps])
    return Supports(
        support=tuple(name for held in names for name in held),
        wire=tuple(model.setup.name for model in models for _ in model.support_s),
        x=np.concatenate([model.setup.support_x for model in models]),
        z=np.concatenate([np.full(model.support_s.size, model.setup.height) for model in models]),
        force_x=force[:, 0],
        force_y=force[:, 1],
        force_z=force[:, 2],
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
