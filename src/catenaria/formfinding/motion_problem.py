"""A mechanical system as the differential-algebraic problem that the integrator solves, eq. (24)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Tolerances:
    """What the integrator may neglect.

    Attributes
    ----------
    position : float
        Error of positions in one time step [m].
    parameter : float or FloatArray
        The same for control parameters [m]: one value, or one for each in the order of their numbers.
    correction : float
        Newton correction of a position, sliding coordinate or parameter that counts as none [m].
    force : float or FloatArray
        The same for multipliers [N]: one value, or one for each in the order of their numbers.
    """

    position: float
    parameter: float | FloatArray
    correction: float
    force: float | FloatArray


@dataclass(frozen=True)
class MotionProblem:
    """`catenaria.solvers.problem.DaeProblem` for a `System`.

    Parameters
    ----------
    system : System
        What moves.
    tolerances : Tolerances
        Error control acts on positions and control parameters only; slopes follow positions, sliding
        coordinates and multipliers are algebraic.
    """

    system: System
    tolerances: Tolerances

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.system.size

    @cached_property
    def _tables(self) -> tuple[NDArray[np.int8], NDArray[np.bool_], FloatArray, FloatArray]:
        unknowns, tolerances = self.system.unknowns, self.tolerances
        order = 2 * unknowns.where(Kind.POSITION, Kind.SLOPE) + unknowns.where(Kind.PARAMETER)
        constraint = unknowns.where(Kind.MULTIPLIER)
        error_scale = np.where(unknowns.where(Kind.POSITION), tolerances.position, np.inf)
        error_scale[unknowns.where(Kind.PARAMETER)] = tolerances.parameter
        newton_scale = np.full(constraint.size, tolerances.correction)
        newton_scale[constraint] = tolerances.force
        return order.astype(np.int8), constraint, error_scale, newton_scale

    @property
    def order_of(self) -> NDArray[np.int8]:
        """Highest time derivative of each unknown."""
        return self._tables[0]

    @property
    def constraint(self) -> NDArray[np.bool_]:
        """Rows that are constraints; each multiplier has the index of its constraint."""
        return self._tables[1]

    @property
    def error_scale(self) -> FloatArray:
        """Error allowed per step."""
        return self._tables[2]

    @property
    def newton_scale(self) -> FloatArray:
        """Negligible Newton corrections."""
        return self._tables[3]

    def residual(self, t: float, y: FloatArray, yd: FloatArray, ydd: FloatArray) -> FloatArray:
        """Return F(t, y, y', y'')."""
        return self.system.residual(State(t, y, yd, ydd))

    def jacobian(
        self, t: float, y: FloatArray, yd: FloatArray, ydd: FloatArray, c1: float, c2: float
    ) -> csc_matrix:
        """Return F_y + c1 F_y' + c2 F_y''."""
        return self.system.jacobian(State(t, y, yd, ydd), c1, c2)

    def reselect(self, y: FloatArray) -> MotionProblem | None:
        """Return the problem whose sliding joints are in the elements that fit y, or None."""
        system = self.system.relocate(y)
        return None if system is None else replace(self, system=system)
