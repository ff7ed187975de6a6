"""The sliding joint (15): a wire runs without friction through a point of space or a node."""

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
class SlidingJoints:
    r"""Frictionless joints of one wire with points or nodes; the sliding coordinate s is an unknown.

    Parameters
    ----------
    wire : Chain
        The wire that slides.
    s : IntArray, shape (n,)
        Indices of the sliding coordinates: material coordinates of the wire at the joints [m].
    multipliers : IntArray, shape (n, 3)
        Indices of the multipliers la: the force of the wire on what it slides through [N].
    element : IntArray, shape (n,)
        Element of the wire in which each joint is: discrete state, changed by `relocate` only.
    X : FloatArray, shape (n, 3)
        Points of space [m]; used where there is no node.
    nodes : IntArray or None, shape (n, 3)
        Indices of the positions of the nodes that the wire slides through, None for points of space.

    Notes
    -----
    .. math:: C = r(s) - r_j = 0,\qquad C_s^T\lambda = \lambda\cdot r'(s) = 0.

    The second line says that the force has no component along the wire: three constraints and one more
    unknown take away two degrees of freedom, as the paper says. Within a solve each joint stays in its
    element, whose polynomial is continued beyond the element's ends if need be; when the solve has converged,
    `relocate` changes elements and the solve goes on: right for time steps, in which a joint moves by less
    than a few elements; a solver that moves it far must relocate after every iteration. Wires share r and r'
    between elements, so r(s) and r'(s) are continuous.
    """

    wire: Chain
    s: IntArray
    multipliers: IntArray
    element: IntArray
    X: FloatArray
    nodes: IntArray | None = None

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints, sliding conditions and constraint forces to f."""
        z = state.z
        point = self.wire.evaluate(z, z[self.s], self.element)
        la = z[self.multipliers]
        f[self.multipliers] += point.r - (self.X if self.nodes is None else z[self.nodes])
        f[self.s] += np.einsum("ni,ni->n", la, point.r1)
        np.add.at(f, point.dofs, point.N[:, :, None] * la[:, None, :])
        if self.nodes is not None:
            np.subtract.at(f, self.nodes, la)

    def _wire_dofs(self) -> IntArray:
        return np.concatenate((self.wire.nodes[self.element], self.wire.nodes[self.element + 1]), axis=1)

    def pattern(self) -> Pattern:
        """Return the entries of C_q, C_s, of their transposes and of the second derivatives."""
        dofs, la = self._wire_dofs(), np.tile(self.multipliers, 4)
        s3, s12 = np.repeat(self.s[:, None], 3, axis=1), np.repeat(self.s[:, None], 12, axis=1)
        rows = [la, dofs, self.multipliers, s3, dofs, s12, self.s]
        columns = [dofs, la, s3, self.multipliers, s12, dofs, self.s]
        if self.nodes is not None:
            rows += [self.multipliers, self.nodes]
            columns += [self.nodes, self.multipliers]
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N, r', N' la and la . r'' at those entries."""
        z = state.z
        point = self.wire.evaluate(z, z[self.s], self.element)
        la = z[self.multipliers]
        N = np.repeat(point.N, 3, axis=1).ravel()
        mixed = (point.N1[:, :, None] * la[:, None, :]).ravel()
        parts = [N, N, point.r1.ravel(), point.r1.ravel(), mixed, mixed, np.einsum("ni,ni->n", la, point.r2)]
        if self.nodes is not None:
            parts.append(np.full(2 * self.nodes.size, -1.0))
        return np.concatenate(parts)

    def relocate(self, z: FloatArray) -> SlidingJoints | None:
        """Return the joints in the elements that fit z, or None if all are (see `Chain.relocate`)."""
        element = self.wire.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
