"""A film of a controlled motion: where all nodes are in some of its accepted time steps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.history import control_errors, control_names, control_units
from catenaria.discretise.wire_model import WireModel
from catenaria.mechanics.chain import Chain
from catenaria.results.film import Film, Polylines
from catenaria.solvers.outcome import Solution

FloatArray = NDArray[np.float64]
State = tuple[float, FloatArray]


def some_states(solution: Solution, frames: int) -> list[State]:
    """Return times and unknowns of at most `frames` time steps, the first and the last one among them."""
    count = len(solution.t)
    kept = np.unique(np.linspace(0, count - 1, min(frames, count)).round().astype(np.intp))
    return [(float(solution.t[i]), solution.y[i]) for i in kept]


def film(model: WireModel, solution: Solution, frames: int) -> Film:
    """Return at most `frames` states of the motion of a wire in the plane, with its dropper cables."""
    states = some_states(solution, frames)
    setup, controls = model.setup, model.controls(model.system)
    lifted = "height" if setup.droppers.up else "dropper force"
    return Film(
        step=setup.name,
        time=np.array([t for t, _ in states]),
        gravity=np.array([setup.gravity_ramp(t) for t, _ in states]),
        wire=(setup.name,),
        role=(setup.name,),
        wires=_polylines((model.wire,), states),
        droppers=_polylines(model.droppers.chains, states),
        control_name=control_names(model),
        control_quantity=("tension",) + (lifted,) * len(model.droppers.chains),
        control_unit=control_units(model),
        error=np.array([control_errors(controls, t, z) for t, z in states]),
    )


def _polylines(chains: Sequence[Chain], states: Sequence[State]) -> Polylines:
    """Return nodes in the axes of the line, which in the plane are those of the track."""
    nodes = np.concatenate([np.empty((0, 3), np.int64), *(chain.nodes[:, :3] for chain in chains)])
    r = np.array([z[nodes] for _, z in states])
    count = np.array([chain.knots.size for chain in chains], dtype=np.int64)
    return Polylines(count, *np.moveaxis(r, 2, 0).copy())
