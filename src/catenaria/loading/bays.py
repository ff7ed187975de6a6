"""Contact wires from support to support: lowest points, lateral positions, and those of the textbook."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.blow_off import BlownSpan
from catenaria.discretise.spatial.layout import across
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.line.alignment import Alignment
from catenaria.loading.wind import WindOn
from catenaria.results.case import BlowOff, LineState, LoadedWire, SpanExtremes

FloatArray = NDArray[np.float64]

_CONTACT = "contact wire"


@dataclass(frozen=True)
class Bay:
    """A contact wire between two supports that hold it: `span` is the first of its spans, from 1."""

    wire: str
    span: int
    start: float
    end: float
    stagger_start: float
    stagger_end: float


def bays(model: SpatialModel, state: LineState) -> Iterator[Bay]:
    """Yield the bays of all contact wires."""
    holds = model.layout.holds
    for k, wire in enumerate(model.layout.wires):
        if wire.role != _CONTACT:
            continue
        for i, j in pairwise(np.flatnonzero(holds.wire == k).tolist()):
            chainage, stagger = holds.frame.chainage, state.supports.stagger
            ends = float(chainage[i]), float(chainage[j]), float(stagger[i]), float(stagger[j])
            yield Bay(wire.name, int(holds.support[i]) + 1, *ends)


def span_extremes(every: Sequence[Bay], state: LineState) -> SpanExtremes:
    """Return where contact wires are lowest and deviate most in each bay."""
    lowest: list[tuple[float, float]] = []
    furthest: list[tuple[float, float]] = []
    for bay in every:
        wire = state.wire(bay.wire)
        i = _within(wire, bay)
        low, far = i[np.argmin(wire.height[i])], i[np.argmax(np.abs(wire.lateral[i]))]
        lowest.append((float(wire.chainage[low]), float(wire.height[low])))
        furthest.append((float(wire.chainage[far]), float(wire.lateral[far])))
    at_low, at_far = (
        np.array(pairs, dtype=np.float64).reshape(-1, 2).T.copy() for pairs in (lowest, furthest)
    )
    names, spans = tuple(bay.wire for bay in every), np.array([bay.span for bay in every], dtype=np.int64)
    return SpanExtremes(names, spans, at_low[0], at_low[1], at_far[0], at_far[1])


def blow_off(
    model: SpatialModel, alignment: Alignment, every: Sequence[Bay], state: LineState, wind: WindOn | None
) -> BlowOff:
    """Return the textbook's lateral positions beside the solved ones; nothing without wind.

    Parameters
    ----------
    model : SpatialModel
        The line.
    alignment : Alignment
        Course of the track.
    every : sequence of Bay
        Bays with the staggers before the load.
    state : LineState
        The loaded line.
    wind : WindOn, optional
        The wind.
    """
    rows = [] if wind is None else [_row(model, alignment, bay, state, wind) for bay in every]
    bay_of = every if rows else ()
    table = np.array(rows, dtype=np.float64).reshape(-1, 8).T.copy()
    return BlowOff(
        wire=tuple(bay.wire for bay in bay_of),
        span=np.array([bay.span for bay in bay_of], dtype=np.int64),
        start=np.array([bay.start for bay in bay_of], dtype=np.float64),
        length=np.array([bay.end - bay.start for bay in bay_of], dtype=np.float64),
        stagger_start=np.array([bay.stagger_start for bay in bay_of], dtype=np.float64),
        stagger_end=np.array([bay.stagger_end for bay in bay_of], dtype=np.float64),
        load=table[0],
        tension=table[1],
        combined_load=table[2],
        combined_tension=table[3],
        curvature=table[4],
        alone=table[5],
        combined=table[6],
        solved=table[7],
    )


def _row(
    model: SpatialModel, alignment: Alignment, bay: Bay, state: LineState, wind: WindOn
) -> tuple[float, ...]:
    """Return load, tension, both combined, curvature, and deviations by textbook and as solved."""
    length = bay.end - bay.start
    heading = alignment.plan.at(np.array([bay.start, bay.end]))[0]
    curvature = float(heading[1] - heading[0]) / length
    own = state.wire(bay.wire)
    load, tension = _wire_load(model, bay, wind, own), _tension(own, bay)
    long = [state.wire(wire.name) for wire in model.layout.wires if not wire.tied]
    all_load = sum(_wire_load(model, bay, wind, wire) for wire in long) + _dropper_load(model, bay, wind)
    all_tension = sum(_tension(wire, bay) for wire in long)
    blown = [
        BlownSpan(length, bay.stagger_start, bay.stagger_end, q, H, curvature).furthest[1]
        for q, H in ((load, tension), (all_load, all_tension))
    ]
    side = float(np.copysign(1.0, blown[0]))
    solved = side * float(np.max(side * own.lateral[_within(own, bay)]))
    return load, tension, all_load, all_tension, curvature, *blown, solved


def _within(wire: LoadedWire, bay: Bay) -> NDArray[np.int64]:
    return np.flatnonzero((wire.chainage >= bay.start) & (wire.chainage <= bay.end))


def _tension(wire: LoadedWire, bay: Bay) -> float:
    return float(wire.tension[_within(wire, bay)].mean())


def _wire_load(model: SpatialModel, bay: Bay, wind: WindOn, wire: LoadedWire) -> float:
    """Return the mean wind on a wire to the left within a bay [N/m]."""
    k = [laid.name for laid in model.layout.wires].index(wire.name)
    frames, force = wind.frames[k], wind.per_metre[k]
    inside = (frames.chainage >= bay.start) & (frames.chainage <= bay.end)
    left = np.einsum("ni,ni->n", across(frames), force)[inside]
    L = model.wires[k].L[inside]
    return float(left @ L / L.sum())


def _dropper_load(model: SpatialModel, bay: Bay, wind: WindOn) -> float:
    """Return the wind on droppers to the left within a bay, by its length [N/m]."""
    frame = model.layout.droppers.frame
    inside = (frame.chainage >= bay.start) & (frame.chainage <= bay.end)
    left = np.einsum("ni,ni->n", across(frame), wind.droppers)[inside]
    return float(left.sum()) / (bay.end - bay.start)
