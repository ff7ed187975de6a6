"""Steady arms and flexible cantilevers of a line in space as bodies of their own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.curve import Curve
from catenaria.audit.energy import nodal_residual
from catenaria.audit.lengths import TOLERANCE
from catenaria.audit.spatial.bodies import FreeSpatialWire
from catenaria.audit.spatial.stated import StatedLine
from catenaria.audit.spatial.stated_holds import StatedArm, StatedCantilever
from catenaria.audit.track import Across
from catenaria.audit.verdict import Check
from catenaria.errors import InconsistentInputError
from catenaria.results.form import Arms, Cantilevers, FormResult

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class HeldArm:
    """Steady arms with the wires that they hold: what was asked for, planes, wires' places and forces."""

    name: tuple[str, ...]
    stated: tuple[StatedArm, ...]
    across: Across
    chainage: FloatArray
    tip: FloatArray
    force: FloatArray


def arm_checks(result: FormResult, stated: StatedLine, wires: tuple[FreeSpatialWire, ...]) -> Iterator[Check]:
    """Yield the geometry of all steady arms, and their balance under the wire and half of their weight.

    Raises
    ------
    InconsistentInputError
        If the table does not hold the arms of the line.
    """
    held = _held(wires)
    arms = result.arms
    if (
        tuple(f"{wire}, arm at {name}" for wire, name in zip(arms.wire, arms.support, strict=True))
        != held.name
    ):
        raise InconsistentInputError("the result does not have the steady arms of its line in order")
    if arms.registration != tuple(arm.registration for arm in held.stated):
        raise InconsistentInputError("the result mistakes pull-off and push-off arms")
    if held.name:
        yield from _geometry(arms, held)
        tolerance = max(wire.force_tolerance for wire in wires)
        yield from _forces(arms, held, stated.gravity, tolerance)


def _held(wires: tuple[FreeSpatialWire, ...]) -> HeldArm:
    names: list[str] = []
    stated: list[StatedArm] = []
    parts: list[tuple[Across, FloatArray, FloatArray, FloatArray]] = []
    for wire in wires:
        holds = wire.stated.holds
        rows = np.array([i for i, arm in enumerate(holds.arm) if arm is not None], dtype=np.int64)
        stated += [arm for arm in holds.arm if arm is not None]
        names += [f"{wire.stated.name}, arm at {wire.stated.support_name[i]}" for i in rows.tolist()]
        tip = wire.curve.at(wire.support_s).r[rows]
        parts.append((holds.across.take(rows), holds.chainage[rows], tip, -wire.support_force[rows]))
    across, chainage, tip, force = zip(*parts, strict=True)
    planes = [
        np.concatenate([getattr(part, axis) for part in across]) for axis in ("origin", "along", "left", "up")
    ]
    return HeldArm(
        tuple(names),
        tuple(stated),
        Across(*planes),
        np.concatenate(chainage),
        np.concatenate(tip),
        np.concatenate(force),
    )


def _geometry(arms: Arms, held: HeldArm) -> Iterator[Check]:
    """Yield where tips and hinges are, and how far apart."""
    wanted = np.array([arm.length for arm in held.stated])
    side = np.array([arm.side for arm in held.stated])
    hinge = np.array([arm.hinge for arm in held.stated])
    across = held.across
    reach = arms.tip - arms.hinge
    distance = np.linalg.norm(reach, axis=1)
    angle = np.arctan2(reach[:, 2], np.hypot(reach[:, 0], reach[:, 1]))
    offset = across.lateral(arms.hinge), across.height(arms.hinge)
    given = np.hypot(offset[0] - hinge[:, 0], offset[1] - hinge[:, 1])
    inside = -side * np.einsum("ni,ni->n", across.sideways, reach)  # how far the hinge is on its side
    table = np.abs((arms.hinge_stagger - offset[0], arms.hinge_height - offset[1]))
    for name, off in (
        ("tip at the wire", np.linalg.norm(arms.tip - held.tip, axis=1)),
        ("length from hinge to tip", np.maximum(np.abs(distance - wanted), np.abs(arms.length - wanted))),
        (
            "hinge across the track",
            np.maximum(np.abs(across.off(arms.hinge)), np.abs(arms.chainage - held.chainage)),
        ),
        ("hinge where it is given", np.where(np.isfinite(hinge[:, 0]), given, 0.0)),
        ("hinge on its side", np.maximum(-inside, 0.0)),
        ("stated place of the hinge", np.max(table, axis=0)),
        ("stated angle", np.abs(arms.angle - angle) * wanted),
    ):
        yield Check("lengths", f"arms, {name}", "m", off, np.full(off.size, TOLERANCE), held.name)


