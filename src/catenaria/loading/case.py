"""A built line under one load case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.found import found_model
from catenaria.discretise.spatial.loaded import (
    clamp_load,
    line_load,
    material_at,
    point_load,
    warmed,
    with_moved_supports,
    without_droppers,
)
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.line.load_case import LoadCase, Push
from catenaria.loading.bays import bays, blow_off, span_extremes
from catenaria.loading.built_line import BuiltLine, LoadedLine, wire_conductor
from catenaria.loading.ice import ice_on, ring_weight, thicker
from catenaria.loading.read_case import line_state
from catenaria.loading.rest import at_rest, rest_when_warmed
from catenaria.loading.wind import WindOn, wind_on
from catenaria.results.case import CaseResult, LineState, Pushed

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

_UP = np.array([0.0, 0.0, 1.0])
_BESIDE: Final = np.array([0.0, -0.1, 0.1, -0.3, 0.3, -1.0, 1.0])  # m: nodes where a wire is pushed
NOT_PUSHED: Final = Pushed((), np.empty(0), np.empty(0), np.empty(0))


@dataclass(frozen=True)
class Loads:
    """Wind and ice on a line.

    Attributes
    ----------
    wires : tuple of FloatArray, shape (n_elements, 3)
        On each element, per metre of unstressed length [N/m].
    droppers : FloatArray, shape (n_droppers, 3)
        On each dropper [N].
    wind : WindOn or None
        What of that is wind.
    """

    wires: tuple[FloatArray, ...]
    droppers: FloatArray
    wind: WindOn | None

    def on(self, model: SpatialModel) -> FloatArray:
        """Return the generalised forces; half of what acts on a dropper is at either clamp."""
        return line_load(model, self.wires) + clamp_load(model, 0.5 * self.droppers, 0.5 * self.droppers)


def solve_case(built: BuiltLine, name: str, case: LoadCase, before: LineState) -> CaseResult:
    """Return a line under a load case.

    Parameters
    ----------
    built : BuiltLine
        The line.
    name, case
        The case, in which droppers, supports and wires are known; see `check_cases`.
    before : LineState
        The line as it was built.

    Raises
    ------
    NotConvergedError, InfeasibleError
        If no rest is found.
    """
    broken = _broken(built.model, case)
    try:
        loaded, loads = _unpushed(built, case, broken)
        pushed = NOT_PUSHED
        if case.push:
            finer = _finer(built, loaded, case)
            unpushed, loads = _unpushed(finer, case, broken)
            loaded, pushed = _pushed(finer, unpushed, loads.on(unpushed.model), case.push)
    except NotConvergedError as error:
        advice = "less load, or what acts in the case one by one"
        raise NotConvergedError(f"Load case {name}: {error.reason}", advice, error.partial) from error
    except InfeasibleError as error:
        raise InfeasibleError(f"Load case {name}: {error}", error.partial) from error
    model = loaded.model
    state, every = line_state(built.line, loaded, broken), tuple(bays(built.model, before))
    return CaseResult(
        name=name,
        stated=case.model_dump(mode="json"),
        warming=case.warming(built.line.reference_temperature),
        load=np.array([chain.L @ force for chain, force in zip(model.wires, loads.wires, strict=True)]),
        dropper_load=loads.droppers.sum(axis=0),
        state=state,
        extremes=span_extremes(every, state),
        blow_off=blow_off(model, built.line.alignment, every, state, loads.wind),
        pushed=pushed,
        iterations=loaded.iterations,
    )


def changed_model(built: BuiltLine, case: LoadCase, broken: Mask) -> SpatialModel:
    """Return what temperature, missing droppers and moved supports make of a line."""
    model, warming = built.model, case.warming(built.line.reference_temperature)
    if warming != 0.0:
        model = warmed(model, warming, built.expansion.tolist(), built.dropper_expansion)
    if broken.any():
        model = without_droppers(model, broken)
    if case.moved_supports:
        model = with_moved_supports(model, _shift(built, case))
    return model


def loads_on(built: BuiltLine, model: SpatialModel, case: LoadCase) -> Loads:
    """Return wind and ice on a line."""
    line, layout = built.line, model.layout
    roles = tuple(wire.role for wire in layout.wires)
    diameter = np.array([line.conductor(wire_conductor(line, role)).outer_diameter for role in roles])
    dropper = line.conductor(line.dropper.conductor).outer_diameter
    wires, droppers = [np.zeros((chain.L.size, 3)) for chain in model.wires], np.zeros((model.length.size, 3))
    wind = None
    if case.ice is not None:
        weight = ice_on(case.ice, roles, diameter, layout.g)
        wires = [on - per_metre * _UP for on, per_metre in zip(wires, weight, strict=True)]
        if case.ice.thickness is not None:
            ring = ring_weight(case.ice.thickness, case.ice.density, np.array([dropper]), layout.g)
            length = model.unknowns.start[model.length] * (layout.droppers.rhoA > 0.0)
            droppers = droppers - (ring * length)[:, None] * _UP
    if case.wind is not None:
        ring = thicker(case.ice)
        wind = wind_on(model, line.alignment, case.wind, diameter + ring, dropper + ring)
        wires = [on + blown for on, blown in zip(wires, wind.per_metre, strict=True)]
        droppers = droppers + wind.droppers
    return Loads(tuple(wires), droppers, wind)


def _unpushed(built: BuiltLine, case: LoadCase, broken: Mask) -> tuple[LoadedLine, Loads]:
    """Return the line under everything but pushes."""
    model, warming = changed_model(built, case, broken), case.warming(built.line.reference_temperature)
    loads = loads_on(built, model, case)
    z = None
    if warming != 0.0:
        z = rest_when_warmed(built, warming)
        z[model.length] = model.unknowns.start[model.length]
        z[model.density[broken]] = 0.0
    return at_rest(built, model, loads.on(model), z), loads


def _pushed(
    built: BuiltLine, unpushed: LoadedLine, load: FloatArray, pushes: Sequence[Push]
) -> tuple[LoadedLine, Pushed]:
    """Return the line with all pushes together, which begin where it rests without them."""
    model, chainage = unpushed.model, np.array([push.chainage for push in pushes])
    here = replace(model, unknowns=replace(model.unknowns, start=unpushed.z))
    up, force = built.line.alignment.frames(chainage).up, np.array([push.force for push in pushes])
    wires, s = _points(built, unpushed, pushes)
    for k, at, push in zip(wires, s, force[:, None] * up, strict=True):
        load = load + point_load(here, k, at, push[None, :])[0]
    loaded = at_rest(built, model, load, unpushed.z)
    moved = [loaded.points(k, at)[0] - unpushed.points(k, at)[0] for k, at in zip(wires, s, strict=True)]
    uplift = np.einsum("ni,ni->n", up, np.array(moved))
    return loaded, Pushed(tuple(push.wire for push in pushes), chainage, force, uplift)


def _points(
    built: BuiltLine, loaded: LoadedLine, pushes: Sequence[Push]
) -> tuple[list[int], list[FloatArray]]:
    """Return wires and material coordinates of pushed points, shape (1,) each."""
    model = replace(loaded.model, unknowns=replace(loaded.model.unknowns, start=loaded.z))
    names = [wire.name for wire in model.layout.wires]
    wires = [names.index(push.wire) for push in pushes]
    places = [np.array([push.chainage]) for push in pushes]
    alignment = built.line.alignment
    return wires, [material_at(model, k, alignment, c) for k, c in zip(wires, places, strict=True)]


def _finer(built: BuiltLine, loaded: LoadedLine, case: LoadCase) -> BuiltLine:
    """Return the line with nodes at and beside the points that are pushed.

    Notes
    -----
    Within an element a wire cannot bend as sharply as under a point load: the uplift in the middle of one of
    length h would be too small by up to F h/(16 T).
    """
    warming, nodes = case.warming(built.line.reference_temperature), dict[int, FloatArray]()
    for k, s in zip(*_points(built, loaded, case.push), strict=True):
        natural = s / (1.0 + warming * built.expansion[k])
        nodes[k] = np.concatenate((nodes.get(k, np.empty(0)), natural + _BESIDE))
    return built.with_model(found_model(built.line, built.result, nodes))


def _broken(model: SpatialModel, case: LoadCase) -> Mask:
    droppers = model.layout.droppers
    lower = np.array([model.layout.wires[int(k)].name for k in droppers.lower], dtype=np.str_)
    mask = np.zeros(droppers.span.size, dtype=np.bool_)
    for broken in case.broken_droppers:
        there = (droppers.span == broken.span) & (droppers.number == broken.number)
        mask |= there if broken.wire is None else there & (lower == broken.wire)
    return mask


def _shift(built: BuiltLine, case: LoadCase) -> FloatArray:
    """Return by how much all places move at which supports hold wires [m], shape (n_holds, 3)."""
    holds, line = built.model.layout.holds, built.line
    shift = np.zeros((holds.wire.size, 3))
    names = np.array([line.supports[int(i)].name for i in holds.support], dtype=np.str_)
    wires = np.array([built.model.layout.wires[int(k)].name for k in holds.wire], dtype=np.str_)
    for moved in case.moved_supports:
        mask = (names == moved.support) & (True if moved.wire is None else wires == moved.wire)
        frame = holds.frame
        by = moved.along * frame.along + moved.lateral * frame.left + moved.vertical * frame.up
        shift += mask[:, None] * by
    return shift
