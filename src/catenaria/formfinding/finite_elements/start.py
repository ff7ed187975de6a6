"""Where the iterations begin: a contact wire through the wanted heights, a messenger of parabolas."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.wire import WireMesh
from catenaria.formfinding.finite_elements.wire_system import WireSystem
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]


def first_guess(system: LineSystem, start: FormResult | None) -> tuple[FloatArray, FloatArray]:
    """Return a first guess: `parabolic_start`, or the shapes and lengths of an earlier result.

    Raises
    ------
    InconsistentInputError
        If the earlier result is of a line with another number of droppers.
    """
    if start is None:
        return parabolic_start(system)
    if start.droppers.x.size != system.target.size:
        raise InconsistentInputError(
            f"the start has {start.droppers.x.size} droppers, the line {system.target.size}"
        )
    parts: list[FloatArray] = []
    for wire, form in zip((system.contact, system.messenger), start.wires, strict=True):
        z = np.interp(wire.mesh.x, form.profile.x - wire.mesh.origin, form.profile.z)
        parts.append(laid_out(wire, z, np.gradient(z, wire.mesh.x)))
    return np.concatenate(parts), start.droppers.unstressed_length


def parabolic_start(system: LineSystem) -> tuple[FloatArray, FloatArray]:
    """Return a first guess of all unknowns and of the droppers' unstressed lengths.

    Parameters
    ----------
    system : LineSystem
        The line.

    Returns
    -------
    y : FloatArray, shape (size,)
        The contact wire is straight between supports and wanted heights, the messenger a parabola in every
        span under the weight of both wires spread evenly.
    unstressed : FloatArray, shape (n,)
        Distances between the two: what a designer writes down first.
    """
    lower, upper = system.contact.mesh, system.messenger.mesh
    contact = straight_between(system.contact, system.target)
    z, slope = _parabolas(upper, lower.section.weight + upper.section.weight)
    return np.concatenate((contact, laid_out(system.messenger, z, slope))), z[upper.clamp] - system.target


def laid_out(system: WireSystem, z: FloatArray, slope: FloatArray) -> FloatArray:
    """Return the unknowns of a wire with given heights and slopes of its nodes, under its tension."""
    mesh = system.mesh
    stretch = 1.0 + mesh.tension / mesh.section.EA
    arc = np.hypot(np.diff(mesh.x), np.diff(z)) / stretch
    lengths = np.bincount(mesh.segment, arc)
    missing = mesh.laid - lengths.sum()
    lengths[[0, -1]] += 0.5 * missing
    pull = 0.5 * missing * stretch if system.pull is None else system.pull
    places = mesh.x[mesh.knots] + pull * np.eye(mesh.knots.size)[[0, -1]].T @ np.array([-1.0, 1.0])
    q = np.column_stack((np.interp(mesh.x, mesh.x[mesh.knots], places), z, np.arctan(slope)))
    return np.concatenate((q.reshape(-1)[system.free], lengths, [pull]))


def straight_between(system: WireSystem, target: FloatArray) -> FloatArray:
    """Return the unknowns of a wire that is straight between supports and wanted heights."""
    mesh = system.mesh
    height = np.full(mesh.joint.size, mesh.height)
    height[~mesh.is_support] = target
    z = np.interp(mesh.x, mesh.x[mesh.joint], height)
    return laid_out(system, z, np.gradient(z, mesh.x))


def _parabolas(mesh: WireMesh, weight: float) -> tuple[FloatArray, FloatArray]:
    """Return heights and slopes of a wire that hangs between its supports under an even weight [N/m]."""
    x = mesh.x[mesh.support]
    span = np.clip(np.searchsorted(x, mesh.x, side="right") - 1, 0, x.size - 2)
    left, right = mesh.x - x[span], mesh.x - x[span + 1]
    inside = (mesh.x >= x[0]) & (mesh.x <= x[-1])
    z = mesh.height + np.where(inside, 0.5 * weight / mesh.tension * left * right, 0.0)
    return z, np.where(inside, 0.5 * weight / mesh.tension * (left + right), 0.0)
