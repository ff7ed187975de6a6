"""What was asked for of a line in space: heights, tensions, lifts, and droppers that pull."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.allowance import stop_criteria
from catenaria.audit.lengths import TOLERANCE
from catenaria.audit.spatial.bodies import FreeSpatialWire, positions
from catenaria.audit.spatial.droppers import bar_tension, dropper_names
from catenaria.audit.spatial.stated import StatedLine
from catenaria.audit.targets import measured_tension
from catenaria.audit.verdict import Check
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

_GROUP = "targets"


def target_checks(
    result: FormResult, stated: StatedLine, wires: tuple[FreeSpatialWire, ...]
) -> Iterator[Check]:
    """Yield errors of heights, tensions and lifts, what tables say of them, and droppers that do not pull."""
    droppers, kind = result.droppers, stated.droppers
    names, titles = dropper_names(droppers), tuple(wire.stated.name for wire in wires)
    force = max(wire.force_tolerance for wire in wires)
    foot = positions(wires, droppers.lower_wire, droppers.contact_coordinate)
    height = kind.across.height(foot) - kind.height
    pull = np.min(bar_tension(droppers, stated), axis=1)
    limp = np.abs(pull) <= force if kind.may_be_slack else np.zeros(pull.size, dtype=np.bool_)
    missed = np.where(limp, np.maximum(-height, 0.0), np.abs(height))
    tension = np.array([measured_tension(wire) - wire.stated.tension for wire in wires])
    allowed = _allowed(result, titles, names, wires)
    yield Check(_GROUP, "height at droppers", "m", missed, allowed[1], names)
    yield Check(_GROUP, "tension", "N", np.abs(tension), allowed[0], titles)
    for wire in wires:
        yield _lifts(wire)
    half_weight = 0.5 * stated.gravity * kind.conductor.rhoA * droppers.unstressed_length
    least = 0.0 if kind.may_be_slack else half_weight + 2.0 * force
    slack = np.maximum(least - pull - force, 0.0)
    yield Check(_GROUP, "droppers, slack or in compression: tension", "N", slack, np.zeros(len(names)), names)
    off = np.maximum(np.abs(droppers.height_error - height), np.abs(droppers.target_height - kind.height))
    yield Check(_GROUP, "stated height errors", "m", off, np.full(off.size, TOLERANCE), names)
    own = dict(zip((f"{title} tension" for title in titles), tension.tolist(), strict=True))
    own |= dict(zip((f"height at {name}" for name in names), height.tolist(), strict=True))
    yield from _controls(result, own, force)
    ends = stated.track.across(np.concatenate([wire.form.profile.chainage[[0, -1]] for wire in wires]))
    for wire, along in zip(wires, ends.along.reshape(-1, 2, 3), strict=True):
        yield _stated_forces(wire, along)


def _allowed(
    result: FormResult,
    titles: tuple[str, ...],
    names: tuple[str, ...],
    wires: tuple[FreeSpatialWire, ...],
) -> tuple[FloatArray, FloatArray]:
    """Return the errors of tensions [N] and heights [m] that pass.

    Notes
    -----
    As of plane lines, see `allowance`: a distance d that controls may still travel is worth d of height and
    2 EA d/L of tension.
    """
    factor, travel = stop_criteria(result)
    bands = dict(zip(result.controls.name, result.controls.dead_band.tolist(), strict=True))

    def allowed(controls: list[str], slope: FloatArray, floor: FloatArray) -> FloatArray:
        band = np.array([bands.get(name, 0.0) for name in controls])
        left = np.where(band > 0.0, np.maximum(factor * band, band + slope * travel), 0.0)
        return np.maximum(left, floor)

    slope = np.array([2.0 * wire.stated.conductor.EA / float(np.ptp(wire.end_s)) for wire in wires])
    floor = np.array([wire.force_tolerance for wire in wires])
    n = len(names)
    return (
        allowed([f"{title} tension" for title in titles], slope, floor),
        allowed([f"height at {name}" for name in names], np.ones(n), np.full(n, TOLERANCE)),
    )


def _lifts(wire: FreeSpatialWire) -> Check:
    """Return whether arms with a prescribed vertical force exert it."""
    lift = wire.stated.holds.lift
    prescribed = np.isfinite(lift)
    off = np.abs(wire.support_force[:, 2] - lift)[prescribed]
    places = tuple(name for name, own in zip(wire.joint_name, prescribed, strict=False) if own)
    label = f"{wire.stated.name}, prescribed lift"
    return Check(_GROUP, label, "N", off, np.full(off.size, wire.force_tolerance), places)


def _controls(result: FormResult, own: dict[str, float], tolerance: float) -> Iterator[Check]:
    """Yield whether the errors that controls state are those of the geometry and the forces."""
    controls = result.controls
    found = np.array([own.get(name, np.nan) for name in controls.name])
    off = np.maximum(np.abs(controls.value - controls.target - found), np.abs(controls.error - found))
    for unit, allowed in (("m", TOLERANCE), ("N", tolerance)):
        these = [i for i, other in enumerate(controls.unit) if other == unit]
        places = tuple(controls.name[i] for i in these)
        yield Check(_GROUP, "stated control errors", unit, off[these], np.full(len(these), allowed), places)


def _stated_forces(wire: FreeSpatialWire, track: FloatArray) -> Check:
    """Return whether what a wire's table says of its tension is what acts at its ends.

    Parameters
    ----------
    wire : FreeSpatialWire
        The wire.
    track : FloatArray, shape (2, 3)
        Directions of the track at its ends.
    """
    form, tension = wire.form, measured_tension(wire)
    reaction = np.linalg.norm(form.end_force, axis=1)
    along = np.abs(np.einsum("ni,ni->n", track, form.end_force))
    pairs = {
        "reaction at the start": (form.reaction_start, reaction[0]),
        "reaction at the end": (form.reaction_end, reaction[1]),
        "horizontal component at the start": (form.horizontal_start, along[0]),
        "horizontal component at the end": (form.horizontal_end, along[1]),
        "target tension": (form.target_tension, wire.stated.tension),
        "tension": (form.tension, tension),
        "tension error": (form.tension_error, tension - wire.stated.tension),
    }
    off = np.array([abs(said - found) for said, found in pairs.values()])
    allowed = np.full(off.size, wire.force_tolerance)
    return Check(_GROUP, f"{form.name}, stated forces", "N", off, allowed, tuple(pairs))
