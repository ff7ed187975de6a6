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


def profile_checks(wire: FreeWire, at: Points, along: FloatArray) -> Iterator[Check]:
    """Yield the checks of stated tensions, strain tensions, horizontal components and moments.

    Parameters
    ----------
    wire : FreeWire
        The wire.
    at : Points
        Its curve in the n points of its profile.
    along : FloatArray, shape (3,) or (n, 3)
        Direction of the track there.
    """
    shape, kind = wire.form.profile, wire.stated.conductor
    s, size = shape.s, np.sqrt(np.einsum("ni,ni->n", at.r1, at.r1))
    middle = 0.5 * (wire.curve.s[:-1] + wire.curve.s[1:])
    tension = np.interp(s, middle, wire.mean_tension)
    after = kind.EJ * _curvature(at)
    before, nodes = after.copy(), np.flatnonzero(np.isin(s, wire.curve.s))
    before[nodes] = kind.EJ * _curvature(wire.curve.at(s[nodes], side="left"))
    moment = np.clip(shape.moment, np.minimum(before, after), np.maximum(before, after))
    allowed = np.full(s.shape, wire.force_tolerance)
    places = Along((wire,), (s,))
    for name, unit, said, found in (
        ("profile, tension", "N", shape.tension, tension),
        ("profile, strain tension (11)", "N", shape.strain_tension, wire.strain_tension(s)),
        (
            "profile, horizontal component",
            "N",
            shape.horizontal,
            tension * np.einsum("ni,ni->n", at.r1, np.broadcast_to(along, at.r1.shape)) / size,
        ),
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
    (x, y, z), (u, v, w) = at.r1.T, at.r2.T
    cross = (y * w - z * v) ** 2 + (z * u - x * w) ** 2 + (x * v - y * u) ** 2
    return np.sqrt(cross / (x * x + y * y + z * z) ** 3)
