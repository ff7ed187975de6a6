"""From a state of a line in space to the forces on supports, steady arms and cantilevers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout, across
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.errors import InconsistentInputError
from catenaria.line import Line
from catenaria.line.steady_arm import SteadyArm
from catenaria.results.form import Arms, Cantilevers, Supports

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_DOWN = np.array([0.0, 0.0, -1.0])


def supports(line: Line, state: Natural) -> Supports:
    """Return where wires are held, and their forces on what holds them."""
    model, z, holds = state.model, state.solved, state.model.layout.holds
    r = model.hold_carrier.evaluate(z, z[model.hold_s]).r
    force = model.hold_forces(z)
    return Supports(
        support=_names(line, holds.support),
        wire=tuple(model.layout.wires[int(k)].name for k in holds.wire),
        kind=holds.kind,
        x=r[:, 0].copy(),
        y=r[:, 1].copy(),
        z=r[:, 2].copy(),
        chainage=holds.frame.chainage,
        stagger=holds.frame.lateral(r),
        height=holds.frame.height(r),
        force_x=force[:, 0],
        force_y=force[:, 1],
        force_z=force[:, 2],
        force_lateral=np.einsum("ni,ni->n", across(holds.frame), force),
        tension=hold_strain_tension(model, z),
        sliding_coordinate=state.z[model.hold_s],
    )


def hold_strain_tension(model: SpatialModel, z: FloatArray) -> FloatArray:
    """Return N = EA eps of eq. (11) where wires are held, which are never tied ones [N]."""
    r1 = model.hold_carrier.evaluate(z, z[model.hold_s]).r1
    EA = np.array([wire.section.EA for wire in model.wires])[model.layout.holds.wire]
    return 0.5 * EA * (np.einsum("ni,ni->n", r1, r1) - 1.0)


def arms(line: Line, state: Natural) -> Arms:
    """Return where steady arms stand and what they bear.

    Notes
    -----
    An arm with hinges at both ends and half of its weight on each of them carries at its tip F - m g/2 ez
    along itself, where F is the force of the wire: that is its direction if its hinge is to be found.
    """
    model, z, holds = state.model, state.solved, state.model.layout.holds
    mask = np.array([kind == "arm" for kind in holds.kind], dtype=np.bool_)
    frame, side, length = holds.frame.take(mask), holds.side[mask], holds.arm_length[mask]
    tip = model.hold_carrier.evaluate(z, z[model.hold_s]).r[mask]
    force = model.hold_forces(z)[mask]
    along_arm = force + 0.5 * model.layout.g * holds.arm_mass[mask][:, None] * _DOWN
    left = across(frame)
    direction = _directions(along_arm, left, side)
    given = holds.hinged[mask]
    direction[given] = (tip[given] - holds.hinge[mask][given]) / length[given, None]
    hinge = tip - length[:, None] * direction
    stated = [_stated(line, int(i)) for i in holds.support[mask]]
    return Arms(
        support=_names(line, holds.support[mask]),
        wire=tuple(model.layout.wires[int(k)].name for k in holds.wire[mask]),
        registration=tuple(arm.registration for arm in stated),
        chainage=frame.chainage,
        hinge=hinge,
        tip=tip,
        hinge_stagger=frame.lateral(hinge),
        hinge_height=frame.height(hinge),
        length=length,
        angle=np.arcsin(np.clip(direction[:, 2], -1.0, 1.0)),
        axial=np.einsum("ni,ni->n", direction, along_arm),
        radial=-side * np.einsum("ni,ni->n", left, force),
        vertical=-force[:, 2],
        minimum_radial=np.array([arm.minimum_pull or 0.0 for arm in stated]),
    )


def _directions(force: FloatArray, left: FloatArray, side: FloatArray) -> FloatArray:
    """Return unit vectors from hinges to tips, along the forces, with the hinges on the given sides.

    An arm on which nothing acts stands level.
    """
    level = -side[:, None] * left
    away = np.where(np.einsum("ni,ni->n", force, level) < 0.0, -1.0, 1.0)[:, None] * force
    size = np.linalg.norm(away, axis=1)[:, None]
    return np.where(size > 0.0, away / np.where(size > 0.0, size, 1.0), level)


def _stated(line: Line, support: int) -> SteadyArm:
    contact = line.supports[support].contact_wire
    if contact is None or contact.arm is None:
        raise InconsistentInputError(f"there is no steady arm at {line.supports[support].name}")
    return contact.arm


def cantilevers(line: Line, state: Natural) -> Cantilevers:
    """Return where flexible cantilevers are, and their forces on their roots."""
    model, z, layout = state.model, state.solved, state.model.layout
    return Cantilevers(
        support=tuple(line.supports[i].name for i in held_by_cantilevers(layout)),
        root=np.array([part.root for part in layout.cantilevers]).reshape(-1, 3),
        tip=np.array([z[chain.nodes[-1, :3]] for chain in model.cantilevers]).reshape(-1, 3),
        force=z[model.root_force[:, :3]],
    )


def held_by_cantilevers(layout: Layout) -> list[int]:
    """Return the indices of the supports that are cantilevers."""
    return [int(layout.holds.support[part.hold]) for part in layout.cantilevers]


def _names(line: Line, supports: IntArray) -> tuple[str, ...]:
    return tuple(line.supports[int(i)].name for i in supports)
