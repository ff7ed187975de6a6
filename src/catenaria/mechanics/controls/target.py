"""Targets met exactly: the controls of (19)-(23) as equations e = 0 instead of velocity laws."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.controls.control import Controls, Measure
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Targets:
    """A batch of controls in statics: the parameters are found such that m = m*.

    Parameters
    ----------
    parameter : IntArray, shape (n,)
        Indices of the control parameters; their rows hold the equations.
    measure : Measure
        What is measured.
    target : FloatArray, shape (n,)
        What it shall be [N or m].

    Notes
    -----
    The fixed point of p' = v(e) without a dead band, tension by tension and height by height.
    """

    parameter: IntArray
    measure: Measure
    target: FloatArray

    @classmethod
    def of(cls, controls: Controls) -> Targets:
        """Return the targets of controls, at full gravity."""
        return cls(controls.parameter, controls.measure, controls.target)

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add m - m* to f."""
        f[self.parameter] += self.measure.value(state.t, state.z) - self.target

    def pattern(self) -> Pattern:
        """Return the entries of the measures' gradients."""
        columns = self.measure.columns()
        return np.repeat(self.parameter, columns.shape[1]), columns.ravel()

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return dm/dz."""
        return self.measure.gradient(state.t, state.z).ravel()

    def relocate(self, z: FloatArray) -> Targets | None:
        """Return the targets whose measure fits z, or None if it already does."""
        measure = self.measure.relocate(z)
        return None if measure is None else replace(self, measure=measure)
