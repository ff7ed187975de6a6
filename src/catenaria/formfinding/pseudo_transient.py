"""Rest by implicit steps from standstill: for starts that have no stiffness against their loads.

A straight cable without tension, a pendulum without force: their static Jacobian is singular, so that no
Newton iteration and no load step leads away from them. Their mass resists where stiffness does not.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.static_problem import StaticProblem
from catenaria.mechanics.state import State
from catenaria.solvers.newton import NewtonOptions, Root, solve_newton

FloatArray = NDArray[np.float64]

_FIRST, _SMALLEST, _LONG = (
    0.1,
    1e-4,
    10.0,
)  # s: first and smallest step; from the last on inertia hardly counts
_GROWTH, _SHORTENING = 2.0, 0.5
_QUICK = 6  # Newton iterations up to which the next step is longer
_MAX_STEPS = 200
_NEWTON = NewtonOptions(max_iterations=15)
_COARSE = 100.0  # how much larger the negligible corrections of a step on the way are


@dataclass(frozen=True)
class _Step:
    """M (y - y0)/tau^2 + F(y) = 0: where the system is after the time tau, if it stood still at y0."""

    problem: StaticProblem
    y0: FloatArray
    tau: float

    @property
    def newton_scale(self) -> FloatArray:
        return _COARSE * self.problem.newton_scale

    def _state(self, y: FloatArray) -> State:
        return State(0.0, y, np.zeros_like(y), (y - self.y0) / self.tau**2)

    def residual(self, y: FloatArray) -> FloatArray:
        return self.problem.system.residual(self._state(y))

    def jacobian(self, y: FloatArray) -> csc_matrix:
        return self.problem.system.jacobian(self._state(y), 0.0, self.tau**-2)

    def reselect(self, y: FloatArray) -> _Step | None:
        selected = self.problem.reselect(y)
        return None if selected is None else replace(self, problem=selected)


def rest_by_steps(problem: StaticProblem, z: FloatArray) -> tuple[Root, int]:
    """Return where a system with inertia comes to rest, and the number of steps.

    Parameters
    ----------
    problem : StaticProblem
        The system; its masses are used on the way only.
    z : FloatArray, shape (n,)
        Where to start.

    Raises
    ------
    NotConvergedError
        If steps become too small or too many; `partial` is what the last Newton iteration reached.

    Notes
    -----
    Implicit Euler steps of M q'' + F = 0 that forget their velocity, longer and longer: energy decreases from
    step to step, and M/tau^2 vanishes in the end.

    References
    ----------
    Kelley & Keyes 1998, Convergence analysis of pseudo-transient continuation, SIAM J. Numer. Anal. 35,
    508-523.
    """
    tau, failures = _FIRST, list[NotConvergedError | InfeasibleError]()
    for step in range(1, _MAX_STEPS + 1):
        try:
            reached = solve_newton(_Step(problem, z, tau), z, _NEWTON)
            z, problem = reached.y, _problem_of(reached)
            if tau > _LONG:
                return solve_newton(problem, z), step
            tau *= _GROWTH if reached.corrections.size <= _QUICK else 1.0
        except (NotConvergedError, InfeasibleError) as error:
            failures.append(error)
            tau *= _SHORTENING
        if tau < _SMALLEST:
            break
    raise _failure(failures)


def _failure(failures: list[NotConvergedError | InfeasibleError]) -> NotConvergedError:
    """Return the error that names what cannot be, if a step met with that, else why the last one failed."""
    telling = [error for error in failures if isinstance(error, InfeasibleError)] or failures
    why = [getattr(error, "reason", str(error)) for error in telling[-1:]]
    reason = "; ".join(("no way from the start to a state of rest is found in steps from standstill", *why))
    partial = failures[-1].partial if failures else None
    return NotConvergedError(reason, "a start nearer to the equilibrium", partial)


def _problem_of(root: Root) -> StaticProblem:
    if not isinstance(root.problem, _Step):
        raise TypeError("reselect has changed the type of the problem")
    return root.problem.problem
