"""A control is a parameter, a measure and a target: eqs. (19)-(23) as one concept.

The parameter p is a length that somebody changes: how far a wire end is pulled outwards, how far the top of a
dropper is raised, how far the lower end of an upper dropper cable is pulled down, how long a dropper is. The
error is e = m - m*, and p follows the velocity law, p' = v(e), or -v(e) where more of it makes the measured
quantity m smaller.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@runtime_checkable
class Measure(Protocol):
    """What a batch of controls measures."""

    def value(self, t: float, z: FloatArray) -> FloatArray:
        """Return the measured quantities, shape (n,)."""
        ...

    def columns(self) -> IntArray:
        """Return the indices of the unknowns on which they depend, shape (n, m)."""
        ...

    def gradient(self, t: float, z: FloatArray) -> FloatArray:
        """Return their derivatives by those unknowns, shape (n, m)."""
        ...

    def relocate(self, z: FloatArray) -> Measure | None:
        """Return the measure with the discrete state that fits z, or None if its own still fits."""
        ...


@dataclass(frozen=True)
class Controls:
    """A batch of controls with one velocity law.

    Parameters
    ----------
    parameter : IntArray, shape (n,)
        Indices of the control parameters [m].
    measure : Measure
        What is measured.
    target : FloatArray, shape (n,)
        What it should be [N or m].
    law : VelocityLaw
        How fast the parameters follow.
    velocity_ramp : Ramp
        Brings the velocity in, because the wire rests at t = 0.
    target_ramp : Ramp
        Brings the target in; for a force that balances weight it is the ramp of gravity, so that e = 0 at the
        start.
    sense : float
        1, or -1 where more of the parameter makes less of the measured quantity.
    """

    parameter: IntArray
    measure: Measure
    target: FloatArray
    law: VelocityLaw
    velocity_ramp: Ramp
    target_ramp: Ramp
    sense: float = 1.0

    def error(self, t: float, z: FloatArray) -> FloatArray:
        """Return e = m - m*, shape (n,)."""
        return self.measure.value(t, z) - self.target_ramp(t) * self.target

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add p' -/+ v(e) to f."""
        velocity = self.sense * self.law.velocity(self.error(state.t, state.z))
        f[self.parameter] += state.zd[self.parameter] - self.velocity_ramp(state.t) * velocity

    def pattern(self) -> Pattern:
        """Return the entries of p' and of the measures' gradients."""
        columns = self.measure.columns()
        rows = np.repeat(self.parameter[:, None], columns.shape[1], axis=1)
        return np.concatenate((self.parameter, rows.ravel())), np.concatenate(
            (self.parameter, columns.ravel())
        )

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return c1 for p' and -/+ v'(e) dm/dz."""
        slope = -self.sense * self.velocity_ramp(state.t) * self.law.slope(self.error(state.t, state.z))
        gradient = self.measure.gradient(state.t, state.z)
        return np.concatenate((np.full(self.parameter.size, c1), (slope[:, None] * gradient).ravel()))

    def relocate(self, z: FloatArray) -> Controls | None:
        """Return the controls whose measure fits z, or None if it already does."""
        measure = self.measure.relocate(z)
        return None if measure is None else replace(self, measure=measure)
