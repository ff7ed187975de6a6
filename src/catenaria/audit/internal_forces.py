"""Internal forces along wires: what a profile says of tension and moment, from the slopes once more."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.curve import Points
from catenaria.audit.free_wire import Along, FreeWire
from catenaria.audit.verdict import Check
from catenaria.results.form import Supports

FloatArray = NDArray[np.float64]

_GROUP = "equilibrium"


def profile_checks(wire: FreeWire) -> Iterator[Check]:
    """Yield the checks of stated tensions, strain tensions, horizontal components and moments."""
    shape, kind = wire.form.profile, wire.stated.conductor
    at = wire.curve.at(shape.s)
    size = np.linalg.norm(at.r1, axis=1)
    middle = 0.5 * (wire.curve.s[:-1] + wire.curve.s[1:])
    tension = np.interp(shape.s, middle, wire.mean_tension)
    after, before = (kind.EJ * _curvature(at) for at in (at, wire.curve.at(shape.s, side="left")))
    moment = np.clip(shape.moment, np.minimum(before, after), np.maximum(before, after))
    allowed = np.full(shape.s.shape, wire.force_tolerance)
    places = Along(tuple((wire, s) for s in shape.s.tolist()))
    for name, unit, said, found in (
        ("profile, tension", "N", shape.tension, tension),
        ("profile, strain tension (11)", "N", shape.strain_tension, wire.strain_tension(shape.s)),
        ("profile, horizontal component", "N", shape.horizontal, tension * at.r1[:, 0] / size),
        ("profile, bending moment", "N m", shape.moment, moment),
    ):
        yield Check(_GROUP, name, unit, np.abs(said - found), allowed, places)


def support_check(wire: FreeWire, supports: Supports) -> Check:
    """Return whether the stated N = EA eps of eq. (11) at supports is that of the slopes."""
    held = [i for i, name in enumerate(supports.wire) if name == wire.stated.name]
    off = np.abs(supports.tension[held] - wire.strain_tension(wire.support_s))
    label = f"{wire.stated.name}, strain tension (11) at supports"
    allowed = np.full(off.size, wire.force_tolerance)
    return Check(_GROUP, label, "N", off, allowed, wire.joint_name[: off.size])


def _curvature(at: Points) -> FloatArray:
    """Return kappa of eq. (10) [1/m]; it jumps at nodes, where anything between both sides will do."""
    return np.linalg.norm(np.cross(at.r1, at.r2), axis=1) / np.linalg.norm(at.r1, axis=1) ** 3
