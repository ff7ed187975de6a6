"""Nodes held at points that a control parameter may move: hinges, and driven ends, (20), (22)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class HeldPoints:
    """Spherical joints between nodes and points X + p n of space (section 4.2, and the paper's wire ends).

    Parameters
    ----------
    nodes : IntArray, shape (n, 3)
        Indices of the nodes' positions.
    multipliers : IntArray, shape (n, 3)
        Indices of the multipliers la: the force of the node on what holds it [N].
    X : FloatArray, shape (n, 3)
        Points at p = 0 [m].
    direction : FloatArray, shape (n, 3)
        Unit vectors n along which the parameters move the points; anything where there is no parameter.
    parameter : IntArray, shape (n,)
        Index of each point's control parameter, -1 where the point is fixed. Points may share a parameter.

    Notes
    -----
    C = r - X - p n = 0. Its time derivative is the paper's nonholonomic constraint (20), r' = v_c n with p' =
    v_c; at position level it cannot drift.
    """

    nodes: IntArray
    multipliers: IntArray
    X: FloatArray
    direction: FloatArray
    parameter: IntArray

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints and constraint forces to f."""
        z = state.z
        p = np.where(self.parameter >= 0, z[self.parameter], 0.0)
        f[self.multipliers] += z[self.nodes] - self.X - p[:, None] * self.direction
        np.add.at(f, self.nodes, z[self.multipliers])

    def _driven(self) -> NDArray[np.bool_]:
        return self.parameter >= 0

    def pattern(self) -> Pattern:
        """Return the entries of C_q, C_q^T and C_p."""
        driven = self._driven()
        rows = (self.multipliers, self.nodes, self.multipliers[driven])
        columns = (self.nodes, self.multipliers, np.repeat(self.parameter[driven][:, None], 3, axis=1))
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return C_q = 1, its transpose, and C_p = -n."""
        return np.concatenate((np.ones(2 * self.nodes.size), -self.direction[self._driven()].ravel()))
