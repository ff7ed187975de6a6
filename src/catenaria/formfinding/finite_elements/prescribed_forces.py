r"""Wires whose forces are prescribed and whose unstressed lengths follow by cutting.

Nodes stand at given places along the track. Weight and droppers pull vertically, so that the horizontal force
is the same in all elements between two joints: the prescribed distribution of forces.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements import beam
from catenaria.formfinding.finite_elements.beam import Section
from catenaria.formfinding.finite_elements.dropper import Bars
from catenaria.formfinding.finite_elements.found import Found, WireShape
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.sparse import Matrix, matrix, solve
from catenaria.formfinding.finite_elements.start import first_guess
from catenaria.formfinding.finite_elements.wire_system import WireSystem
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
Stiffness = Callable[[FloatArray, FloatArray, Section], FloatArray]

_ENOUGH = 1e-9  # m and rad: the last displacement
_CUTS = 3  # Newton steps to cut an element to its force; each doubles the digits
_FAR = 10.0  # m and rad: a displacement in one round that leads nowhere
_ROUNDS = 200
_STEEPEST = 0.5  # of the tension, that a device's reaction may have upwards, and must have along the track
_TENSION = 1e-3  # N, within which it must be met


@dataclass(frozen=True)
class _Course:
    """A wire on its way to equilibrium: its shape, its forces' prescribed parts, and its last displacement.

    Attributes
    ----------
    shape : WireShape
        The present configuration, cut to the prescribed forces.
    force : FloatArray, shape (n_nodes, 3)
        Forces that hold its nodes.
    moved : float
        Largest displacement of the last step [m].
    """

    shape: WireShape
    force: FloatArray
    moved: float


def vary(line: Line, start: FormResult | None, stiffness: Stiffness, what: str) -> Found:
    """Move the nodes of both wires until they are in equilibrium with the prescribed forces.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    start : FormResult or None
        An earlier result to begin from.
    stiffness : callable
        Returns the element matrices (n, 6, 6) by which unbalanced forces are turned into displacements,
        from coordinates, unstressed lengths and the section.
    what : str
        What was done, in words.

    Raises
    ------
    NotConvergedError
        If the nodes do not come to rest.

    Notes
    -----
    In every round, in both wires at once: elements are cut to the horizontal force that tensions and
    frictionless supports prescribe; the contact wire, held at the wanted heights, says what force each
    dropper must exert; droppers are cut to it in the present geometry; what is unbalanced moves the nodes.
    """
    system = LineSystem.of(line)
    y, unstressed = first_guess(system, start)
    bars, (lower, upper) = system.bars, system.parts(y)
    feet = WireSystem(system.contact.mesh, feet=system.target)
    q = system.contact.coordinates(lower)
    q[system.contact.mesh.clamp, 1] = system.target
    contact = _begin(WireShape(system.contact.mesh, q, system.contact.unstressed(lower)))
    top = system.messenger
    messenger = _begin(WireShape(top.mesh, top.coordinates(upper), top.unstressed(upper)))
    for rounds in range(1, _ROUNDS + 1):
        contact = _step(contact, feet, np.zeros_like(unstressed), stiffness)
        lift = contact.force[contact.shape.mesh.clamp, 1]
        unstressed = _cut_droppers(bars, contact.shape, messenger.shape, lift, unstressed)
        load = lift + bars.clamp_bottom + bars.weight * unstressed + bars.clamp_top
        messenger = _step(messenger, top, load, stiffness)
        if max(contact.moved, messenger.moved) < _ENOUGH:
            _refuse_other_tension(contact, messenger)
            how = f"{what} in {rounds} rounds"
            return Found(contact.shape, messenger.shape, bars, unstressed, how, rounds, 2 * rounds, 1)
    moved = max(contact.moved, messenger.moved)
    raise NotConvergedError(
        f"the geometry still moves by {moved:.3g} m a round after {_ROUNDS} rounds",
        "--start from the result of another method",
    )


def _refuse_other_tension(*courses: _Course) -> None:
    """Raise NotConvergedError where the device of a wire does not react with the prescribed tension."""
    for course in courses:
        mesh = course.shape.mesh
        reaction = float(np.linalg.norm(course.force[-1 if mesh.at_end else 0, :2]))
        if not abs(reaction - mesh.tension) < _TENSION:
            raise NotConvergedError(
                f"the {mesh.name} came to rest under {reaction:.6g} N instead of {mesh.tension:.6g} N",
                "more tension: the wire is too slack for its device",
            )


def _begin(shape: WireShape) -> _Course:
    return _Course(shape, shape.nodal_force, np.inf)


def _cut_droppers(
    bars: Bars, contact: WireShape, messenger: WireShape, lift: FloatArray, unstressed: FloatArray
) -> FloatArray:
    """Return the unstressed lengths with which droppers lift the contact wire by these forces."""
    length = messenger.q[messenger.mesh.clamp, 1] - contact.q[contact.mesh.clamp, 1]
    return bars.unstressed(length, lift + bars.clamp_bottom + 0.5 * bars.weight * unstressed)


def _step(course: _Course, system: WireSystem, load: FloatArray, stiffness: Stiffness) -> _Course:
    """Return the wire after one displacement by its unbalanced forces, cut to its prescribed ones again."""
    shape = _cut(course)
    mesh, force = shape.mesh, shape.nodal_force
    force[mesh.clamp, 1] += load
    free = system.free[
        np.searchsorted(system.free % 3, 1) :
    ]  # z and angles: places along the track are given
    K = _assembled(stiffness(shape.element_q, shape.unstressed, mesh.section), mesh.x.size)
    moved = -solve(K[free][:, free], force.reshape(-1)[free])
    if not np.max(np.abs(moved)) < _FAR:
        raise NotConvergedError(
            f"the geometry of the {mesh.name} runs away",
            "more tension; or --method 'adjusted lengths', or direct",
        )
    q = shape.q.copy()
    q.reshape(-1)[free] += moved
    shape = replace(shape, q=q)
    new = _Course(shape, shape.nodal_force, float(np.max(np.abs(moved))))
    cut = _cut(new)
    change = float(np.abs(cut.q[-1, 0] - q[-1, 0]))
    return _Course(cut, cut.nodal_force, max(new.moved, change))


def _cut(course: _Course) -> WireShape:
    """Return the wire with its ends pulled by what its length allows, and elements cut to their forces."""
    shape, mesh = course.shape, course.shape.mesh
    H = _horizontal(course)[mesh.segment]
    stretch = 1.0 + mesh.tension / mesh.section.EA
    further = 0.5 * (mesh.laid - float(np.sum(shape.unstressed))) * stretch
    knots = shape.q[mesh.knots, 0]
    knots[[0, -1]] += further * np.array([-1.0, 1.0])
    q = shape.q.copy()
    q[:, 0] = np.interp(mesh.x, mesh.x[mesh.knots], knots)
    element, lengths = np.hstack((q[:-1], q[1:])), shape.unstressed
    for _ in range(_CUTS):
        _, f_L = beam.tangent(element, lengths, mesh.section)
        lengths = lengths - (beam.force(element, lengths, mesh.section)[:, 3] - H) / f_L[:, 3]
    return WireShape(mesh, q, lengths)


def _horizontal(course: _Course) -> FloatArray:
    """Return the horizontal force of every segment [N].

    Notes
    -----
    The device's reaction T has the component sqrt(T^2 - V^2); a frictionless support that carries R_z takes
    R_x = -R_z tan(theta). On the way, forces of a geometry that is far off are cut down to half of T.
    """
    mesh, force = course.shape.mesh, course.force
    along = np.where(mesh.is_support, -force[mesh.joint, 1] * np.tan(course.shape.q[mesh.joint, 2]), 0.0)
    before = np.concatenate(([0.0], np.cumsum(-along)))  # H of a segment less that of the first one
    end, most = -1 if mesh.at_end else 0, _STEEPEST * mesh.tension
    V = np.clip(force[end, 1], -most, most)
    return np.maximum(np.sqrt(mesh.tension**2 - V**2) - before[end] + before, most)


def _assembled(K: FloatArray, nodes: int) -> Matrix:
    """Return the matrix of the whole wire."""
    own = 3 * np.arange(nodes - 1)[:, None] + np.arange(6)
    rows, columns = np.repeat(own[:, :, None], 6, axis=2), np.repeat(own[:, None, :], 6, axis=1)
    return matrix(K.ravel(), rows.ravel(), columns.ravel(), (3 * nodes, 3 * nodes))
