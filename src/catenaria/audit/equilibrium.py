"""Balance of every node, of every free body between joints, of whole wires, of droppers and of the line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.energy import weight
from catenaria.audit.free_wire import Along, FreeWire
from catenaria.audit.stated import Stated, StatedDroppers
from catenaria.audit.verdict import Check
from catenaria.results.form import Droppers

FloatArray = NDArray[np.float64]

_GROUP = "equilibrium"


def node_check(wires: Sequence[FreeWire]) -> Check:
    """Return the balance of every node: energy against weight, supports, droppers and devices."""
    off = [np.max(_in_newtons(wire), axis=1) for wire in wires]
    allowed = [np.full(wire.curve.s.size, wire.force_tolerance) for wire in wires]
    place = Along(wires, [wire.curve.s for wire in wires])
    return Check(_GROUP, "residual of nodes", "N", np.concatenate(off), np.concatenate(allowed), place)


def wire_checks(wire: FreeWire, guided: bool) -> Iterator[Check]:
    """Yield the checks of one wire's equilibrium; droppers are `guided` or slide without friction."""
    name = wire.stated.name
    yield from balance_checks(wire)
    supports = wire.support_s.size
    yield _along(wire, slice(0, supports), f"{name}, force of supports along the wire", sliding=True)
    label = f"{name}, force of droppers along the {'track' if guided else 'wire'}"
    yield _along(wire, slice(supports, -2), label, sliding=not guided)


def balance_checks(wire: FreeWire) -> Iterator[Check]:
    """Yield the balance of a wire at its ends, of its pieces between joints, and as a whole."""
    tolerance, name = wire.force_tolerance, wire.stated.name
    yield _stiffness(wire)
    for what, cuts in (("joints", slice(0, -2)), ("supports", slice(0, wire.support_s.size))):
        names, off = _bodies(wire, wire.joint_s[cuts], wire.joint_name[cuts])
        label = f"{name}, force and moment between {what}"
        yield Check(_GROUP, label, "N", off, np.full(off.size, tolerance), names)
    whole = np.array([in_balance(*outer_forces(wire, wire.joint_force))])
    yield Check(_GROUP, f"{name} as a whole", "N", whole, np.array([tolerance]), ("all its joints",))


def dropper_checks(
    droppers: Droppers, stated: StatedDroppers, gravity: float, allowed: FloatArray, tolerance: float
) -> Iterator[Check]:
    """Yield the balance of every dropper, eq. (23), and whether the table says the same as the forces.

    Parameters
    ----------
    droppers, stated, gravity
        What was found and what was asked for.
    allowed : FloatArray, shape (n,)
        Vertical force that the method may leave unbalanced [N].
    tolerance : float
        Force that may be missing to any other balance [N].
    """
    names = tuple(f"dropper {i + 1}" for i in range(droppers.x.size))
    none = np.full(droppers.x.size, tolerance)
    off = droppers.on_contact + droppers.on_messenger
    vertical = np.abs(off[:, 2] + dropper_weight(droppers, stated, gravity))
    yield Check(_GROUP, "droppers, vertical forces and weight (23)", "N", vertical, allowed, names)
    if stated.guided:
        sideways = np.linalg.norm(off[:, :2], axis=1)
        yield Check(_GROUP, "droppers, horizontal forces", "N", sideways, none, names)
    for end, column, force in (
        ("bottom", droppers.force_bottom, droppers.on_contact[:, 2]),
        ("top", droppers.force_top, -droppers.on_messenger[:, 2]),
    ):
        yield Check(_GROUP, f"droppers, stated force at the {end}", "N", np.abs(column - force), none, names)


def line_check(
    wires: tuple[FreeWire, FreeWire], droppers: Droppers, stated: Stated, allowed: FloatArray
) -> Check:
    """Return the balance of the whole line: reactions of supports and devices against all weight.

    Notes
    -----
    Droppers are inner forces here, their weight is a load; what a method may leave unbalanced in each of them
    adds up in `allowed`. Frictionless droppers (15) hang askew and are held along the track by what no
    support takes, so that their line balances vertically only.
    """
    points: list[FloatArray] = []
    forces: list[FloatArray] = []
    for wire in wires:
        outer = wire.joint_force.copy()
        outer[wire.support_s.size : -2] = 0.0
        arms, loads, _ = outer_forces(wire, outer)
        points.append(arms + centre(wire))
        forces.append(loads)
    pull = np.zeros((droppers.x.size, 3))
    pull[:, 2] = -dropper_weight(droppers, stated.droppers, stated.gravity)
    points.append(np.column_stack((droppers.x, np.zeros_like(droppers.x), droppers.height)))
    forces.append(pull)
    r, force = np.concatenate(points), np.concatenate(forces)
    tolerance = np.array([np.sum(allowed) + sum(wire.force_tolerance for wire in wires)])
    if not stated.droppers.guided:
        up = np.abs(np.sum(force[:, 2:], axis=0))
        return Check(_GROUP, "the line, vertical forces", "N", up, tolerance, ("all reactions and weights",))
    middle = 0.5 * (r.min(axis=0) + r.max(axis=0))
    off = np.array([in_balance(r - middle, force, 0.5 * float(np.ptp(r[:, 0])))])
    return Check(_GROUP, "the line as a whole", "N", off, tolerance, ("all reactions and weights",))


