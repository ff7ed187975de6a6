"""Masses that hang from points of wires: clamps, feeders, section insulators."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.carrier import Carrier
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class HungMasses:
    r"""Weights of masses at points of wires.

    Parameters
    ----------
    carrier : Carrier
        The wires.
    s : IntArray, shape (n,)
        Indices of the sliding coordinates: material coordinates of the points [m]. Their rows are left to
        what says where the masses are, `Guides` or `Given`.
    element : IntArray, shape (n,)
        Element in which each point is: discrete state, changed by `relocate` only.
    mass : FloatArray, shape (n,)
        The masses m [kg].
    g : float
        Gravity [m/s^2].
    ramp : Ramp
        Its growth in time, rho(t).

    Notes
    -----
    .. math:: f \mathrel{+}= S(s)^T e_z\, g\,\rho(t)\,m .

    The load is dead but for the point at which it acts. There is no inertia: a line at rest does not feel it.
    """

    carrier: Carrier
    s: IntArray
    element: IntArray
    mass: FloatArray
    g: float
    ramp: Ramp

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Subtract the weights from f."""
        point = self.carrier.evaluate(state.z, state.z[self.s], self.element)
        np.add.at(f, point.dofs[:, :, 2].ravel(), (point.N * self._weight(state.t)).ravel())

    def _weight(self, t: float) -> FloatArray:
        return (self.g * self.ramp(t) * self.mass)[:, None]

    def pattern(self) -> Pattern:
        """Return the entries of the vertical nodal forces by s."""
        ends = (self.carrier.nodes[self.element], self.carrier.nodes[self.element + 1])
        vertical = np.concatenate(ends, axis=1)[:, 2::3]
        return vertical.ravel(), np.repeat(self.s, 4)

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return N' times the weights."""
        point = self.carrier.evaluate(state.z, state.z[self.s], self.element)
        return (point.N1 * self._weight(state.t)).ravel()

    def relocate(self, z: FloatArray) -> HungMasses | None:
        """Return the masses in the elements that fit z, or None if all are."""
        element = self.carrier.relocate(z[self.s], self.element)
        return None if np.array_equal(element, self.element) else replace(self, element=element)
