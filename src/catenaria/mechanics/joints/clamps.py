"""Clamps: a material point of a wire held at a point of space."""

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
class Clamps:
    r"""Wires that are clamped to points of space, each at a given material coordinate.

    Parameters
    ----------
    carrier : Carrier
        The wires.
    s : IntArray, shape (n,)
        Indices of the material coordinates [m]; their rows belong to what gives them.
    multipliers : IntArray, shape (n, 3)
        Indices of the forces la of the wires on the clamps [N].
    element : IntArray, shape (n,)
        Element in which each clamp is: discrete state, changed by `relocate` only.
    X : FloatArray, shape (n, 3)
        Points of space [m].

    Notes
    -----
    .. math:: r(s) - X = 0, \qquad f \mathrel{+}= S(s)^T \lambda .

    The sliding joint (15) without its second line: the wire cannot slide, and the force has a component along
    it.
    """

    carrier: Carrier
    s: IntArray
    multipliers: IntArray
    element: IntArray
    X: FloatArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints and constraint forces to f."""
        z = state.z
        point = self.carrier.evaluate(z, z[self.s], self.element)
        f[self.multipliers] += point.r - self.X
        np.add.at(f, point.dofs, point.N[:, :, None] * z[self.multipliers][:, None, :])

    def pattern(self) -> Pattern:
        """Return the entries of C_q, C_s, C_q^T and of the forces' derivatives by s."""
        nodes = self.carrier.nodes
        dofs = np.concatenate((nodes[self.element], nodes[self.element + 1]), axis=1)
        la = np.tile(self.multipliers, 4)
        s3, s12 = np.repeat(self.s[:, None], 3, axis=1), np.repeat(self.s[:, None], 12, axis=1)
        rows, columns = (la, self.multipliers, dofs, dofs), (dofs, s3, la, s12)
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N, r', N and N' la at those entries."""
        z = state.z
        point = self.carrier.evaluate(z, z[self.s], self.element)
        N = np.repeat(point.N, 3, axis=1).ravel()
        mixed = (point.N1[:, :, None] * z[self.multipliers][:, None, :]).ravel()
        return np.concatenate((N, point.r1.ravel(), N, mixed))

    def relocate(self, z: FloatArray) -> Clamps | None:
        """Return the clamps in the elements that fit z, or None if all are."""
        element = self.carrier.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
