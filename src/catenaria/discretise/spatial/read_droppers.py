"""From a state of a line in space to its dropper schedule, and to what else is clamped to wires."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.natural import Natural
from catenaria.line import Line
from catenaria.results.form import Droppers, Masses, Ties

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def dropper_schedule(line: Line, state: Natural) -> Droppers:
    """Return lengths, places and forces of all droppers.

    Notes
    -----
    Forces on wires are those of a straight bar, half of its weight on either end, and of the clamps; the
    table's forces at top and bottom are their components along the dropper.
    """
    model, z, laid = state.model, state.solved, state.model.layout.droppers
    kind, frame = line.dropper, laid.frame
    bottom = model.lower_carrier.evaluate(z, z[model.lower_s]).r
    top = model.upper_carrier.evaluate(z, z[model.upper_s]).r
    length = np.linalg.norm(top - bottom, axis=1)
    up = (top - bottom) / length[:, None]
    on_lower, on_upper = model.bars(z).loads(0.0, z)
    height = frame.height(bottom)
    unstressed = z[model.length]
    return Droppers(
        lower_wire=_names(state, laid.lower),
        upper_wire=_names(state, laid.upper),
        span=laid.span,
        number=laid.number,
        x=frame.chainage,
        position_bottom=bottom,
        position_top=top,
        stagger_bottom=frame.lateral(bottom),
        stagger_top=frame.lateral(top),
        length=length,
        unstressed_length=unstressed,
        cut_length=unstressed - kind.clamp_height_top - kind.clamp_height_bottom,
        force_top=-np.einsum("ni,ni->n", on_upper, up),
        force_bottom=np.einsum("ni,ni->n", on_lower, up),
        height=height,
        target_height=laid.height,
        height_error=height - laid.height,
        messenger_height=frame.height(top),
        force_error=np.zeros_like(length),  # one bar bears one force
        contact_coordinate=state.z[model.lower_s],
        messenger_coordinate=state.z[model.upper_s],
        on_contact=on_lower,
        on_messenger=on_upper,
    )


def ties(state: Natural) -> Ties:
    """Return where ends of wires are clamped to other wires, and with what forces."""
    model, laid = state.model, state.model.layout.ties
    return Ties(
        wire=_names(state, laid.wire),
        host=_names(state, laid.host),
        end=laid.end,
        chainage=laid.frame.chainage,
        coordinate=state.z[model.tie_s],
        force=state.z[model.tie_force],
    )


def masses(state: Natural) -> Masses:
    """Return where point masses hang."""
    laid = state.model.layout.masses
    return Masses(
        name=laid.name,
        wire=_names(state, laid.wire),
        chainage=laid.frame.chainage,
        coordinate=state.z[state.model.mass_s],
        mass=laid.mass,
    )


def _names(state: Natural, wires: IntArray) -> tuple[str, ...]:
    laid = state.model.layout.wires
    return tuple(laid[int(k)].name for k in wires)
