"""Supports as stiff springs to the closest point of a wire: sliding joints without multipliers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.mechanics.chain import Chain, Points
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_PASSES = 100  # of Newton's method for closest points, which needs two to four near the equilibrium
_PLACE = 1e-9  # m along the wire; an error there changes the force by its square


@dataclass(frozen=True)
class ElasticSupports:
    r"""Springs that pull the closest points of a wire to given points of space.

    Parameters
    ----------
    wire : Chain
        The wire.
    X : FloatArray, shape (n, 3)
        Points of space [m].
    s : FloatArray, shape (n,)
        Material coordinates from which the closest points are looked for [m].
    k : float
        Stiffness of the springs [N/m].

    Notes
    -----
    The energy :math:`\frac k2\min_s|r(s)-X|^2` has the gradient :math:`N^T k\,(r(s^*)-X)`, normal to the wire
    because :math:`r'\cdot(r-X)=0` at the closest point :math:`s^*`: the frictionless joint (15) with the
    multiplier :math:`\lambda=k\,(r(s^*)-X)`, and an error of :math:`|\lambda|/k` in place.
    """

    wire: Chain
    X: FloatArray
    s: FloatArray
    k: float

    def closest(self, z: FloatArray) -> tuple[FloatArray, Points]:
        """Return the material coordinates of the closest points [m], and the points.

        Raises
        ------
        NotConvergedError
            If the wire has no closest point near where it is looked for.
        """
        s = self.s
        for _ in range(_PASSES):
            point = self.wire.evaluate(z, s)
            gap = point.r - self.X
            straight, bent = _dot(point.r1, point.r1), _dot(point.r2, gap)
            step = _dot(point.r1, gap) / np.maximum(straight + bent, 0.5 * straight)  # never uphill
            if np.all(np.abs(step) <= _PLACE):
                return s, point
            s = s - step
        raise NotConvergedError("a wire has lost a support", "a smaller disturbance of the start")

    def force(self, point: Points) -> FloatArray:
        """Return the forces of the wire on its supports [N], shape (n, 3), freed of round-off along it."""
        gap = point.r - self.X
        along = _dot(point.r1, gap) / _dot(point.r1, point.r1)
        return self.k * (gap - along[:, None] * point.r1)

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add the gradient of the energy to f."""
        _, point = self.closest(state.z)
        np.add.at(f, point.dofs, point.N[:, :, None] * self.force(point)[:, None, :])

    def stiffness(self, z: FloatArray) -> tuple[IntArray, FloatArray]:
        r"""Return the coordinates that supports act on, shape (n, 12), and stiffness matrices, (n, 12, 12).

        Notes
        -----
        With the gap g and :math:`b=N^Tr'+N'^Tg`, the condition :math:`r'\cdot g=0` moves the closest point by
        :math:`-b\cdot dq/(r'\cdot r'+r''\cdot g)`, so that
        :math:`K=k\,(N^TN-bb^T/(r'\cdot r'+r''\cdot g))`.
        """
        _, point = self.closest(z)
        gap, N = point.r - self.X, point.N
        b = N[:, :, None] * point.r1[:, None, :] + point.N1[:, :, None] * gap[:, None, :]
        b = b.reshape(-1, 12)
        h = _dot(point.r1, point.r1) + _dot(point.r2, gap)
        NN = (N[:, :, None] * N[:, None, :])[:, :, None, :, None] * np.eye(3)[:, None, :]
        K = NN.reshape(-1, 12, 12) - b[:, :, None] * b[:, None, :] / h[:, None, None]
        return point.dofs.reshape(-1, 12), self.k * K


def _dot(u: FloatArray, v: FloatArray) -> FloatArray:
    return np.einsum("ni,ni->n", u, v)