def _forces(arms: Arms, held: HeldArm, gravity: float, tolerance: float) -> Iterator[Check]:
    """Yield whether arms pull along themselves, and what the table says of their forces."""
    mass = np.array([arm.mass for arm in held.stated])
    wanted = np.array([arm.minimum_pull for arm in held.stated])
    along = held.force.copy()
    along[:, 2] -= 0.5 * gravity * mass
    unit = (arms.tip - arms.hinge) / np.linalg.norm(arms.tip - arms.hinge, axis=1)[:, None]
    axial = np.einsum("ni,ni->n", along, unit)
    level = unit * np.array([1.0, 1.0, 0.0])
    level /= np.linalg.norm(level, axis=1)[:, None]
    radial = np.einsum("ni,ni->n", held.force, level)
    for name, off in (
        ("force of the wire and half of the weight across the arm", _size(along - axial[:, None] * unit)),
        ("stated axial force", np.abs(arms.axial - axial)),
        ("stated radial force", np.abs(arms.radial - radial)),
        ("stated vertical force", np.abs(arms.vertical + held.force[:, 2])),
        ("stated minimum of the radial force", np.abs(arms.minimum_radial - wanted)),
    ):
        yield Check("equilibrium", f"arms, {name}", "N", off, np.full(off.size, tolerance), held.name)


def cantilever_checks(
    result: FormResult, stated: StatedLine, wires: tuple[FreeSpatialWire, ...], curves: dict[str, Curve]
) -> Iterator[Check]:
    """Yield the balance of every cantilever, and where its root and tip are.

    Raises
    ------
    InconsistentInputError
        If the result does not hold the cantilevers of the line.
    """
    table, loads = result.cantilevers, _carried(wires)
    found = {f"cantilever {name}": i for i, name in enumerate(table.support)}
    if len(found) != len(loads) or any(name not in found or name not in curves for name in loads):
        raise InconsistentInputError("the result does not have the cantilevers of its line")
    for name, load in loads.items():
        yield from _cantilever(name, curves[name], load, table, found[name], stated.gravity)


@dataclass(frozen=True)
class _Load:
    """What a cantilever carries: where its tip is without load, where the wire is, and its force."""

    kind: StatedCantilever
    free: FloatArray
    at: FloatArray
    force: FloatArray
    left: FloatArray
    tolerance: float


def _carried(wires: tuple[FreeSpatialWire, ...]) -> dict[str, _Load]:
    loads: dict[str, _Load] = {}
    for wire in wires:
        holds, at = wire.stated.holds, wire.curve.at(wire.support_s).r
        for i, kind in enumerate(holds.cantilever):
            if kind is not None:
                force, left = -wire.support_force[i], holds.across.left[i]
                load = _Load(kind, holds.place[i], at[i], force, left, wire.force_tolerance)
                loads[f"cantilever {wire.stated.support_name[i]}"] = load
    return loads


def _cantilever(
    name: str, curve: Curve, load: _Load, table: Cantilevers, row: int, gravity: float
) -> Iterator[Check]:
    """Yield the checks of one cantilever; its root takes any force and moment, and keeps its direction."""
    inwards = -load.kind.side * load.left
    root = load.free - load.kind.length * inwards
    residual = nodal_residual(curve, load.kind.conductor, gravity, curve.s[-1:], load.force[None, :])
    on_root = -residual[0, 0]
    residual[0] = 0.0
    size = np.linalg.norm(residual, axis=2) / np.array([1.0, float(curve.L.min())])
    off = np.array([float(size.max()), float(np.linalg.norm(table.force[row] - on_root))])
    unit = np.full(2, load.tolerance)
    places = (f"{name}, nodes", f"{name}, root")
    yield Check("equilibrium", "cantilevers, balance", "N", off, unit, places)
    direction = curve.r1[0] / np.linalg.norm(curve.r1[0])
    reach = np.array(
        [
            np.linalg.norm(curve.r[0] - root),
            np.linalg.norm(table.root[row] - root),
            np.linalg.norm(curve.r[-1] - load.at),
            np.linalg.norm(table.tip[row] - load.at),
            abs(float(np.ptp(curve.s)) - load.kind.length),
            np.linalg.norm(direction - inwards) * load.kind.length,
        ]
    )
    what = ("root", "stated root", "tip at the wire", "stated tip", "length", "direction of the root")
    places = tuple(f"{name}, {part}" for part in what)
    yield Check("lengths", "cantilevers, places", "m", reach, np.full(reach.size, TOLERANCE), places)


def _size(force: FloatArray) -> FloatArray:
    return np.linalg.norm(force, axis=1)
