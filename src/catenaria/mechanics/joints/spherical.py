"""Spherical joints (hinges) between two nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class SphericalJoints:
    """Two nodes at one place with free directions: C = r_i - r_j = 0.

    Parameters
    ----------
    nodes_i, nodes_j : IntArray, shape (n, 3)
        Indices of the two nodes' positions.
    multipliers : IntArray, shape (n, 3)
        Indices of the multipliers: the force of node i on node j [N].
    """

    nodes_i: IntArray
    nodes_j: IntArray
    multipliers: IntArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints and constraint forces to f."""
        z = state.z
        f[self.multipliers] += z[self.nodes_i] - z[self.nodes_j]
        np.add.at(f, self.nodes_i, z[self.multipliers])
        np.add.at(f, self.nodes_j, -z[self.multipliers])

    def pattern(self) -> Pattern:
        """Return the entries of C_q and C_q^T."""
        rows = (self.multipliers, self.multipliers, self.nodes_i, self.nodes_j)
        columns = (self.nodes_i, self.nodes_j, self.multipliers, self.multipliers)
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return the constant entries 1 and -1."""
        one = np.ones(self.nodes_i.size)
        return np.concatenate((one, -one, one, -one))
