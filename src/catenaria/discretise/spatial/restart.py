"""From the stage of an earlier result back to unknowns."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.discretise.spatial.numbering import NONE
from catenaria.errors import InconsistentInputError
from catenaria.mechanics.unknowns import Kind
from catenaria.results.form import LINE_STEP, FormResult

FloatArray = NDArray[np.float64]


def start_from(model: SpatialModel, result: FormResult) -> SpatialModel:
    """Return the model with its unknowns where an earlier result ended.

    Raises
    ------
    InconsistentInputError
        If the earlier result is of another line or another mesh.
    """
    stages = [stage for stage in result.stages if stage.step == LINE_STEP]
    chains = (*model.wires, *model.cantilevers)
    counts = np.array([chain.knots.size for chain in chains])
    if not stages or not np.array_equal(stages[0].node_count, counts):
        raise InconsistentInputError(
            "the earlier result does not fit the line: it must have the same wires, supports, droppers and "
            "mesh"
        )
    stage, z = stages[0], model.unknowns.start.copy()
    for kind, values in (
        (Kind.SLIDING, stage.sliding_coordinate),
        (Kind.PARAMETER, stage.parameter),
        (Kind.MULTIPLIER, stage.multiplier),
    ):
        own = model.unknowns.where(kind)
        if values.size != np.count_nonzero(own):
            raise InconsistentInputError(
                "the earlier result does not fit the line: it has other supports or clamps"
            )
        z[own] = values
    nodes = np.concatenate([chain.nodes for chain in chains])
    z[nodes] = np.hstack((stage.position, stage.slope))
    return replace(model, unknowns=replace(model.unknowns, start=_by_mesh(model, z)))


def _by_mesh(model: SpatialModel, natural: FloatArray) -> FloatArray:
    """Return unknowns with coordinates of pieces by their mesh: the inverse of `Natural.z`."""
    z, stretch = natural.copy(), Natural(model, natural).stretch
    for wire, piece, factor in zip(model.wires, model.piece, stretch, strict=True):
        if piece != NONE:
            z[wire.nodes[:, 3:]] *= factor
    for at, on, _ in Natural(model, natural).attached():
        z[at] /= stretch[on]
    return z
