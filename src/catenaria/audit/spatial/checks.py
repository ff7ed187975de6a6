"""All checks of a line in space."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from catenaria.audit import equilibrium, internal_forces
from catenaria.audit.spatial import arms, droppers, places, targets
from catenaria.audit.spatial import equilibrium as joints
from catenaria.audit.spatial.bodies import FreeSpatialWire, curves_of, free_spatial_wires
from catenaria.audit.spatial.stated import StatedLine, read_line
from catenaria.audit.track import Across
from catenaria.audit.verdict import Check
from catenaria.errors import InconsistentInputError
from catenaria.results.form import FormResult


def checks_in_space(result: FormResult) -> Iterator[Check]:
    """Yield the checks of a result whose wires were found all at once.

    Raises
    ------
    InconsistentInputError
        If the result is not one of the wires, supports, droppers, ties, masses and arms of its line.
    """
    if len(result.stages) != 1 or result.physics != "bending":
        raise InconsistentInputError("a line in space has one stage, and wires that bend")
    stated = read_line(result.inputs)
    wires = free_spatial_wires(result, stated)
    tolerance = max(wire.force_tolerance for wire in wires)
    profiles = _profile_planes(wires, stated)
    yield equilibrium.node_check(wires)
    yield joints.relative_check(wires)
    for wire in wires:
        yield from equilibrium.balance_checks(wire)
        yield from joints.support_checks(wire, result.supports)
        yield internal_forces.support_check(wire, result.supports)
        yield from places.support_checks(wire, result.supports)
        yield places.length_check(wire)
        if not wire.stated.tied:
            yield places.end_check(wire)
        at = wire.curve.at(wire.form.profile.s)
        across = profiles[wire.stated.name]
        yield from places.profile_checks(wire, at, across)
        yield from internal_forces.profile_checks(wire, at, across.along)
    yield from droppers.balance_checks(result.droppers, stated, tolerance)
    yield joints.line_check(result, stated, wires)
    yield from droppers.place_checks(result.droppers, stated, wires)
    yield from droppers.length_checks(result.droppers, stated)
    yield from places.clamp_checks(result, stated, wires)
    yield from joints.tie_checks(result, wires)
    yield from arms.arm_checks(result, stated, wires)
    yield from arms.cantilever_checks(result, stated, wires, curves_of(result.stages[0]))
    yield from targets.target_checks(result, stated, wires)


def _profile_planes(wires: tuple[FreeSpatialWire, ...], stated: StatedLine) -> dict[str, Across]:
    """Return the planes across the track in the points of all profiles, by wires; made in one call."""
    shapes = [wire.form.profile.chainage for wire in wires]
    planes = stated.track.across(np.concatenate(shapes))
    owner = np.repeat(np.arange(len(wires)), [shape.size for shape in shapes])
    return {wire.stated.name: planes.take(np.flatnonzero(owner == i)) for i, wire in enumerate(wires)}