def dropper_weight(droppers: Droppers, stated: StatedDroppers, gravity: float) -> FloatArray:
    """Return the weights of droppers with their clamps [N], from unstressed lengths."""
    mass = stated.conductor.rhoA * droppers.unstressed_length + stated.mass_top + stated.mass_bottom
    return gravity * mass


def _in_newtons(wire: FreeWire) -> FloatArray:
    """Return sizes of forces, and of moments over the length of the neighbouring elements, shape (n, 2)."""
    L = wire.curve.L
    reach = np.concatenate((L[:1], 0.5 * (L[:-1] + L[1:]), L[-1:]))
    size = np.linalg.norm(wire.residual, axis=2)
    return np.column_stack((size[:, 0], size[:, 1] / reach))


def _stiffness(wire: FreeWire) -> Check:
    """Return whether strain times EA at the wire's ends is what the devices pull with, in the weak sense.

    The end node of a wire balances the strain of one element against the device: the first place where a
    wrong modulus or area shows, and the one that says so.
    """
    kind = wire.stated.conductor
    off = np.linalg.norm(wire.residual[[0, -1], 0], axis=1)
    label = f"{wire.stated.name}, strain times EA ({kind.EA:.4g} N of '{kind.name}') against the pull"
    return Check(_GROUP, label, "N", off, np.full(2, wire.force_tolerance), wire.joint_name[-2:])


def _bodies(wire: FreeWire, s: FloatArray, names: tuple[str, ...]) -> tuple[tuple[str, ...], FloatArray]:
    """Return the pieces of wire between cuts, and what is missing to their balance as rigid bodies [N].

    Residuals tested with the rigid motions of a piece: inner forces do no work and drop out, what the cut
    elements carry is the section force in the weak sense. A rotation moves r like an arm from the middle of
    the piece and r' like r' itself; moments are told as forces at the ends of the piece.
    """
    curve, order = wire.curve, np.argsort(s, kind="stable")
    knots = np.concatenate((curve.s[:1], s[order], curve.s[-1:]))
    nodes = np.concatenate(([0], np.searchsorted(curve.s, s[order]), [curve.s.size]))
    bodies = np.flatnonzero(np.diff(nodes))
    first, count = nodes[bodies], np.diff(nodes)[bodies]
    middle = 0.5 * (curve.r[first] + curve.r[first + count - 1])
    on_r, on_r1 = wire.residual[:, 0], wire.residual[:, 1]
    turning = np.cross(curve.r - np.repeat(middle, count, axis=0), on_r) + np.cross(curve.r1, on_r1)
    force, moment = (np.linalg.norm(np.add.reduceat(on, first), axis=1) for on in (on_r, turning))
    cuts: list[int] = order.tolist()
    ends = ("its start", *(names[i] for i in cuts), "its end")
    places = tuple(f"{ends[i]} to {ends[i + 1]}" for i in bodies.tolist())
    return places, np.maximum(force, moment / np.diff(knots)[bodies])


def centre(wire: FreeWire) -> FloatArray:
    """Return the middle between the ends of a wire [m]."""
    return 0.5 * (wire.curve.r[0] + wire.curve.r[-1])


def outer_forces(wire: FreeWire, joint_force: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return arms from the middle, forces of joints and weight without any energy, and half the length.

    Weight acts at the first moments of its elements, which its generalised forces hold exactly: on r_i and
    r_j directly, and through r' as a couple; both as forces at points that have the same resultant.
    """
    load = weight(wire.curve, wire.stated.conductor.rhoA, wire.gravity)
    total = load[:, 0] + load[:, 2]
    q = wire.curve.q - np.array([1.0, 0.0, 1.0, 0.0])[:, None] * centre(wire)
    point = np.einsum("ek,eki->ei", load[:, :, 2] / total[:, 2:], q)
    arms = np.concatenate((wire.curve.at(wire.joint_s).r - centre(wire), point))
    forces = np.concatenate((joint_force, total))
    return arms, forces, 0.5 * float(np.linalg.norm(wire.curve.r[-1] - wire.curve.r[0]))


def in_balance(arms: FloatArray, forces: FloatArray, reach: float) -> float:
    """Return the larger of resultant force and resultant moment over `reach` [N]."""
    force, moment = forces.sum(axis=0), np.cross(arms, forces).sum(axis=0)
    return max(float(np.linalg.norm(force)), float(np.linalg.norm(moment)) / reach)


def _along(wire: FreeWire, joints: slice, label: str, *, sliding: bool) -> Check:
    """Return the force that a joint must not exert: along the wire if it slides, else along the track."""
    force = wire.joint_force[joints]
    if sliding:
        r1 = wire.curve.at(wire.joint_s[joints]).r1
        size = np.abs(np.einsum("ni,ni->n", force, r1)) / np.linalg.norm(r1, axis=1)
    else:
        size = np.abs(force[:, 0])
    return Check(_GROUP, label, "N", size, np.full(size.size, wire.force_tolerance), wire.joint_name[joints])
