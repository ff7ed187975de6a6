"""Start from an interim configuration: the loop of Fig. 2, in which a result is the next input."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.wire_model import WireModel
from catenaria.discretise.wire_setup import WireSetup
from catenaria.errors import InconsistentInputError
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Unknowns
from catenaria.results.form import FormResult, Stage

FloatArray = NDArray[np.float64]

_TOLERANCE = 1e-6  # m by which lengths and joints of an earlier result may differ from those of the line


def with_full_gravity(setup: WireSetup) -> WireSetup:
    """Return the setup with full gravity from the start: an interim configuration carries its weight."""
    return replace(setup, gravity_ramp=Ramp(0.0))


def stage_of(result: FormResult, step: str) -> Stage:
    """Return the final state of one step of an earlier result.

    Raises
    ------
    InconsistentInputError
        If there is none, or the result is of another kind of wires.
    """
    if result.physics != "bending":
        raise InconsistentInputError(
            f"the earlier result is by the method {result.method!r}, whose wires are of another kind: start "
            "from one by the direct or the dynamic method"
        )
    for candidate in result.stages:
        if candidate.step == step:
            return candidate
    raise InconsistentInputError(f"the earlier result has no step {step!r} to start from")


def start_from(model: WireModel, stage: Stage) -> WireModel:
    """Return the model at the configuration of an earlier result; the two meshes may differ.

    Parameters
    ----------
    model : WireModel
        The model of the line, at its own starting configuration.
    stage : Stage
        Final state of the same step in the earlier result.

    Returns
    -------
    WireModel
        The same model with other starting values, at rest.

    Raises
    ------
    InconsistentInputError
        If the earlier result has other cables, other cable lengths, or joints elsewhere.
    """
    chains = (model.wire, *model.droppers.chains)
    if len(chains) != stage.node_count.size:
        raise InconsistentInputError(
            f"the earlier result has {stage.node_count.size - 1} droppers, the line has {len(chains) - 1}"
        )
    places = np.concatenate((model.support_s, model.clamp_s))
    if places.size != stage.sliding_coordinate.size:
        raise InconsistentInputError(
            f"the {model.setup.name} has {stage.sliding_coordinate.size} joints in the earlier result, "
            f"{places.size} in the line"
        )
    z = model.system.unknowns.start.copy()
    ends = np.cumsum(stage.node_count)
    for name, chain, first, last in zip(stage.chain, chains, ends - stage.node_count, ends, strict=True):
        knots = stage.s[first:last]
        if abs(knots[-1] - chain.knots[-1]) > _TOLERANCE:
            raise InconsistentInputError(
                f"{name} is {knots[-1]:.6g} m long in the earlier result, {chain.knots[-1]:.6g} m in the line"
            )
        nodes = np.hstack((stage.position[first:last], stage.slope[first:last]))
        z[chain.nodes] = _interpolate(knots, nodes, np.minimum(chain.knots, knots[-1]))
    z[places] = stage.sliding_coordinate
    z[np.concatenate((model.pull, model.droppers.travel))] = stage.parameter
    z[model.multipliers] = stage.multiplier
    _refuse_elsewhere(model, z)
    system = System(Unknowns(model.system.unknowns.kind, z), model.system.contributions)
    return replace(model, system=system.relocate(z) or system)


def _interpolate(knots: FloatArray, nodes: FloatArray, s: FloatArray) -> FloatArray:
    """Return r and r' at material coordinates s of a cable with the given nodes, shape (n, 6)."""
    index = np.arange(nodes.size, dtype=np.int64).reshape(nodes.shape)
    point = Chain(index, knots, Section(1.0, 0.0, 1.0)).evaluate(nodes.ravel(), s)
    return np.hstack((point.r, point.r1))


def _refuse_elsewhere(model: WireModel, z: FloatArray) -> None:
    setup = model.setup
    for what, s, x in (
        ("supports", model.support_s, setup.support_x),
        ("droppers", model.clamp_s, setup.droppers.x),
    ):
        if what == "droppers" and not setup.droppers.guided:
            continue
        away = np.abs(model.wire.evaluate(z, z[s]).r[:, 0] - x)
        if away.max() > 1e-3:
            raise InconsistentInputError(
                f"the {what} of the earlier result are up to {away.max():.4g} m from those of the line"
            )
