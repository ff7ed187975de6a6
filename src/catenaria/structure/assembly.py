"""From the description of a joint to its unknowns and its contributions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.chain import Chain
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.joints.fixed import FixedJoints, normals
from catenaria.mechanics.joints.guided import GuidedJoints
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.joints.spherical import SphericalJoints
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder
from catenaria.structure.joint import Attachment, Joint

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Chains = Mapping[str, Chain]

_NOTHING = np.empty(0, dtype=np.int64)


@dataclass(frozen=True)
class JointNumbers:
    """A joint and where it is in the unknowns.

    Attributes
    ----------
    name, joint
        Its name and description.
    wire : Chain
        The cable `on` which it is.
    force : IntArray, shape (3,)
        Multipliers: force of the cable `on` on what it is joined to. Guided: la_x is the force of the guide.
    moment : IntArray, shape (2,) or (0,)
        Multipliers of the slopes of a fixed joint.
    s : IntArray, shape (1,) or (0,)
        Sliding coordinate.
    ground : IntArray, shape (12,) or (0,)
        Position and slope of the ground node that a fixed joint to the ground needs, and what holds them.
    """

    name: str
    joint: Joint
    wire: Chain
    force: IntArray
    moment: IntArray
    s: IntArray
    ground: IntArray

    @classmethod
    def of(cls, name: str, joint: Joint, chains: Chains, unknowns: UnknownsBuilder) -> JointNumbers:
        """Number the unknowns of a joint."""
        wire = chains[joint.on.cable]
        moment, s, ground = _NOTHING, _NOTHING, _NOTHING
        if joint.slides:
            s = unknowns.add(Kind.SLIDING, [joint.on.coordinate(float(wire.knots[-1]))])
        if joint.type == "fixed":
            moment = unknowns.add(Kind.MULTIPLIER, np.zeros(2))
            if joint.to is None:
                node = unknowns.add_node(np.zeros(3), np.zeros(3))  # its place is known when all are numbered
                ground = np.concatenate((node, unknowns.add(Kind.MULTIPLIER, np.zeros(6))))
        return cls(name, joint, wire, unknowns.add(Kind.MULTIPLIER, np.zeros(3)), moment, s, ground)

    def point(self, z: FloatArray) -> FloatArray:
        """Return where the joint is [m], shape (3,)."""
        return self.wire.evaluate(z, self.coordinate(z)).r[0]

    def coordinate(self, z: FloatArray) -> FloatArray:
        """Return the material coordinate of the cable `on` at the joint [m], shape (1,)."""
        if self.s.size:
            return z[self.s]
        return np.array([self.joint.on.coordinate(float(self.wire.knots[-1]))])


def node_of(chains: Chains, point: Attachment) -> IntArray:
    """Return the indices of position and slope of the node at a point of a cable, shape (6,)."""
    chain = chains[point.cable]
    return chain.nodes[np.argmin(np.abs(chain.knots - point.coordinate(float(chain.knots[-1]))))]


def joint_contributions(at: JointNumbers, chains: Chains, z: FloatArray) -> tuple[Contribution, ...]:
    """Return what a joint adds to a system whose starting values are z; held points are added by `hold`."""
    joint, force = at.joint, at.force[None, :]
    to = None if joint.to is None else node_of(chains, joint.to)[None, :]
    if joint.slides:
        element = at.wire.locate(z[at.s])
        if joint.type == "guided" and to is not None:
            return (GuidedJoints(at.wire, at.s, force, element, z[to[:, 0]], to[:, :3]),)
        nodes = None if to is None else to[:, :3]
        return (SlidingJoints(at.wire, at.s, force, element, at.point(z)[None, :], nodes),)
    node = node_of(chains, joint.on)[None, :]
    if joint.type == "spherical":
        return () if to is None else (SphericalJoints(node[:, :3], to[:, :3], force),)
    multipliers = np.concatenate((at.force, at.moment))[None, :]
    e = normals(z[node[:, 3:]])
    if to is not None:
        return (FixedJoints(node, to, multipliers, e),)
    ground = at.ground[None, :6]
    held = HeldPoints(
        ground.reshape(2, 3), at.ground[6:].reshape(2, 3), z[node].reshape(2, 3), np.zeros((2, 3)), _fixed(2)
    )
    return FixedJoints(node, ground, multipliers, e), held


def hold(
    joints: tuple[JointNumbers, ...],
    chains: Chains,
    z: FloatArray,
    moves: Mapping[str, tuple[int, FloatArray]],
) -> HeldPoints:
    """Return the held points, some of which a parameter moves.

    Parameters
    ----------
    joints, chains, z
        All joints, all cables, starting values.
    moves : mapping
        Index of the parameter and unit vector for each held point that a control moves, by name.
    """
    held = [at for at in joints if at.joint.is_held_point]
    nodes = np.array([node_of(chains, at.joint.on)[:3] for at in held], dtype=np.int64).reshape(-1, 3)
    multipliers = np.array([at.force for at in held], dtype=np.int64).reshape(-1, 3)
    parameter, direction = _fixed(len(held)), np.zeros((len(held), 3))
    for i, at in enumerate(held):
        if at.name in moves:
            parameter[i], direction[i] = moves[at.name]
    return HeldPoints(nodes, multipliers, z[nodes], direction, parameter)


def _fixed(count: int) -> IntArray:
    return np.full(count, -1, dtype=np.int64)
