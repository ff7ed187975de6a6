"""What cannot be built is refused by name: droppers in compression, upside down, or cut to nothing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InfeasibleError
from catenaria.formfinding.rest import Clamped
from catenaria.line import Line
from catenaria.results.form import Droppers

FloatArray = NDArray[np.float64]


def refuse_compression(line: Line, contact: Clamped) -> None:
    """Refuse a contact wire that droppers would have to push down.

    Parameters
    ----------
    line : Line
        The line.
    contact : Clamped
        The contact wire at rest: what the error carries.

    Raises
    ------
    InfeasibleError
        Naming the droppers, and what would help.

    Notes
    -----
    A dropper carries what hangs on it less what the tension T lifts by the kink k of the wanted heights,
    T_cd = W - T k: with T_cd < 0, no tension above T W/(W - T_cd) would do. Where W > T k, a string would
    pull, and it is the stiffness of the wire that pushes: droppers and supports are too close together.
    """
    force_bottom = contact.lift
    pushed = force_bottom < 0.0
    if np.any(pushed):
        carried, tension = _carried(contact), contact.setup.tension.force
        too_low = pushed & (carried <= tension * _kink(contact))
        advice = _CLOSE
        if np.any(too_low):
            enough = tension * float(np.min((carried / (carried - force_bottom))[too_low]))
            advice = (
                "The wanted heights are below where the tension lets the contact wire hang: a smaller "
                f"pre-sag, a tension below about {_two_digits(enough / 1e3)} kN or other dropper positions "
                "would help"
            )
        _refuse(line, pushed, force_bottom, "N", "would be in compression", advice, (contact,))


def _two_digits(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _carried(contact: Clamped) -> FloatArray:
    """Return what would hang on every dropper if the contact wire had no tension [N]."""
    setup = contact.setup
    held = np.union1d(setup.support_x, setup.droppers.x)
    place = np.searchsorted(held, setup.droppers.x)
    bay = 0.5 * (held[np.minimum(place + 1, held.size - 1)] - held[np.maximum(place - 1, 0)])
    return setup.g * (setup.section.rhoA * bay + setup.droppers.clamp_mass)


def _kink(contact: Clamped) -> FloatArray:
    """Return by how much the slope of straight lines between the wanted heights grows at every dropper."""
    setup = contact.setup
    x = np.concatenate((setup.support_x, setup.droppers.x))
    height = np.concatenate((np.full(setup.support_x.size, setup.height), setup.droppers.target))
    order = np.argsort(x, kind="stable")
    slope = np.diff(height[order]) / np.diff(x[order])
    return np.interp(setup.droppers.x, x[order][1:-1], np.diff(slope))


def refuse_impossible(line: Line, droppers: Droppers, steps: tuple[Clamped, Clamped]) -> None:
    """Refuse a schedule that cannot be built.

    Parameters
    ----------
    line : Line
        The line.
    droppers : Droppers
        The schedule.
    steps : tuple of Clamped
        Contact wire and messenger at rest: what the error carries.

    Raises
    ------
    InfeasibleError
        Naming droppers that would be in compression or without length, and what would help.
    """
    refuse_compression(line, steps[0])
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
    partial: tuple[Clamped, ...],
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


_CLOSE = (
    "The contact wire is too stiff for places so close together: droppers farther from each other and from "
    "supports would help"
)
_SLACK = "The messenger sags below the contact wire: more tension or higher supports would help"
_SHORT = "The clamps bridge more than there is between the wires: check the clamp heights"
