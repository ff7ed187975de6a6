"""The guided dropper joint: the clamp keeps its place along the track, its force is normal to it.

This is what is built in the end: a dropper that hangs in its plane x = X, clamped to whichever point of the
wire is there. The paper's "immovably placed along the track" describes it; the frictionless joint (15) would
let the dropper hang normal to the wire instead.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.chain import Chain
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class GuidedJoints:
    r"""Joints of one wire with dropper ends that are held along the track.

    Parameters
    ----------
    wire : Chain
        The wire that runs through the clamps.
    s : IntArray, shape (n,)
        Indices of the sliding coordinates [m].
    multipliers : IntArray, shape (n, 3)
        Indices of (la_x, la_y, la_z) [N]: the force of the guide on the track from the dropper's end, and the
        force of the wire on the dropper in y and z.
    element : IntArray, shape (n,)
        Element of the wire in which each joint is: discrete state, changed by `relocate` only.
    x : FloatArray, shape (n,)
        Positions along the track [m].
    nodes : IntArray, shape (n, 3)
        Indices of the positions of the droppers' ends.

    Notes
    -----
    .. math:: x(s) = X,\qquad x_d = X,\qquad y(s) = y_d,\qquad z(s) = z_d.

    The first equation belongs to s and exerts no force on the wire; the second holds the dropper by la_x; the
    others tie wire and dropper by la_y, la_z. The force on the wire has no component along the track, so its
    tension may jump by la_z times its slope, as under a real clamp. The Jacobian is not symmetric.
    """

    wire: Chain
    s: IntArray
    multipliers: IntArray
    element: IntArray
    x: FloatArray
    nodes: IntArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints and constraint forces to f."""
        z = state.z
        point = self.wire.evaluate(z, z[self.s], self.element)
        la, end = z[self.multipliers], z[self.nodes]
        f[self.s] += point.r[:, 0] - self.x
        f[self.multipliers[:, 0]] += end[:, 0] - self.x
        f[self.multipliers[:, 1:]] += point.r[:, 1:] - end[:, 1:]
        np.add.at(f, point.dofs[:, :, 1:], point.N[:, :, None] * la[:, None, 1:])
        np.add.at(f, self.nodes, la * _ON_DROPPER)

    def pattern(self) -> Pattern:
        """Return the entries of the constraints' and forces' derivatives."""
        dofs = self._wire_dofs()
        x_dofs, yz_dofs = dofs[:, :, 0], dofs[:, :, 1:]
        la_yz = np.repeat(self.multipliers[:, None, 1:], 4, axis=1)
        s4 = np.repeat(self.s[:, None], 4, axis=1)
        s2 = np.repeat(self.s[:, None], 2, axis=1)
        s42 = np.repeat(s4[:, :, None], 2, axis=2)
        rows = (s4, self.s, la_yz, self.multipliers[:, 1:], yz_dofs, yz_dofs, self.multipliers, self.nodes)
        columns = (x_dofs, self.s, yz_dofs, s2, la_yz, s42, self.nodes, self.multipliers)
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N, r', N' la and the droppers' signs at those entries."""
        z = state.z
        point = self.wire.evaluate(z, z[self.s], self.element)
        la = z[self.multipliers]
        N_yz = np.repeat(point.N, 2, axis=1).ravel()
        mixed = (point.N1[:, :, None] * la[:, None, 1:]).ravel()
        signs = np.tile(_ON_DROPPER, self.s.size)
        r1 = point.r1
        parts = (point.N.ravel(), r1[:, 0], N_yz, r1[:, 1:].ravel(), N_yz, mixed, signs, signs)
        return np.concatenate(parts)

    def _wire_dofs(self) -> IntArray:
        ends = (self.wire.nodes[self.element], self.wire.nodes[self.element + 1])
        return np.concatenate(ends, axis=1).reshape(-1, 4, 3)

    def relocate(self, z: FloatArray) -> GuidedJoints | None:
        """Return the joints in the elements that fit z, or None if all are."""
        element = self.wire.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)


_ON_DROPPER = np.array(
    [1.0, -1.0, -1.0]
)  # the guide holds the dropper's end by la_x, the wire pulls by la_y, la_z
