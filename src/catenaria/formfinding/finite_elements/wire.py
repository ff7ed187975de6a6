"""A wire of a line as a chain of beam elements: its mesh, its joints, its prescribed tension."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import Grading, graded_knots
from catenaria.errors import UnsupportedError
from catenaria.formfinding.finite_elements.beam import Section
from catenaria.line import Line, Wire

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True)
class WireMesh:
    """Nodes along the track, and which of them are joints.

    Attributes
    ----------
    name : str
        ``contact wire`` or ``messenger wire``.
    section : Section
        Cross-section and weight.
    origin : float
        Chainage from which places are counted, because numbers near zero have more digits [m].
    x : FloatArray, shape (n_nodes,)
        Where the nodes stand when the wire is laid out straight over its supports, and joints always [m].
    joint : IntArray, shape (n_joints,)
        Nodes at supports and clamps, ascending.
    is_support : BoolArray, shape (n_joints,)
        Which joints are supports.
    height : float
        Height of supports and ends [m].
    tail : float
        How far the laid-out wire runs on beyond its first and last support [m].
    tension : float
        Prescribed reaction of the device at the wire's end [N].
    at_end : bool
        Whether it is measured at the end instead of the start.
    """

    name: str
    section: Section
    origin: float
    x: FloatArray
    joint: IntArray
    is_support: BoolArray
    height: float
    tail: float
    tension: float
    at_end: bool

    @property
    def support(self) -> IntArray:
        """Nodes at supports."""
        return self.joint[self.is_support]

    @property
    def clamp(self) -> IntArray:
        """Nodes at droppers."""
        return self.joint[~self.is_support]

    @cached_property
    def knots(self) -> IntArray:
        """First node, joints, last node: where the segments of the wire end."""
        return np.concatenate(([0], self.joint, [self.x.size - 1]))

    @cached_property
    def segment(self) -> IntArray:
        """Segment of every element, shape (n_nodes - 1,)."""
        return np.searchsorted(self.knots, np.arange(self.x.size - 1), side="right") - 1

    @cached_property
    def fraction(self) -> FloatArray:
        """Share of every element in the unstressed length of its segment."""
        return np.diff(self.x) / np.diff(self.x[self.knots])[self.segment]

    @property
    def laid(self) -> float:
        """Unstressed length of the whole wire [m]."""
        first, last = self.x[self.support[[0, -1]]]
        return float(last - first) + 2.0 * self.tail


def contact_mesh(line: Line) -> WireMesh:
    """Return the contact wire of a line."""
    held = [line.supports[i].contact_wire for i in line.contact_support_indices]
    height = held[0].height if held[0] is not None else 0.0
    x = np.array(line.support_x)[list(line.contact_support_indices)]
    return _mesh(line, "contact wire", line.contact_wire, x, height)


def messenger_mesh(line: Line) -> WireMesh:
    """Return the messenger wire of a line."""
    x = np.array(line.support_x)
    return _mesh(line, "messenger wire", line.messenger_wire, x, line.supports[0].messenger_height)


def refuse_beyond_core(line: Line, method: str) -> None:
    """Refuse by name what the finite elements of this package cannot do.

    Raises
    ------
    UnsupportedError
        For droppers that slide along the wire, tensions measured by strain, and meshes without joints.
    """
    reasons: list[str] = []
    if line.dropper.joint != "guided":
        reasons.append(f"dropper.joint: {line.dropper.joint} (its clamps stay in place along the track)")
    for field, wire in (("contact_wire", line.contact_wire), ("messenger_wire", line.messenger_wire)):
        if wire.tension.measure != "reaction":
            reasons.append(f"{field}.tension.measure: {wire.tension.measure} (its measure is the reaction)")
    if line.solver.mesh.even is not None:
        reasons.append("solver.mesh.even (its nodes stand at the joints)")
    if reasons:
        raise UnsupportedError(f"the method {method!r} does not do {'; '.join(reasons)}")


def _mesh(line: Line, name: str, wire: Wire, support_x: FloatArray, height: float) -> WireMesh:
    mesh, kind = line.solver.mesh, line.conductor(wire.conductor)
    origin = line.start_chainage
    support_x, clamp_x = support_x - origin, np.array(line.dropper_x) - origin
    joint_x = np.concatenate((support_x, clamp_x))
    order = np.argsort(joint_x, kind="stable")
    start, end = support_x[0] - wire.tail, support_x[-1] + wire.tail
    grading = Grading(tuple(mesh.fine), mesh.largest_element, mesh.refine)
    x = start + graded_knots(end - start, joint_x - start, grading)
    joint = np.searchsorted(x, joint_x[order] - 1e-9)
    x[joint] = joint_x[order]
    return WireMesh(
        name=name,
        section=Section(kind.EA, kind.EJ, kind.rhoA * line.gravity),
        origin=origin,
        x=x,
        joint=joint,
        is_support=order < support_x.size,
        height=height,
        tail=wire.tail,
        tension=wire.tension.force,
        at_end=wire.tension.at == "end",
    )
