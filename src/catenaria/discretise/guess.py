"""A first guess of the equilibrium of a wire model: a taut string with its droppers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.catenary.taut_string import taut_string
from catenaria.discretise.wire_model import WireModel

FloatArray = NDArray[np.float64]


def guess_equilibrium(model: WireModel) -> FloatArray:
    """Return unknowns near the equilibrium in which all targets are met, shape (n,).

    Notes
    -----
    Wire: a taut string over its supports, under the droppers' forces or over the wanted heights, uniformly
    stretched and placed symmetrically. Droppers: straight and stretched by their forces. Multipliers: the
    forces of that string.
    """
    setup = model.setup
    z = model.system.unknowns.start.copy()
    middle, half = 0.5 * (setup.support_x[0] + setup.support_x[-1]), 0.5 * model.wire.knots[-1]
    force, factor = setup.tension.force, float(stretch(setup.tension.force, setup.section.EA))
    x = middle + (model.wire.knots - half) * factor
    held, loads = _string(model)
    weight = setup.section.rhoA * setup.g
    height, slope = taut_string(x, held, force, weight, loads)
    z[model.wire.nodes[:, 0]], z[model.wire.nodes[:, 2]] = x, height
    z[model.wire.nodes[:, 3]], z[model.wire.nodes[:, 5]] = factor, factor * slope
    z[model.pull] = half * (factor - 1.0)
    for s in (model.support_s, model.clamp_s):
        z[s] = half + (z[s] - half) / factor
    z[model.end_force] = force * np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    _place_droppers(model, z, _dropper_forces(model, held))
    return z


def _string(
    model: WireModel,
) -> tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray] | None]:
    """Return what holds the string and what pulls at it: wanted heights hold, wanted forces pull."""
    setup, droppers = model.setup, model.setup.droppers
    supports = setup.support_x, np.full_like(setup.support_x, setup.height)
    if not droppers.up:
        return supports, (droppers.x, droppers.target)
    x = np.concatenate((supports[0], droppers.x))
    order = np.argsort(x, kind="stable")
    return (x[order], np.concatenate((supports[1], droppers.target))[order]), None


def _dropper_forces(model: WireModel, held: tuple[FloatArray, FloatArray]) -> FloatArray:
    """Return the pull of each dropper: as wanted, or the kink of the string over the wanted heights."""
    setup, droppers = model.setup, model.setup.droppers
    if not droppers.up:
        return droppers.target
    x, height = held
    bays, rise = np.diff(x), np.diff(height)
    kink = np.diff(rise / bays)
    pull = setup.section.rhoA * setup.g * 0.5 * (bays[:-1] + bays[1:]) - setup.tension.force * kink
    return pull[np.isin(x[1:-1], droppers.x)]


def _place_droppers(model: WireModel, z: FloatArray, force: FloatArray) -> None:
    """Write straight, stretched dropper cables and their forces into z."""
    droppers, upwards = model.setup.droppers, 1.0 if model.setup.droppers.up else -1.0
    clamp_z = model.wire.evaluate(z, z[model.clamp_s]).r[:, 2]
    factor = stretch(force, droppers.section.EA)
    for cable, foot, stretched in zip(model.cables, clamp_z, factor, strict=True):
        z[cable.nodes[:, 2]] = foot + upwards * stretched * cable.knots
        z[cable.nodes[:, 5]] = upwards * stretched
    far = np.array([cable.nodes[-1, 2] for cable in model.cables])
    z[model.dropper_travel] = upwards * (z[far] - model.system.unknowns.start[far])
    z[model.clamp_force[:, 2]] = -upwards * force
    z[model.free_force[:, 2]] = upwards * -force
