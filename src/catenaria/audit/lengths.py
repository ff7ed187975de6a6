"""Geometry and lengths: where wires are held, how long wires and droppers are with and without force."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.free_wire import Along, FreeBody, FreeWire
from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.audit.stated import Stated
from catenaria.audit.verdict import Check, Names
from catenaria.results.form import Droppers, Supports

FloatArray = NDArray[np.float64]

_GROUP = "lengths"
TOLERANCE = 1e-7  # m: a thousandth of what can be built, and a thousand times what constraints are solved to


def wire_checks(wire: FreeWire, supports: Supports) -> Iterator[Check]:
    """Yield the checks of a wire's places and lengths."""
    name, stated, form = wire.stated.name, wire.stated, wire.form
    held = [i for i, other in enumerate(supports.wire) if other == stated.name]
    at = wire.curve.at(wire.support_s).r
    table = np.column_stack((supports.x, supports.z))[held] - stated.support[:, [0, 2]]
    off = np.maximum(np.max(np.abs(at - stated.support), axis=1), np.max(np.abs(table), axis=1))
    yield _check(f"{name}, place at supports", off, wire.joint_name[: off.size])

    ends = stated.ends + form.travel * stated.outwards
    off = np.linalg.norm(wire.curve.r[[0, -1]] - ends, axis=1)
    yield _check(f"{name}, place of ends after their travel", off, wire.joint_name[-2:])

    first, last = wire.support_s[[0, -1]]
    laid = stated.ends[1, 0] - stated.ends[0, 0]
    off = np.abs(
        [
            form.unstressed_length - (last - first),
            form.stretched_length - wire.curve.stretched_length(first, last),
            wire.curve.s[-1] - wire.curve.s[0] - laid,
        ]
    )
    what = ("the unstressed one", "the stretched one", "the one that was laid out")
    yield _check(f"{name}, lengths", off, what)

    shape = form.profile
    r = np.column_stack((shape.x, shape.y, shape.z))
    off = np.linalg.norm(wire.curve.at(shape.s).r - r, axis=1)
    yield _check("profile", off, Along((wire,), (shape.s,)))


def dropper_checks(wires: tuple[FreeBody, FreeBody], droppers: Droppers, stated: Stated) -> Iterator[Check]:
    """Yield the checks of the dropper schedule: places, heights, and all three lengths."""
    names = tuple(f"dropper {i + 1}" for i in range(droppers.x.size))
    kind = stated.droppers
    foot, top = (wire.position(wire.clamp_s) for wire in wires)
    off = np.abs(droppers.x - kind.x)
    if kind.guided:
        clamps = np.abs(np.column_stack((foot[:, 0], top[:, 0])) - kind.x[:, None])
        off = np.maximum(off, clamps.max(axis=1))
    yield _check("droppers, place along the track", off, names)
    for what, column, height in (
        ("contact wire", droppers.height, foot[:, 2]),
        ("messenger wire", droppers.messenger_height, top[:, 2]),
    ):
        yield _check(f"droppers, height of the {what}", np.abs(column - height), names)
    distance = np.linalg.norm(top - foot, axis=1)
    yield _check("droppers, length", np.abs(droppers.length - distance), names)
    stretched = droppers.unstressed_length * _mean_stretch(droppers, stated)
    yield _check("droppers, unstressed length", np.abs(droppers.length - stretched), names)
    cut = droppers.unstressed_length - kind.clamp_heights
    yield _check("droppers, length to be cut", np.abs(droppers.cut_length - cut), names)


def inner_tension(droppers: Droppers, stated: Stated) -> FloatArray:
    """Return the tension of droppers just above the lower and below the upper clamp [N], shape (n, 2)."""
    kind, g = stated.droppers, stated.gravity
    return np.column_stack(
        (droppers.force_bottom + g * kind.mass_bottom, droppers.force_top - g * kind.mass_top)
    )


def _mean_stretch(droppers: Droppers, stated: Stated) -> FloatArray:
    """Return deformed over unstressed length, the stretch integrated along the dropper.

    Notes
    -----
    Weight makes the force grow linearly.
    """
    points, weights = clenshaw_curtis(4)
    tension = inner_tension(droppers, stated)
    force = tension[:, :1] + np.diff(tension, axis=1) * points
    return green_stretch(force / stated.droppers.conductor.EA) @ weights


def green_stretch(ratio: FloatArray) -> FloatArray:
    """Return the stretch x with (x^2 - 1) x/2 = T/EA, the law of Green strain (9)."""
    x = np.ones_like(ratio)
    for _ in range(6):  # Newton's method doubles its digits; forces of a tenth of EA need four steps
        x -= (x**3 - x - 2.0 * ratio) / (3.0 * x**2 - 1.0)
    return x


def _check(name: str, off: FloatArray, place: Names) -> Check:
    return Check(_GROUP, name, "m", off, np.full(off.size, TOLERANCE), place)
