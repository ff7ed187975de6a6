"""Places along the track at which something hangs from a wire or holds it: guided clamps without droppers.

Where only the vertical force matters, a dropper is nothing but that force; what determines it, a wanted
height or a wanted force, is the equation of a target.
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
class HungPoints:
    r"""Vertical forces at given places along the track.

    Parameters
    ----------
    wire : Chain
        The wire on which they act.
    s : IntArray, shape (n,)
        Indices of the sliding coordinates [m].
    force : IntArray, shape (n,)
        Indices of the vertical forces la of the wire on what hangs there [N].
    element : IntArray, shape (n,)
        Element of the wire in which each point is: discrete state, changed by `relocate` only.
    x : FloatArray, shape (n,)
        Places along the track [m].

    Notes
    -----
    .. math:: x(s) = X, \qquad f \mathrel{+}= S(s)^T e_z\,\lambda.

    The equation belongs to s and exerts no force, as in `guided`, from which this differs by leaving out the
    dropper's end. The row of la is left to a target. The Jacobian is not symmetric.
    """

    wire: Chain
    s: IntArray
    force: IntArray
    element: IntArray
    x: FloatArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add x(s) - X and the forces to f."""
        z = state.z
        point = self.wire.evaluate(z, z[self.s], self.element)
        f[self.s] += point.r[:, 0] - self.x
        np.add.at(f, point.dofs[:, :, 2], point.N * z[self.force][:, None])

    def pattern(self) -> Pattern:
        """Return the entries of the equations' and forces' derivatives."""
        ends = (self.wire.nodes[self.element], self.wire.nodes[self.element + 1])
        dofs = np.concatenate(ends, axis=1).reshape(-1, 4, 3)
        s4, force4 = np.repeat(self.s[:, None], 4, axis=1), np.repeat(self.force[:, None], 4, axis=1)
        rows = (s4, self.s, dofs[:, :, 2], dofs[:, :, 2])
        columns = (dofs[:, :, 0], self.s, force4, s4)
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N, x', N and N' la at those entries."""
        z = state.z
        point = self.wire.evaluate(z, z[self.s], self.element)
        N = point.N.ravel()
        return np.concatenate((N, point.r1[:, 0], N, (point.N1 * z[self.force][:, None]).ravel()))

    def relocate(self, z: FloatArray) -> HungPoints | None:
        """Return the points in the elements that fit z, or None if all are."""
        element = self.wire.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
