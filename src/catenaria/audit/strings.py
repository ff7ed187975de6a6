"""Strings: a wire without bending stiffness lies where the forces on it put it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.free_wire import Along, FreeBody
from catenaria.audit.lengths import TOLERANCE, green_stretch
from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.audit.verdict import Check, Names
from catenaria.results.form import Supports

FloatArray = NDArray[np.float64]

_ROUNDING = 1e-9  # m by which coordinates of one joint may differ


def wire_checks(wire: FreeBody, supports: Supports) -> Iterator[Check]:
    r"""Yield the checks of one string: balance, course, tension, places and lengths.

    Parameters
    ----------
    wire : FreeBody
        The string and the forces on it.
    supports : Supports
        What the result says of the supports.

    Notes
    -----
    Cut at s, a string is held by the force F(s) that is left of all forces and weights before s. It has no
    bending stiffness, so it runs in that direction, stretched by x(T): between any two of its points
    :math:`\Delta r = \int x(T)\,F/T\,ds`, integrated by Clenshaw-Curtis quadrature. What is missing across
    the string is told as the force T u/l that would hold it there over the length l, what is missing along
    it as the length that it is. Supports without friction do not change T.
    """
    name, tolerance = wire.stated.name, wire.force_tolerance
    end = inner_force(wire, wire.end_s[1:], after=True)
    yield _forces(wire, f"{name} as a whole", np.linalg.norm(end, axis=1), ("all its joints",))
    yield from _course(wire)
    here, there = (_size(inner_force(wire, wire.support_s, after=after)) for after in (False, True))
    places = wire.joint_name[: wire.support_s.size]
    yield _forces(wire, f"{name}, force of supports along the wire", np.abs(there - here), places)
    droppers = wire.joint_name[wire.support_s.size : -2]
    along = np.linalg.norm(wire.clamp_force[:, :2], axis=1)
    yield _forces(wire, f"{name}, force of droppers along the track", along, droppers)
    yield from _stated_forces(wire, tolerance)
    yield from _places(wire, supports)
    yield from _lengths(wire)


def inner_force(wire: FreeBody, s: FloatArray, *, after: bool) -> FloatArray:
    """Return the force F of the string behind s on the part before s, shape (n, 3) [N].

    Parameters
    ----------
    wire : FreeBody
        The string.
    s : FloatArray, shape (n,)
        Material coordinates [m].
    after : bool
        Whether the force of a joint at s belongs to the part before s.
    """
    order = np.argsort(wire.joint_s, kind="stable")
    joints, force = wire.joint_s[order], wire.joint_force[order]
    total = np.vstack((np.zeros(3), np.cumsum(force, axis=0)))
    shift = _ROUNDING if after else -_ROUNDING
    F = -total[np.searchsorted(joints, s + shift)]
    F[:, 2] += wire.stated.conductor.rhoA * wire.gravity * (s - wire.end_s[0])
    return F


def _size(F: FloatArray) -> FloatArray:
    return np.linalg.norm(F, axis=-1)


def _course(wire: FreeBody) -> Iterator[Check]:
    """Yield whether the string runs along its force, and is as long as its tension makes it."""
    shape = wire.form.profile
    r = np.column_stack((shape.x, shape.y, shape.z))
    ds, gap = np.diff(shape.s), np.diff(r, axis=0)
    middle = 0.5 * (shape.s[:-1] + shape.s[1:])
    F = inner_force(wire, middle, after=True)
    weight = wire.stated.conductor.rhoA * wire.gravity
    for point, share in zip(*clenshaw_curtis(4), strict=True):
        inside = F + np.outer((point - 0.5) * ds * weight, [0.0, 0.0, 1.0])
        size = _size(inside)
        gap -= (share * ds * green_stretch(size / wire.stated.conductor.EA) / size)[:, None] * inside
    T = _size(F)
    along = np.einsum("ni,ni->n", gap, F) / T
    across = _size(gap - along[:, None] * F / T[:, None])
    places = Along((wire,), (middle,))
    yield _forces(wire, f"{wire.stated.name}, force across the string", across * T / ds, places)
    yield _metres(f"{wire.stated.name}, stretched length between points", np.abs(along), places)


def _stated_forces(wire: FreeBody, tolerance: float) -> Iterator[Check]:
    """Yield whether the profile says what the sum of all forces leaves, before or behind a joint."""
    shape, EA = wire.form.profile, wire.stated.conductor.EA
    F = [inner_force(wire, shape.s, after=False), inner_force(wire, shape.s, after=True)]
    F[0][0], F[1][-1] = F[1][0], F[0][-1]  # there is no wire before the start and behind the end
    T = [_size(side) for side in F]
    strain = [size / green_stretch(size / EA) for size in T]
    places = Along((wire,), (shape.s,))
    for name, said, sides in (
        ("profile, tension", shape.tension, T),
        ("profile, strain tension (11)", shape.strain_tension, strain),
        ("profile, horizontal component", shape.horizontal, [side[:, 0] for side in F]),
    ):
        found = np.clip(said, np.minimum(*sides), np.maximum(*sides))
        yield _forces(wire, name, np.abs(said - found), places)
    none = np.full(shape.s.shape, tolerance)
    yield Check("equilibrium", "profile, bending moment", "N m", shape.moment, none, places)


def _places(wire: FreeBody, supports: Supports) -> Iterator[Check]:
    """Yield whether supports and ends are where they are said to be, and the strain at supports."""
    stated, places = wire.stated, wire.joint_name
    held = [i for i, other in enumerate(supports.wire) if other == stated.name]
    at = wire.position(wire.support_s)
    table = np.column_stack((supports.x, supports.z))[held] - stated.support[:, [0, 2]]
    off = np.maximum(_size(at - stated.support), np.max(np.abs(table), axis=1))
    yield _metres(f"{stated.name}, place at supports", off, places[: off.size])
    ends = stated.ends + wire.form.travel * stated.outwards
    off = _size(wire.position(wire.end_s) - ends)
    yield _metres(f"{stated.name}, place of ends after their travel", off, places[-2:])
    T = _size(inner_force(wire, wire.support_s, after=True))
    off = np.abs(supports.tension[held] - T / green_stretch(T / stated.conductor.EA))
    yield _forces(wire, f"{stated.name}, strain tension (11) at supports", off, places[: off.size])


def _lengths(wire: FreeBody) -> Iterator[Check]:
    """Yield the lengths of the whole string, with the stretch integrated between its points."""
    stated, form = wire.stated, wire.form
    first, last = wire.support_s[[0, -1]]
    inner = form.profile.s[(form.profile.s > first) & (form.profile.s < last)]
    s = np.concatenate(([first], inner, [last]))
    ds = np.diff(s)
    F = inner_force(wire, 0.5 * (s[:-1] + s[1:]), after=True)
    stretched = 0.0
    for point, share in zip(*clenshaw_curtis(4), strict=True):
        inside = F.copy()
        inside[:, 2] += (point - 0.5) * ds * stated.conductor.rhoA * wire.gravity
        stretched += float(share * ds @ green_stretch(_size(inside) / stated.conductor.EA))
    laid = stated.ends[1, 0] - stated.ends[0, 0]
    off = np.abs(
        [
            form.unstressed_length - (last - first),
            form.stretched_length - stretched,
            float(np.diff(wire.end_s)[0]) - laid,
        ]
    )
    what = ("the unstressed one", "the stretched one", "the one that was laid out")
    yield _metres(f"{stated.name}, lengths", off, what)


def _forces(wire: FreeBody, name: str, off: FloatArray, places: Names) -> Check:
    return Check("equilibrium", name, "N", off, np.full(off.size, wire.force_tolerance), places)


def _metres(name: str, off: FloatArray, places: Names) -> Check:
    return Check("lengths", name, "m", off, np.full(off.size, TOLERANCE), places)
