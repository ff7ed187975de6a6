"""Straight elements with lumped weight: how wires are divided, and how bays are read from elements."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.formfinding.strings.bays import Bays
from catenaria.formfinding.strings.task import Joints, StringLine, StringWire

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class Net(NamedTuple):
    """Nodes of a wire: places, which of them are joints, and the elements' lengths along the track."""

    x: FloatArray
    joint: IntArray
    dx: FloatArray

    @classmethod
    def of(cls, joints: Joints, largest: float) -> Net:
        """Divide every bay evenly into elements that are not longer than `largest` [m]."""
        h = np.diff(joints.x)
        count = np.ceil(h / largest).astype(np.int64)
        joint = np.append(0, np.cumsum(count))
        number = np.arange(joint[-1] + 1, dtype=np.float64)
        x = np.interp(number, joint.astype(np.float64), joints.x)
        return cls(x, joint, np.repeat(h / count, count))

    def unstressed(self, wire: StringWire, z: FloatArray, H: FloatArray) -> FloatArray:
        """Return the unstressed lengths of elements [m], given heights and forces along the track.

        The arc of an element is longer than its chord by (W/H)^2/24.
        """
        length = np.hypot(self.dx, np.diff(z))
        chord = length / stretch(H * length / self.dx, wire.EA)
        return chord * (1.0 + (wire.w * chord / H) ** 2 / 24.0)

    def bays(self, wire: StringWire, z: FloatArray, H: FloatArray, L: FloatArray) -> Bays:
        """Return bays from elements, half the weight of which was at each of their ends."""
        first = self.joint[:-1]
        V = H * np.diff(z) / self.dx - 0.5 * wire.w * L
        return Bays(z[self.joint], H[first], V[first], np.add.reduceat(L, first))


class Part(NamedTuple):
    """A wire among the nodes and branches of a whole line."""

    wire: StringWire
    joints: Joints
    net: Net
    nodes: slice
    edges: slice


class Division(NamedTuple):
    """Both wires of a line with their nodes and branches numbered, the contact wire's first.

    Attributes
    ----------
    parts : tuple of Part
        The contact wire and the messenger.
    start : IntArray, shape (n_branches,)
        First node of every branch of the wires; the second one is the next.
    foot, top : IntArray, shape (n,)
        Nodes at which droppers are clamped to contact wire and messenger.
    held : IntArray, shape (m,)
        Nodes at supports.
    node_count : int
        Number of nodes.
    """

    parts: tuple[Part, Part]
    start: IntArray
    foot: IntArray
    top: IntArray
    held: IntArray
    node_count: int

    @classmethod
    def of(cls, task: StringLine, largest: float) -> Division:
        """Divide both wires into elements that are not longer than `largest` [m]."""
        parts: list[Part] = []
        node = edge = 0
        for wire in (task.contact, task.messenger):
            joints = wire.joints(task.x)
            net = Net.of(joints, largest)
            n = net.x.size
            parts.append(Part(wire, joints, net, slice(node, node + n), slice(edge, edge + n - 1)))
            node, edge = node + n, edge + n - 1
        foot, top = (part.nodes.start + part.net.joint[part.joints.clamp] for part in parts)
        held = np.concatenate([part.nodes.start + part.net.joint[part.joints.support] for part in parts])
        start = np.concatenate([np.arange(p.nodes.start, p.nodes.stop - 1, dtype=np.int64) for p in parts])
        return cls((parts[0], parts[1]), start, foot, top, held, node)
