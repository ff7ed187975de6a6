"""How far from the found form a rebuilt line may come to rest: what the method leaves open, and no more."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.line_model import LineModel
from catenaria.mechanics.state import State
from catenaria.results.form import FormResult
from catenaria.solvers.linear import factorise

FloatArray = NDArray[np.float64]

_ALONG, _VERTICAL = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
_LENGTH, _FORCE = 1e-5, 0.1  # m and N: what always passes
_BEYOND_LINEAR = 1.2  # droppers that lean by a fifth have effects of second order
_NONE = 1e-6  # N: forces that have no effect


class Measured(NamedTuple):
    """What is compared: heights of both wires [m] and forces [N] at droppers, reactions at wire ends [N]."""

    height: FloatArray
    messenger_height: FloatArray
    force: FloatArray
    tension: FloatArray


def measure(model: LineModel, z: FloatArray) -> Measured:
    """Return the heights, forces and tensions of a line of clamped droppers."""
    wires = (model.contact, model.messenger)
    height, messenger_height = (hung.wire.evaluate(z, z[hung.clamp_s]).r[:, 2] for hung in wires)
    force = model.droppers(z, clamped=True).loads(z)[0][:, 2]
    tension = np.array([float(np.linalg.norm(z[hung.end_force[1]])) for hung in wires])
    return Measured(height, messenger_height, force, tension)


def allowance(model: LineModel, z: FloatArray, result: FormResult) -> Measured:
    r"""Return the largest changes that pass.

    Parameters
    ----------
    model : LineModel
        The rebuilt line.
    z : FloatArray
        Its unknowns at rest.
    result : FormResult
        What was found. Its dropper lengths are not looked at.

    Notes
    -----
    0.01 mm and 0.1 N, and the linearised effect :math:`F_z^{-1}p` of the forces p that a whole dropper exerts
    and the method's two halves do not:

    - a dead band lets each dropper miss its balance (23) by a force that is shared by its two clamps. All
      droppers may do so at once, so that sizes of the effects add up. Other methods have none.
    - frictionless joints (15) may end with clamps that are not above each other. A whole dropper then pulls
      along the track as it leans, its halves as each of them leans.
    """
    effects = [Measured(*(np.zeros_like(part) for part in measure(model, z)))]
    pushes = [push for push in _pushes(model, z, result) if np.abs(push).max() > _NONE]
    if pushes:
        rest = np.zeros_like(z)
        J = model.as_built(z).jacobian(State(0.0, z, rest, rest))
        factors, before = factorise(J, permc_spec="NATURAL"), measure(model, z)
        for push in pushes:
            after = measure(model, z + factors.solve(push))
            effects.append(Measured(*(np.abs(b - a) for a, b in zip(before, after, strict=True))))
    height, messenger_height, force, tension = (np.sum(parts, axis=0) for parts in zip(*effects, strict=True))
    return Measured(height + _LENGTH, messenger_height + _LENGTH, force + _FORCE, tension + _FORCE)


def _pushes(model: LineModel, z: FloatArray, result: FormResult) -> Iterator[FloatArray]:
    """Yield loads on the wires whose effects add up."""
    on_contact, on_messenger = _leaning(model, z, result)
    nothing = np.zeros_like(on_contact)
    yield _BEYOND_LINEAR * _load(model, z, on_contact, nothing)
    yield _BEYOND_LINEAR * _load(model, z, nothing, on_messenger)
    for i, half in enumerate(0.5 * _imbalance(result)):
        push = np.zeros_like(on_contact)
        push[i, 2] = half
        if half > 0.0:
            yield _load(model, z, push, push)


def _imbalance(result: FormResult) -> FloatArray:
    """Return by how much each dropper may miss its balance (23) [N]; the audit holds it to its band."""
    if result.method != "dynamic":
        return np.zeros(0)
    factor = float(result.inputs["solver"]["dynamic"]["settle"]["dead_bands"])
    bands = dict(zip(result.controls.name, result.controls.dead_band.tolist(), strict=True))
    missed = np.abs(result.droppers.force_error)
    band = np.array([bands[f"force of dropper {i + 1}"] for i in range(missed.size)])
    return np.maximum(missed, factor * band)


def _leaning(model: LineModel, z: FloatArray, result: FormResult) -> tuple[FloatArray, FloatArray]:
    """Return forces of whole, leaning droppers on both wires minus those of their halves, (n, 3) each [N]."""
    wires, droppers = (model.contact, model.messenger), result.droppers
    below, above = (hung.wire.evaluate(z, z[hung.clamp_s]).r for hung in wires)
    clamp_below, clamp_above = (hung.setup.g * hung.setup.droppers.clamp_mass for hung in wires)
    pull = 0.5 * (droppers.force_bottom + clamp_below + droppers.force_top - clamp_above)
    across = (above - below) / np.linalg.norm(above - below, axis=1)[:, None] - _VERTICAL
    whole = pull[:, None] * across
    return whole - droppers.on_contact * _ALONG, -whole - droppers.on_messenger * _ALONG


def _load(model: LineModel, z: FloatArray, on_contact: FloatArray, on_messenger: FloatArray) -> FloatArray:
    """Return forces at the clamps, shape (n, 3) each, as forces on the unknowns."""
    load = np.zeros_like(z)
    for hung, force in ((model.contact, on_contact), (model.messenger, on_messenger)):
        point = hung.wire.evaluate(z, z[hung.clamp_s])
        np.add.at(load, point.dofs, point.N[:, :, None] * force[:, None, :])
    return load
