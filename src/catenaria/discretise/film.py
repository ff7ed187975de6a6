"""A film of a controlled motion: positions of all nodes in some of its accepted time steps."""

from __future__ import annotations

import numpy as np

from catenaria.discretise.history import control_errors, control_names, control_units
from catenaria.discretise.wire_model import WireModel
from catenaria.results.film import Film
from catenaria.solvers.outcome import Solution


def film(model: WireModel, solution: Solution, frames: int) -> Film:
    """Return at most `frames` states of a motion, the first and the last one among them."""
    count = len(solution.t)
    kept = np.unique(np.linspace(0, count - 1, min(frames, count)).round().astype(np.intp))
    chains = (model.wire, *model.droppers.chains)
    nodes = np.concatenate([chain.nodes[:, :3] for chain in chains])
    controls = model.controls(model.system)
    times = solution.t[kept]
    return Film(
        step=model.setup.name,
        time=times,
        node_count=np.array([chain.knots.size for chain in chains]),
        position=np.array([solution.y[i][nodes] for i in kept]),
        control_name=control_names(model),
        control_unit=control_units(model),
        error=np.array(
            [control_errors(controls, t, solution.y[i]) for t, i in zip(times.tolist(), kept, strict=True)]
        ),
    )
