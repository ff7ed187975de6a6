"""A mechanical system at rest as the algebraic problem that Newton's method solves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.count import check_count
from catenaria.formfinding.free_motion import Names, ParameterCheck, refuse_free_motion
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind
from catenaria.solvers.newton import NewtonOptions, Root, solve_newton

FloatArray = NDArray[np.float64]

_CORRECTION, _FORCE = 1e-9, 1e-5  # m and N: Newton corrections that count as none


@dataclass(frozen=True)
class StaticProblem:
    """`catenaria.solvers.problem.AlgebraicProblem` for a `System` without motion.

    Parameters
    ----------
    system : System
        What is to rest.
    correction, force : float
        Newton corrections of lengths [m] and of multipliers [N] that count as none.
    """

    system: System
    correction: float
    force: float | FloatArray

    @cached_property
    def _scale(self) -> FloatArray:
        return np.where(self.system.unknowns.where(Kind.MULTIPLIER), self.force, self.correction)

    @property
    def newton_scale(self) -> FloatArray:
        """Negligible corrections."""
        return self._scale

    @cached_property
    def _rest(self) -> FloatArray:
        return np.zeros(self.system.size)

    def residual(self, y: FloatArray) -> FloatArray:
        """Return F(0, y, 0, 0)."""
        return self.system.residual(State(0.0, y, self._rest, self._rest))

    def jacobian(self, y: FloatArray) -> csc_matrix:
        """Return F_y."""
        return self.system.jacobian(State(0.0, y, self._rest, self._rest))

    def reselect(self, y: FloatArray) -> StaticProblem | None:
        """Return the problem whose sliding joints are in the elements that fit y, or None."""
        system = self.system.relocate(y)
        return None if system is None else replace(self, system=system)


def statics(system: System, z: FloatArray) -> System:
    """Return the system with targets in the place of controls, and joints in the elements that fit z."""
    parts = tuple(Targets.of(part) if isinstance(part, Controls) else part for part in system.contributions)
    static = System(system.unknowns, parts)
    return static.relocate(z) or static


def static_problem(system: System) -> StaticProblem:
    """Return the problem with the tolerances of lines: nanometres and 0.01 mN, or what rounding leaves."""
    return StaticProblem(system, _CORRECTION, max(_FORCE, 2.0 * _rounding(system)))


def _rounding(system: System) -> float:
    """Return by how much the stiffest element's force changes with the last digit of a position [N]."""
    cables = [part for part in system.contributions if isinstance(part, CableElements)]
    stiffest = max((float(np.max(part.EA / part.L)) for part in cables), default=0.0)
    unknowns = system.unknowns
    positions = unknowns.start[unknowns.where(Kind.POSITION)]
    return float(np.finfo(np.float64).eps * np.abs(positions).max(initial=0.0)) * stiffest


def find_rest(system: System, z: FloatArray, max_iterations: int = 30, names: Names = ()) -> Root:
    """Return where a system that is numbered along the line is at rest.

    Parameters
    ----------
    system : System
        With the discrete state that fits z.
    z : FloatArray, shape (n,)
        Where to start.
    max_iterations : int
        Limit of Newton iterations.
    names : sequence
        Names of parts, each with the indices of its unknowns, for messages.

    Raises
    ------
    NotConvergedError
        See `catenaria.solvers.newton.solve_newton`.
    InfeasibleError
        If a cable slides out of a joint.
    InconsistentInputError, SingularError
        If the targets are too many or too few, or leave a motion free.
    """
    options = NewtonOptions(max_iterations=max_iterations, permc_spec="NATURAL")
    return find_root(static_problem(system), z, options, names)


def find_root(
    problem: StaticProblem, z: FloatArray, options: NewtonOptions | None = None, names: Names = ()
) -> Root:
    """Return where a system is at rest, or say what is free to move.

    Parameters
    ----------
    problem : StaticProblem
        The system and its tolerances.
    z, options, names
        As of `find_rest` and `solve_newton`.

    Raises
    ------
    InconsistentInputError
        If the number of targets does not fit; see `check_count`.
    NotConvergedError, InfeasibleError, SingularError
        As `find_rest`.
    """
    check_count(problem.system, names)
    try:
        return solve_newton(problem, z, options, ParameterCheck(problem.system, z, names))
    except (NotConvergedError, InfeasibleError):
        refuse_free_motion(problem.system, (z,), names)
        raise
