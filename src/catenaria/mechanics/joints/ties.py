"""Ends of wires tied to other wires: stitch wires and mid-point anchors."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.carrier import Carrier
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Ties:
    r"""Nodes that coincide with points of other wires, to which all of their force passes.

    Parameters
    ----------
    nodes : IntArray, shape (n, 3)
        Indices of the positions of the tied wires' end nodes.
    host : Carrier
        The wires to which they are tied.
    s : IntArray, shape (n,)
        Indices of the material coordinates of the ties on their hosts [m]; their rows belong to whatever
        else says where the ties are.
    element : IntArray, shape (n,)
        Element of the host in which each tie is: discrete state, changed by `relocate` only.
    multipliers : IntArray, shape (n, 3)
        Indices of la, the force of the tied wire's end on the host [N].

    Notes
    -----
    .. math:: r_n - r(s) = 0,\qquad \text{row } r_n:\ \lambda,\qquad \text{row } q_k:\ -N_k\lambda.

    Forces are opposite and act at one point, so that both balance in any position. Directions are free: a tie
    is a hinge.
    """

    nodes: IntArray
    host: Carrier
    s: IntArray
    element: IntArray
    multipliers: IntArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints and constraint forces to f."""
        z = state.z
        point, la = self.host.evaluate(z, z[self.s], self.element), z[self.multipliers]
        f[self.multipliers] += z[self.nodes] - point.r
        np.add.at(f, self.nodes, la)
        np.subtract.at(f, point.dofs, point.N[:, :, None] * la[:, None, :])

    def pattern(self) -> Pattern:
        """Return the entries of the constraints' and forces' derivatives."""
        dofs = np.concatenate((self.host.nodes[self.element], self.host.nodes[self.element + 1]), axis=1)
        la = np.tile(self.multipliers, 4)
        s3, s12 = np.repeat(self.s[:, None], 3, axis=1), np.repeat(self.s[:, None], 12, axis=1)
        rows = (self.multipliers, self.nodes, la, dofs, self.multipliers, dofs)
        columns = (self.nodes, self.multipliers, dofs, la, s3, s12)
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return 1, -N, -r' and -N' la at those entries."""
        z = state.z
        point, la = self.host.evaluate(z, z[self.s], self.element), z[self.multipliers]
        N = np.repeat(point.N, 3, axis=1).ravel()
        mixed = (point.N1[:, :, None] * la[:, None, :]).ravel()
        return np.concatenate((np.ones(2 * self.nodes.size), -N, -N, -point.r1.ravel(), -mixed))

    def relocate(self, z: FloatArray) -> Ties | None:
        """Return the ties in the elements that fit z, or None if all are."""
        element = self.host.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
