"""The fixed joint (16) between two nodes: equal positions, parallel slopes of any length."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def normals(tangent: FloatArray) -> FloatArray:
    """Return two unit vectors normal to each tangent and to each other, shape (n, 2, 3).

    Raises
    ------
    InconsistentInputError
        If a tangent is zero.
    """
    length = np.linalg.norm(tangent, axis=1, keepdims=True)
    if np.any(length == 0.0):
        raise InconsistentInputError("a fixed joint needs nodes with non-zero slopes")
    tangent = np.asarray(tangent / length, dtype=np.float64)
    helper = np.eye(3)[np.argmin(np.abs(tangent), axis=1)]
    first: FloatArray = np.cross(tangent, helper)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second: FloatArray = np.cross(tangent, first)
    return np.stack((first, second), axis=1)


@dataclass(frozen=True)
class FixedJoints:
    r"""Joints between nodes i and j that keep r_i = r_j and r_i' parallel to r_j'.

    Parameters
    ----------
    nodes_i, nodes_j : IntArray, shape (n, 6)
        Indices of r and r' of the two nodes.
    multipliers : IntArray, shape (n, 5)
        Indices of three forces [N] and two moments per slope.
    e : FloatArray, shape (n, 2, 3)
        Two directions normal to the slope at the start, from `normals`.

    Notes
    -----
    The paper's last row, r_i' . r_j' - |r_i'| |r_j'| = 0, has a zero gradient wherever it holds, so it fixes
    nothing when linearised. We use the two independent components of r_i' x r_j' = 0,

    .. math:: e_k \cdot (r_i' \times r_j') = 0,\qquad k = 1, 2,

    which are independent unless the joint turns by a right angle from its start. Slopes may differ in length
    (a jump of the axial strain is allowed), as in the paper. Opposite slopes are parallel too: start with
    nodes that agree.
    """

    nodes_i: IntArray
    nodes_j: IntArray
    multipliers: IntArray
    e: FloatArray

    def _gradients(self, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return slopes' products: constraints (n, 2) and gradients by r_i' and r_j', both (n, 2, 3)."""
        a, b = z[self.nodes_i[:, 3:]][:, None, :], z[self.nodes_j[:, 3:]][:, None, :]
        by_a, by_b = np.cross(b, self.e), np.cross(self.e, a)
        return np.sum(by_a * a, axis=2), by_a, by_b

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints and constraint forces to f."""
        z = state.z
        parallel, by_a, by_b = self._gradients(z)
        force, moment = z[self.multipliers[:, :3]], z[self.multipliers[:, 3:]][:, :, None]
        f[self.multipliers[:, :3]] += z[self.nodes_i[:, :3]] - z[self.nodes_j[:, :3]]
        f[self.multipliers[:, 3:]] += parallel
        np.add.at(f, self.nodes_i, np.hstack((force, np.sum(moment * by_a, axis=1))))
        np.add.at(f, self.nodes_j, np.hstack((-force, np.sum(moment * by_b, axis=1))))

    def pattern(self) -> Pattern:
        """Return the entries of C_q, C_q^T and of the second derivatives of the two slope rows."""
        position, turn = self.multipliers[:, :3], self.multipliers[:, 3:]
        turn_rows = np.repeat(turn, 3, axis=1)
        a, b = self.nodes_i[:, 3:], self.nodes_j[:, 3:]
        pairs = [
            (position, self.nodes_i[:, :3]),
            (position, self.nodes_j[:, :3]),
            (turn_rows, np.tile(a, 2)),
            (turn_rows, np.tile(b, 2)),
        ]
        pairs += [(columns, rows) for rows, columns in pairs]
        pairs += [(np.repeat(a, 3, axis=1), np.tile(b, 3)), (np.repeat(b, 3, axis=1), np.tile(a, 3))]
        return (
            np.concatenate([rows.ravel() for rows, _ in pairs]),
            np.concatenate([columns.ravel() for _, columns in pairs]),
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return C_q, C_q^T and (C_q^T la)_q."""
        _, by_a, by_b = self._gradients(state.z)
        one = np.ones(self.multipliers.shape[0] * 3)
        first = np.concatenate((one, -one, by_a.ravel(), by_b.ravel()))
        axis = np.einsum("nk,nki->ni", state.z[self.multipliers[:, 3:]], self.e)
        # d/db (b x w) = -[w]x with w = sum la_k e_k, and d/da (w x a) = [w]x
        skew = np.zeros((axis.shape[0], 3, 3))
        skew[:, 0, 1], skew[:, 0, 2], skew[:, 1, 2] = -axis[:, 2], axis[:, 1], -axis[:, 0]
        skew -= skew.transpose(0, 2, 1)
        return np.concatenate((first, first, -skew.ravel(), skew.ravel()))
