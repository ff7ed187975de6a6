"""Supports over which a wire runs: rollers, also stiff ones on springs and ones with friction."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.carrier import Carrier
from catenaria.mechanics.chain import Points
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_TINY = np.finfo(np.float64).tiny


@dataclass(frozen=True)
class Supports:
    r"""Points or nodes over which wires run, elastically held and with Coulomb friction.

    Parameters
    ----------
    carrier : Carrier
        The wires that run over the supports.
    s : IntArray, shape (n,)
        Indices of the sliding coordinates: material coordinates of the wires at the supports [m].
    multipliers : IntArray, shape (n, 3)
        Indices of la, the force of the wire on the support [N].
    element : IntArray, shape (n,)
        Element in which each support is: discrete state, changed by `relocate` only.
    X : FloatArray, shape (n, 3)
        Where the unloaded supports are [m]; used where there is no node.
    compliance : FloatArray, shape (n, 3, 3)
        By how much a unit of force displaces the support [m/N]; 0 for a rigid one.
    friction : FloatArray, shape (n,)
        Part of |la| that acts along the wire, in (-1, 1): positive if the wire drags the support towards
        its own end, negative if towards its start.
    nodes : IntArray or None, shape (n, 3)
        Indices of the positions of the nodes over which the wires run, None for points of space.

    Raises
    ------
    InconsistentInputError
        If a shape does not fit, or friction is not below the whole force.

    Notes
    -----
    .. math:: r(s) - X - C\lambda = 0,\qquad \lambda\cdot r'(s) = f\,|\lambda|\,|r'(s)|.

    With C = 0 and f = 0 this is the frictionless joint (15). f is the sine of the angle of friction, which
    differs from the coefficient of friction by 2 % at 0.2. |la| has a kink at la = 0; there, and only there,
    its derivative is taken as 0, which is right for the frictionless row that is left.
    """

    carrier: Carrier
    s: IntArray
    multipliers: IntArray
    element: IntArray
    X: FloatArray
    compliance: FloatArray
    friction: FloatArray
    nodes: IntArray | None = None

    def __post_init__(self) -> None:
        count = self.s.size
        if self.compliance.shape != (count, 3, 3) or self.friction.shape != (count,):
            raise InconsistentInputError("supports need a compliance of 3 by 3 and one friction each")
        if not np.all(np.abs(self.friction) < 1.0):  # also refuses NaN
            raise InconsistentInputError("friction must take less than the whole force of a wire")

    def _along(self, point: Points, la: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return la - f |la| t, whose product with r' is the row of s, and the row's derivative by la."""
        force, slope = _length(la), _length(point.r1)
        drag = (self.friction * force)[:, None] * point.r1 / slope[:, None]
        direction = la / np.maximum(force.real, _TINY)[:, None]
        return la - drag, point.r1 - (self.friction * slope)[:, None] * direction

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add constraints, friction laws and constraint forces to f."""
        z = state.z
        point, la = self.carrier.evaluate(z, z[self.s], self.element), z[self.multipliers]
        give = np.einsum("nij,nj->ni", self.compliance, la)
        f[self.multipliers] += point.r - (self.X if self.nodes is None else z[self.nodes]) - give
        f[self.s] += np.einsum("ni,ni->n", self._along(point, la)[0], point.r1)
        np.add.at(f, point.dofs, point.N[:, :, None] * la[:, None, :])
        if self.nodes is not None:
            np.subtract.at(f, self.nodes, la)

    def pattern(self) -> Pattern:
        """Return the entries of the constraints' and forces' derivatives."""
        dofs = np.concatenate(
            (self.carrier.nodes[self.element], self.carrier.nodes[self.element + 1]), axis=1
        )
        la = np.tile(self.multipliers, 4)
        s3, s12 = np.repeat(self.s[:, None], 3, axis=1), np.repeat(self.s[:, None], 12, axis=1)
        which, row, column = np.nonzero(self.compliance)
        rows = [la, dofs, self.multipliers, s3, dofs, s12, self.s, self.multipliers[which, row]]
        columns = [dofs, la, s3, self.multipliers, s12, dofs, self.s, self.multipliers[which, column]]
        if self.nodes is not None:
            rows += [self.multipliers, self.nodes]
            columns += [self.nodes, self.multipliers]
        return np.concatenate([part.ravel() for part in rows]), np.concatenate(
            [part.ravel() for part in columns]
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N, r', N' la, the derivatives of the friction law and -C at those entries."""
        z = state.z
        point, la = self.carrier.evaluate(z, z[self.s], self.element), z[self.multipliers]
        along, by_la = self._along(point, la)
        N = np.repeat(point.N, 3, axis=1).ravel()
        parts = [N, N, point.r1.ravel(), by_la.ravel()]
        parts += [(point.N1[:, :, None] * force[:, None, :]).ravel() for force in (la, along)]
        parts += [np.einsum("ni,ni->n", along, point.r2), -self.compliance[np.nonzero(self.compliance)]]
        if self.nodes is not None:
            parts.append(np.full(2 * self.nodes.size, -1.0))
        return np.concatenate(parts)

    def relocate(self, z: FloatArray) -> Supports | None:
        """Return the supports in the elements that fit z, or None if all are."""
        element = self.carrier.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)


def _length(vectors: FloatArray) -> FloatArray:
    """Return |v| in the form that also takes complex steps."""
    return np.sqrt(np.einsum("ni,ni->n", vectors, vectors))
