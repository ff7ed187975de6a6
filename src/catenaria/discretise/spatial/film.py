"""A film of a line in space: its wires and droppers in the track frame, in some states of a motion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.line.alignment import Alignment, Frames
from catenaria.results.film import Polylines

FloatArray = NDArray[np.float64]


def film_wires(model: SpatialModel, alignment: Alignment, states: Sequence[FloatArray]) -> Polylines:
    """Return the nodes of all wires, with the chainages at which planes across the track hold them."""
    placed = [_on_track(Natural(model, z), alignment) for z in states]
    return Polylines(
        node_count=np.array([wire.knots.size for wire in model.wires], dtype=np.int64),
        chainage=np.array([frames.chainage for _, frames in placed]),
        lateral=np.array([frames.lateral(r) for r, frames in placed]),
        height=np.array([frames.height(r) for r, frames in placed]),
    )


def _on_track(state: Natural, alignment: Alignment) -> tuple[FloatArray, Frames]:
    """Return the nodes of all wires, shape (n, 3), and the track frames in which they are."""
    r = np.concatenate([state.z[wire.nodes[:, :3]] for wire in state.wires])
    near = [np.interp(wire.knots, *state.stations(k)) for k, wire in enumerate(state.wires)]
    return r, alignment.frames(alignment.locate(r, np.concatenate(near)))


def film_droppers(model: SpatialModel, states: Sequence[FloatArray]) -> Polylines:
    """Return both clamps of all droppers, the lower one first; guides hold them across the track."""
    frame, lower, upper = model.layout.droppers.frame, model.lower_carrier, model.upper_carrier
    ends = [(lower.evaluate(z, z[model.lower_s]).r, upper.evaluate(z, z[model.upper_s]).r) for z in states]
    return Polylines(
        node_count=np.full(frame.chainage.size, 2),
        chainage=np.tile(np.repeat(frame.chainage, 2), (len(states), 1)),
        lateral=np.array([_in_turn(frame.lateral(bottom), frame.lateral(top)) for bottom, top in ends]),
        height=np.array([_in_turn(frame.height(bottom), frame.height(top)) for bottom, top in ends]),
    )


def _in_turn(first: FloatArray, second: FloatArray) -> FloatArray:
    return np.column_stack((first, second)).ravel()
