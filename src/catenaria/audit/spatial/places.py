"""Where wires are held, end and are tied, and how long they are, in the frame of the track."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.curve import Points
from catenaria.audit.free_wire import Along
from catenaria.audit.lengths import TOLERANCE
from catenaria.audit.spatial.bodies import FreeSpatialWire, positions
from catenaria.audit.spatial.stated import StatedLine
from catenaria.audit.track import Across
from catenaria.audit.verdict import Check, Names
from catenaria.results.form import FormResult, Supports

FloatArray = NDArray[np.float64]


def support_checks(wire: FreeSpatialWire, supports: Supports) -> Iterator[Check]:
    """Yield whether a wire is where its supports hold it under their forces, and where the table says."""
    name, holds, rows = wire.stated.name, wire.stated.holds, wire.support_row
    r, across = wire.curve.at(wire.support_s).r, holds.across
    places = wire.joint_name[: rows.size]
    yield _metres(f"{name}, place at supports", _displaced(wire, r), places)
    table = np.column_stack((supports.x, supports.y, supports.z))[rows]
    yield _metres(f"{name}, stated place at supports", np.max(np.abs(table - r), axis=1), places)
    off = np.abs(
        (
            supports.chainage[rows] - holds.chainage,
            supports.stagger[rows] - across.lateral(r),
            supports.height[rows] - across.height(r),
        )
    )
    yield _metres(f"{name}, stated chainage, stagger and height at supports", np.max(off, axis=0), places)


def _displaced(wire: FreeSpatialWire, r: FloatArray) -> FloatArray:
    """Return how far a wire at r is from where its supports hold it [m].

    Notes
    -----
    Springs give way by F/k, sideways and vertically. An arm with a prescribed lift holds the wire sideways
    only, one with a given hinge by its length only; both keep it in the plane across the track. What carries
    a cantilever's tip is its own body: the tip has to be where the wire is, which is checked with it.
    """
    holds, across = wire.stated.holds, wire.stated.holds.across
    off = r - holds.place
    side = across.sideways
    gives = np.einsum("ni,ni->n", side, wire.support_force)[:, None] * holds.compliance[:, :1] * side
    gives[:, 2] += wire.support_force[:, 2] * holds.compliance[:, 1]
    size = np.linalg.norm(off + gives, axis=1)
    in_plane, beside = np.abs(across.off(r)), np.abs(np.einsum("ni,ni->n", side, off))
    hinged = np.array([arm is not None and arm.hinged for arm in holds.arm], dtype=np.bool_)
    flexible = np.array([kind == "cantilever" for kind in holds.kind], dtype=np.bool_)
    size = np.where(np.isfinite(holds.lift), np.maximum(in_plane, beside), size)
    return np.where(flexible, 0.0, np.where(hinged, in_plane, size))


def end_check(wire: FreeSpatialWire) -> Check:
    """Return whether a wire's ends are at their terminations, or where devices have pulled them to."""
    pull = wire.form.travel * np.array(wire.stated.pulled, dtype=np.float64)
    off = wire.curve.r[[0, -1]] - wire.stated.ends - pull[:, None] * wire.stated.outwards
    label = f"{wire.stated.name}, place of ends after their travel"
    return _metres(label, np.linalg.norm(off, axis=1), wire.joint_name[-2:])


def clamp_checks(
    result: FormResult, stated: StatedLine, wires: tuple[FreeSpatialWire, ...]
) -> Iterator[Check]:
    """Yield whether ties and masses are in the planes where the line file puts them, ties at both wires."""
    ties, masses = result.ties, result.masses
    host = positions(wires, ties.host, ties.coordinate)
    ends = {wire.stated.name: wire.curve.r[[0, -1]] for wire in wires}
    own = np.array([ends[name][end] for name, end in zip(ties.wire, ties.end, strict=True)]).reshape(-1, 3)
    names = tuple(
        f"{('start', 'end')[end]} of the {wire}" for wire, end in zip(ties.wire, ties.end, strict=True)
    )
    off = np.abs(ties.chainage - stated.ties.chainage)
    yield _metres("ties, ends at their hosts", np.linalg.norm(own - host, axis=1), names)
    yield _metres("ties, place along the track", np.maximum(off, np.abs(stated.ties.across.off(host))), names)
    at = positions(wires, masses.wire, masses.coordinate)
    off = np.maximum(np.abs(masses.chainage - stated.masses.chainage), np.abs(stated.masses.across.off(at)))
    yield _metres("masses, place along the track", off, masses.name)
    off = np.abs(masses.mass - stated.masses.mass)
    yield Check("lengths", "masses, mass", "kg", off, np.full(off.size, 1e-9), masses.name)


def length_check(wire: FreeSpatialWire) -> Check:
    """Return whether a wire is as long as stated between its supports, or between the ends that are tied."""
    form, curve = wire.form, wire.curve
    first, last = curve.s[[0, -1]] if wire.stated.tied else wire.support_s[[0, -1]]
    off = np.abs(
        [form.unstressed_length - (last - first), form.stretched_length - curve.stretched_length(first, last)]
    )
    return _metres(f"{wire.stated.name}, lengths", off, ("the unstressed one", "the stretched one"))


def profile_checks(wire: FreeSpatialWire, at: Points, across: Across) -> Iterator[Check]:
    """Yield whether a profile is on its wire, in global axes and by the planes across the track at it."""
    shape = wire.form.profile
    r = np.column_stack((shape.x, shape.y, shape.z))
    places = Along((wire,), (shape.s,))
    off = np.linalg.norm(at.r - r, axis=1)
    yield _metres("profile", off, places)
    for name, found in (
        ("chainage", np.abs(across.off(r))),
        ("lateral offset", np.abs(shape.lateral - across.lateral(r))),
        ("height", np.abs(shape.height - across.height(r))),
    ):
        yield _metres(f"profile, {name}", found, places)


def _metres(name: str, off: FloatArray, places: Names) -> Check:
    return Check("lengths", name, "m", off, np.full(off.size, TOLERANCE), places)
