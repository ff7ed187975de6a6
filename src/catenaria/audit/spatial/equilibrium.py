"""Forces at the joints of a line in space: supports, friction, ties, cantilevers, and the line as a whole."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.equilibrium import in_balance, outer_forces
from catenaria.audit.spatial.bodies import FreeSpatialWire
from catenaria.audit.spatial.droppers import end_weights, weight_margin
from catenaria.audit.spatial.stated import StatedLine
from catenaria.audit.verdict import Check
from catenaria.results.form import FormResult, Supports

FloatArray = NDArray[np.float64]

_GROUP = "equilibrium"


def relative_check(wires: tuple[FreeSpatialWire, ...]) -> Check:
    """Return the largest residual of a node of each wire, as a share of the largest tension of the line."""
    off = [
        float(np.max(np.linalg.norm(wire.residual[:, 0], axis=1))) / wire.largest_tension for wire in wires
    ]
    allowed = [wire.force_tolerance / wire.largest_tension for wire in wires]
    names = tuple(wire.stated.name for wire in wires)
    label = "residual of nodes over the largest tension"
    return Check(_GROUP, label, "N/N", np.array(off), np.array(allowed), names)


def support_checks(wire: FreeSpatialWire, supports: Supports) -> Iterator[Check]:
    """Yield the force of supports along the wire, which only friction makes, and along the track."""
    name, holds, rolls = wire.stated.name, wire.stated.holds, wire.stated.holds.rolls
    on_support, r1 = -wire.support_force, wire.curve.at(wire.support_s).r1
    along = np.einsum("ni,ni->n", on_support, r1) / np.linalg.norm(r1, axis=1)
    by_friction = holds.friction * np.linalg.norm(on_support, axis=1)
    on_track = np.abs(np.einsum("ni,ni->n", on_support, holds.across.along))
    places = np.array(wire.joint_name[: rolls.size], dtype=np.str_)
    for what, off, own in (
        ("force of supports along the wire", np.abs(along - by_friction), rolls),
        ("force of brackets and arms along the track", on_track, ~rolls),
    ):
        yield _forces(f"{name}, {what}", off[own], wire.force_tolerance, tuple(places[own].tolist()))
    sideways = np.einsum("ni,ni->n", on_support, holds.across.sideways)
    off = np.abs(supports.force_lateral[wire.support_row] - sideways)
    yield _forces(
        f"{name}, stated lateral force at supports", off, wire.force_tolerance, tuple(places.tolist())
    )


def tie_checks(result: FormResult, wires: tuple[FreeSpatialWire, ...]) -> Iterator[Check]:
    """Yield whether a tied wire's end pulls at its host as hard as the host pulls at it."""
    ties, forms = result.ties, {wire.stated.name: wire for wire in wires}
    tied = [forms[name] for name in ties.wire]
    off = [
        wire.form.end_force[end] - force
        for wire, end, force in zip(tied, ties.end.tolist(), ties.force, strict=True)
    ]
    size = np.linalg.norm(np.array(off).reshape(-1, 3), axis=1)
    places = tuple(
        f"{('start', 'end')[end]} of the {wire}" for wire, end in zip(ties.wire, ties.end, strict=True)
    )
    tolerance = max((wire.force_tolerance for wire in wires), default=0.0)
    yield _forces("ties, action and reaction", size, tolerance, places)


def line_check(result: FormResult, stated: StatedLine, wires: tuple[FreeSpatialWire, ...]) -> Check:
    """Return the balance of the whole line: reactions of supports and terminations against all weights."""
    points: list[FloatArray] = []
    forces: list[FloatArray] = []
    for wire in wires:
        arms, loads, _ = outer_forces(wire, wire.outer_force)
        points.append(arms + 0.5 * (wire.curve.r[0] + wire.curve.r[-1]))
        forces.append(loads)
    droppers = result.droppers
    for place, weight in zip(
        (droppers.position_bottom, droppers.position_top), end_weights(droppers, stated), strict=True
    ):
        points.append(place)
        forces.append(np.column_stack((np.zeros((weight.size, 2)), -weight)))
    r, force = np.concatenate(points), np.concatenate(forces)
    low, high = r.min(axis=0), r.max(axis=0)
    off = np.array([in_balance(r - 0.5 * (low + high), force, 0.5 * float(np.max(high - low)))])
    tolerance = max(wire.force_tolerance for wire in wires)
    tolerance += float(np.sum(weight_margin(droppers, stated)))
    return _forces("the line as a whole", off, tolerance, ("all reactions and weights",))


def _forces(name: str, off: FloatArray, tolerance: float, places: tuple[str, ...]) -> Check:
    return Check(_GROUP, name, "N", off, np.full(off.size, tolerance), places)
