"""From a state of a line in space to what was found for each wire."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.read_back import NEAR, SAMPLES, element_tension, sag, stretched_length
from catenaria.discretise.spatial.demands import TensionDemand, tension_demands
from catenaria.discretise.spatial.natural import Natural
from catenaria.discretise.spatial.on_track import located, track_profiles
from catenaria.line.alignment import Alignment
from catenaria.results.form import Profile, WireForm

FloatArray = NDArray[np.float64]


def wire_forms(state: Natural, alignment: Alignment) -> tuple[WireForm, ...]:
    """Return what was found for all wires."""
    profiles = track_profiles(state, alignment)
    hung = located(state, alignment, [_hung(state, k) for k in range(len(state.wires))])
    sags = [
        sag(shape, frames.chainage, frames.height(r))
        for shape, frames, r in zip(profiles, *hung, strict=True)
    ]
    demands = {demand.wire: demand for demand in tension_demands(state.model, state.solved)}
    return tuple(_wire_form(state, alignment, demands[k], profiles[k], sags[k]) for k in range(len(profiles)))


def _wire_form(
    state: Natural, alignment: Alignment, demand: TensionDemand, shape: Profile, depth: float
) -> WireForm:
    k = demand.wire
    laid, wire, z = state.model.layout.wires[k], state.wires[k], state.z
    start, end = (0.0, float(wire.knots[-1])) if laid.tied else _held(state, k)
    between = (wire.knots[:-1] >= start - NEAR) & (wire.knots[1:] <= end + NEAR)
    tension, L = element_tension(wire, z)[between], wire.L[between]
    measured = float(demand.measure.value(0.0, state.solved)[0])
    end_force = _end_force(state, k)
    reaction = np.linalg.norm(end_force, axis=1)
    along = np.abs(np.einsum("ni,ni->n", alignment.frames(shape.chainage[[0, -1]]).along, end_force))
    return WireForm(
        name=laid.name,
        role=laid.role,
        unstressed_length=end - start,
        stretched_length=stretched_length(wire, z, start, end),
        target_tension=demand.target,
        tension=measured,
        tension_error=measured - demand.target,
        measure=laid.tension.measure,
        horizontal_start=float(along[0]),
        horizontal_end=float(along[1]),
        reaction_start=float(reaction[0]),
        reaction_end=float(reaction[1]),
        end_force=end_force,
        tension_min=float(tension.min()),
        tension_max=float(tension.max()),
        tension_mean=float(tension @ L / L.sum()),
        travel=float(z[demand.parameter[0]]),
        sag=depth,
        profile=shape,
        start_x=shape.chainage[::SAMPLES],
        start_z=shape.height[::SAMPLES],
    )


def _held(state: Natural, wire: int) -> tuple[float, float]:
    """Return the material coordinates of a wire's first and last support [m]."""
    s = state.z[state.model.hold_s[state.model.layout.holds.wire == wire]]
    return float(s.min()), float(s.max())


def _end_force(state: Natural, wire: int) -> FloatArray:
    """Return the forces of a wire's start and end on what holds them, shape (2, 3) [N]."""
    model, ties = state.model, state.model.layout.ties
    if not model.layout.wires[wire].tied:
        return state.z[model.end_force[wire]]
    own = np.flatnonzero(ties.wire == wire)
    return state.z[model.tie_force[own[np.argsort(ties.end[own])]]]


def _hung(state: Natural, wire: int) -> FloatArray:
    """Return the material coordinates at which a wire hangs [m].

    These are at its supports, and at droppers that hold it; its ends if it has no supports.
    """
    model, layout = state.model, state.model.layout
    s = [
        state.z[model.hold_s[layout.holds.wire == wire]],
        state.z[model.lower_s[layout.droppers.lower == wire]],
    ]
    if layout.wires[wire].tied:
        s.append(state.wires[wire].knots[[0, -1]])
    return np.sort(np.concatenate(s))
