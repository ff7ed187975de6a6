"""A first guess of equilibrium: a taut wire with its droppers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.hung_wire import HungWire
from catenaria.discretise.wire_model import WireModel

FloatArray = NDArray[np.float64]


def guess_equilibrium(model: WireModel) -> FloatArray:
    """Return unknowns near the equilibrium in which all targets are met, shape (n,).

    Notes
    -----
    Wire: a taut wire over its supports, under the droppers' forces or over the wanted heights, stretched by
    its tension. Droppers: straight and stretched by their forces. Multipliers: the forces of that wire.
    """
    z = model.system.unknowns.start.copy()
    guess_wire(model, z)
    place_droppers(model, z, dropper_forces(model))
    return z


def guess_wire(hung: HungWire, z: FloatArray) -> None:
    """Write a tensioned wire, its joints and the forces of its supports and ends into z."""
    setup, tensioned = hung.setup, hung.tensioned
    _place_wire(hung, z)
    z[hung.pull] = tensioned.pull
    z[hung.support_s] = tensioned.material(setup.support_x)
    z[hung.clamp_s] = tensioned.material(setup.droppers.x + setup.droppers.length * _lean(hung))
    z[hung.end_force] = _end_forces(hung)
    z[hung.support_force] = _support_forces(hung)


def dropper_forces(hung: HungWire) -> FloatArray:
    """Return how much each dropper pulls at the wire, upwards at a contact wire, downwards at a messenger."""
    return _upwards(hung) * hung.tensioned.shape.force(hung.setup.droppers.x)


def _upwards(hung: HungWire) -> float:
    return 1.0 if hung.setup.droppers.up else -1.0


def _place_wire(hung: HungWire, z: FloatArray) -> None:
    shape, nodes = hung.tensioned.shape, hung.wire.nodes
    x = hung.tensioned.place(hung.wire.knots)
    slope = shape.slope(x)
    inclined = np.hypot(1.0, slope)
    along = stretch(shape.H * inclined, hung.wire.section.EA) / inclined
    z[nodes[:, 0]], z[nodes[:, 2]] = x, shape.height(x)
    z[nodes[:, 3]], z[nodes[:, 5]] = along, along * slope


def _lean(hung: HungWire) -> FloatArray:
    """Return how far the wire's end of each dropper is moved along the track, per length of the dropper.

    A guided dropper is vertical, a frictionless one normal to the wire.
    """
    if hung.setup.droppers.guided:
        return np.zeros_like(hung.setup.droppers.x)
    return _upwards(hung) * hung.tensioned.shape.slope(hung.setup.droppers.x)


def _end_forces(hung: HungWire) -> FloatArray:
    """Return the forces of the wire's start and end on the tensioning devices, shape (2, 3)."""
    shape = hung.tensioned.shape
    slope = shape.slope(shape.x[[0, -1]])
    along = np.column_stack((np.ones(2), np.zeros(2), slope)) / np.hypot(1.0, slope)[:, None]
    return shape.H * np.array([[1.0], [-1.0]]) * along


def _support_forces(hung: HungWire) -> FloatArray:
    """Return the forces of the wire on its supports, which are normal to it, shape (m, 3)."""
    x, shape = hung.setup.support_x, hung.tensioned.shape
    force, slope = -shape.force(x), shape.slope(x)
    return np.column_stack((-force * slope, np.zeros_like(force), force))


def place_droppers(model: WireModel, z: FloatArray, force: FloatArray) -> None:
    """Write dropper cables that pull at the wire with the given forces, and their multipliers, into z.

    They are straight, hang vertically from guided clamps or stand normal to the wire, and are stretched by
    what they carry: tension grows by the cable's weight from its lower to its upper end.
    """
    droppers, setup, upwards = model.droppers, model.setup, _upwards(model)
    kind, lean = setup.droppers, _lean(model)
    clamp = model.wire.evaluate(z, z[model.clamp_s]).r
    outwards = np.column_stack((-lean, np.zeros_like(lean), np.full_like(lean, upwards)))
    outwards /= np.hypot(1.0, lean)[:, None]
    inner = force + upwards * kind.clamp_mass * setup.g
    weight = upwards * kind.section.rhoA * setup.g
    for cable, foot, direction, pull in zip(droppers.chains, clamp, outwards, inner, strict=True):
        s = cable.knots
        r1 = stretch(pull + weight * s, kind.section.EA)
        middle = stretch(pull + weight * 0.5 * (s[:-1] + s[1:]), kind.section.EA)
        pieces = cable.L * (r1[:-1] + 4.0 * middle + r1[1:]) / 6.0
        z[cable.nodes[:, :3]] = foot + np.concatenate(([0.0], np.cumsum(pieces)))[:, None] * direction
        z[cable.nodes[:, 3:]] = r1[:, None] * direction
    far = droppers.outer[:, 2]
    z[droppers.travel] = upwards * (z[far] - model.system.unknowns.start[far])
    z[droppers.clamp_force] = -force[:, None] * outwards
    z[droppers.free_force] = -(inner + weight * kind.length)[:, None] * outwards
