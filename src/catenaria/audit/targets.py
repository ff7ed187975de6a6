"""What was asked for: heights, tensions, and droppers that pull."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.allowance import Allowance
from catenaria.audit.equilibrium import dropper_weight
from catenaria.audit.free_wire import FreeBody
from catenaria.audit.lengths import TOLERANCE, inner_tension
from catenaria.audit.stated import Stated
from catenaria.audit.verdict import Check
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

_GROUP = "targets"


def target_checks(
    result: FormResult, stated: Stated, wires: tuple[FreeBody, FreeBody], allowed: Allowance
) -> Iterator[Check]:
    """Yield errors of heights and tensions, what the tables say of them, and droppers that do not pull."""
    n = result.droppers.x.size
    names = tuple(f"dropper {i + 1}" for i in range(n))
    tension = np.array([measured_tension(wire) - wire.stated.tension for wire in wires])
    height = wires[0].position(wires[0].clamp_s)[:, 2] - stated.droppers.target_height
    titles = tuple(wire.stated.name for wire in wires)
    yield Check(_GROUP, "height at droppers", "m", np.abs(height), allowed.height, names)
    yield Check(_GROUP, "tension", "N", np.abs(tension), allowed.tension, titles)

    force = max(wire.force_tolerance for wire in wires)
    weakest = np.min(inner_tension(result.droppers, stated), axis=1)
    slack = np.maximum(force - weakest, 0.0)
    yield Check(_GROUP, "droppers, slack or in compression: tension", "N", slack, np.zeros(n), names)
    yield from _tables(result, stated, height, tension, force)
    for wire in wires:
        yield _ends(wire)


def measured_tension(wire: FreeBody) -> float:
    """Return the tension of a wire as its line file wants it measured [N].

    Notes
    -----
    The reaction of the device, or EA eps of eq. (11) at the end support.
    """
    end = -1 if wire.stated.at_end else 0
    if wire.stated.measure == "strain":
        return float(wire.strain_tension(wire.support_s[[end]])[0])
    return float(np.linalg.norm(wire.form.end_force[end]))


def _tables(
    result: FormResult, stated: Stated, height: FloatArray, tension: FloatArray, tolerance: float
) -> Iterator[Check]:
    """Yield whether targets and errors in the tables are those of the geometry and the forces."""
    droppers = result.droppers
    names = tuple(f"dropper {i + 1}" for i in range(droppers.x.size))
    stated_height = np.abs(droppers.height_error - height)
    wanted = np.abs(droppers.target_height - stated.droppers.target_height)
    off = np.maximum(stated_height, wanted)
    yield Check(_GROUP, "stated height errors", "m", off, np.full(off.size, TOLERANCE), names)
    pull = -droppers.on_messenger[:, 2] - droppers.on_contact[:, 2]
    balance = pull - dropper_weight(droppers, stated.droppers, stated.gravity)
    off = np.abs(droppers.force_error - balance)
    yield Check(_GROUP, "stated force errors", "N", off, np.full(off.size, tolerance), names)
    controls = result.controls
    own = {f"{wire.name} tension": error for wire, error in zip(stated.wires, tension, strict=True)}
    for i, name in enumerate(names):
        own |= {f"height at {name}": height[i], f"force of {name}": balance[i]}
    found = np.array([own.get(name, controls.error[i]) for i, name in enumerate(controls.name)])
    off = np.maximum(np.abs(controls.value - controls.target - found), np.abs(controls.error - found))
    for unit, allowed in (("m", TOLERANCE), ("N", tolerance)):
        these = [i for i, other in enumerate(controls.unit) if other == unit]
        places = tuple(controls.name[i] for i in these)
        yield Check(_GROUP, "stated control errors", unit, off[these], np.full(len(these), allowed), places)


def _ends(wire: FreeBody) -> Check:
    """Return whether what a wire's table says of its tension is what acts at its ends."""
    form = wire.form
    reaction, along = np.linalg.norm(form.end_force, axis=1), np.abs(form.end_force[:, 0])
    pairs = {
        "reaction at the start": (form.reaction_start, reaction[0]),
        "reaction at the end": (form.reaction_end, reaction[1]),
        "horizontal component at the start": (form.horizontal_start, along[0]),
        "horizontal component at the end": (form.horizontal_end, along[1]),
        "target tension": (form.target_tension, wire.stated.tension),
        "tension": (form.tension, measured_tension(wire)),
        "tension error": (form.tension_error, measured_tension(wire) - wire.stated.tension),
    }
    off = np.array([abs(said - found) for said, found in pairs.values()])
    allowed = np.full(off.size, wire.force_tolerance)
    return Check(_GROUP, f"{form.name}, stated forces", "N", off, allowed, tuple(pairs))
