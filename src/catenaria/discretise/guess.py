"""A first guess of the equilibrium of a wire model: a taut wire with its droppers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.discretise.wire_model import WireModel
from catenaria.discretise.wire_setup import WireSetup
from catenaria.mechanics.chain import Chain

FloatArray = NDArray[np.float64]


def guess_equilibrium(model: WireModel) -> FloatArray:
    """Return unknowns near the equilibrium in which all targets are met, shape (n,).

    Notes
    -----
    Wire: a taut wire over its supports, under the droppers' forces or over the wanted heights, stretched by
    its tension. Droppers: straight and stretched by their forces. Multipliers: the forces of that wire.
    """
    setup = model.setup
    z = model.system.unknowns.start.copy()
    tensioned = TensionedWire.of(setup)
    place_wire(setup, model.wire, tensioned, z)
    z[model.pull] = tensioned.pull
    z[model.support_s] = tensioned.material(setup.support_x)
    slope = _lean(setup, tensioned)
    upwards = 1.0 if setup.droppers.up else -1.0
    z[model.clamp_s] = tensioned.material(setup.droppers.x + upwards * setup.droppers.length * slope)
    z[model.end_force] = end_forces(tensioned)
    z[model.support_force] = support_forces(setup, tensioned)
    _place_droppers(model, z, dropper_forces(setup, tensioned), slope)
    return z


def place_wire(setup: WireSetup, wire: Chain, tensioned: TensionedWire, z: FloatArray) -> None:
    """Write the nodes of a tensioned wire into z."""
    x = tensioned.place(wire.knots)
    slope = tensioned.shape.slope(x)
    inclined = np.hypot(1.0, slope)
    along = stretch(setup.tension.force * inclined, setup.section.EA) / inclined
    nodes = wire.nodes
    z[nodes[:, 0]], z[nodes[:, 2]] = x, tensioned.shape.height(x)
    z[nodes[:, 3]], z[nodes[:, 5]] = along, along * slope


def _lean(setup: WireSetup, tensioned: TensionedWire) -> FloatArray:
    """Return the slope of the wire at each dropper if that stands normal to it, else none."""
    if setup.droppers.guided:
        return np.zeros_like(setup.droppers.x)
    return tensioned.shape.slope(setup.droppers.x)


def end_forces(tensioned: TensionedWire) -> FloatArray:
    """Return the forces of the wire's start and end on the tensioning devices, shape (2, 3)."""
    slope = tensioned.shape.slope(tensioned.shape.x[[0, -1]])
    along = np.column_stack((np.ones(2), np.zeros(2), slope))
    return tensioned.shape.H * np.array([[1.0], [-1.0]]) * along / np.hypot(1.0, slope)[:, None]


def support_forces(setup: WireSetup, tensioned: TensionedWire) -> FloatArray:
    """Return the forces of the wire on its supports, which are normal to it, shape (m, 3)."""
    down = _kink_forces(tensioned, setup.support_x)
    slope = tensioned.shape.slope(setup.support_x)
    return np.column_stack((-down * slope, np.zeros_like(down), down))


def dropper_forces(setup: WireSetup, tensioned: TensionedWire) -> FloatArray:
    """Return how much each dropper pulls at the wire, upwards at a contact wire, downwards at a messenger."""
    upwards = 1.0 if setup.droppers.up else -1.0
    return -upwards * _kink_forces(tensioned, setup.droppers.x)


def _kink_forces(tensioned: TensionedWire, x: FloatArray) -> FloatArray:
    """Return H J, the force of the wire on what kinks it at x, positive upwards."""
    shape = tensioned.shape
    return shape.H * shape.jump[np.searchsorted(shape.x, x)]


def _place_droppers(model: WireModel, z: FloatArray, force: FloatArray, slope: FloatArray) -> None:
    """Write straight, stretched dropper cables and their forces into z; `slope` is how much they lean."""
    droppers, upwards = model.setup.droppers, 1.0 if model.setup.droppers.up else -1.0
    clamp = model.wire.evaluate(z, z[model.clamp_s]).r
    outwards = upwards * np.column_stack((-slope, np.zeros_like(slope), np.ones_like(slope)))
    along = stretch(force, droppers.section.EA)[:, None] * outwards / np.hypot(1.0, slope)[:, None]
    for cable, foot, r1 in zip(model.cables, clamp, along, strict=True):
        z[cable.nodes[:, :3]] = foot + cable.knots[:, None] * r1
        z[cable.nodes[:, 3:]] = r1
    far = np.array([cable.nodes[-1, 2] for cable in model.cables])
    z[model.dropper_travel] = upwards * (z[far] - model.system.unknowns.start[far])
    pull = upwards * force[:, None] * np.column_stack((-slope, np.zeros_like(slope), np.ones_like(slope)))
    z[model.clamp_force], z[model.free_force] = -pull, -pull
