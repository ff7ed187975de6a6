"""Modified Newton iteration for the equations of one BDF step, eq. (27), with kept factorisations."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from catenaria.solvers.linear import ColumnOrdering, Factorisation, Scaling, factorise, index3_scaling
from catenaria.solvers.outcome import NO_WORK, Counters
from catenaria.solvers.problem import DaeProblem, FloatArray

MAX_ITERATIONS = 4
MAX_LINEARISATIONS = 4
MAX_FULL = 10  # iterations of the full Newton method, the last resort before a step is cut
MAX_RESELECTIONS = 8
D0_BAND = 0.25  # relative change of d0 that a kept factorisation survives
SLOW = 0.3  # contraction rate above which the next step begins with a new factorisation
DIVERGING = 0.9
UNKNOWN_RATE = 0.3  # taken for granted at the first iteration, whatever was seen before: matrices age


class StepEquations(NamedTuple):
    """y' = d0 y + a, eq. (26), and y'' = d0 y' + b at time t; a and b come from past values.

    `permc_spec` is SuperLU's column ordering for the Newton matrix of the step.
    """

    t: float
    d0: float
    a: FloatArray
    b: FloatArray
    permc_spec: ColumnOrdering = "COLAMD"

    def rates(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return y' and y''."""
        yd = self.d0 * y + self.a
        return yd, self.d0 * yd + self.b


@dataclass(frozen=True)
class Linearisation:
    """Factorised Newton matrix.

    Attributes
    ----------
    problem, d0 : DaeProblem, float
        Where it belongs.
    factorisation : Factorisation
        The factors.
    negligible : FloatArray, shape (n,)
        Size of a negligible correction.
    rate : float
        Largest contraction rate seen, 0 if none.
    """

    problem: DaeProblem
    d0: float
    factorisation: Factorisation
    negligible: FloatArray
    rate: float = 0.0

    def fits(self, problem: DaeProblem, d0: float) -> bool:
        """Say whether the factorisation is worth trying for this problem and leading coefficient."""
        return self.problem is problem and abs(d0 / self.d0 - 1.0) <= D0_BAND and self.rate <= SLOW


@dataclass(frozen=True)
class Correction:
    """Outcome of a step's equations; y has no meaning if there is a failure."""

    y: FloatArray
    problem: DaeProblem
    linearisation: Linearisation | None
    work: Counters
    failure: str | None = None


def correct(
    problem: DaeProblem, equations: StepEquations, predicted: FloatArray, kept: Linearisation | None
) -> Correction:
    """Solve the equations of a step and bring the discrete state in line with the solution.

    Parameters
    ----------
    problem : DaeProblem
        The system with the discrete state of the last step.
    equations : StepEquations
        The step.
    predicted : FloatArray, shape (n,)
        First iterate.
    kept : Linearisation, optional
        Factorisation of an earlier step.

    Returns
    -------
    Correction
        With the problem that `reselect` chose last. Two discrete states that point at each other, as they
        may on the border between them, end the search after a few rounds: both fit there.
    """
    result = _correct_once(problem, equations, predicted, kept)
    for _ in range(MAX_RESELECTIONS):
        selected = None if result.failure else result.problem.reselect(result.y)
        if selected is None:
            break
        again = _correct_once(selected, equations, result.y, None)
        result = replace(again, work=again.work.plus(result.work).plus(Counters(reselections=1)))
    return result


def _correct_once(
    problem: DaeProblem, equations: StepEquations, y: FloatArray, kept: Linearisation | None
) -> Correction:
    """Iterate with the kept factorisation if it fits, then with new ones as long as they bring progress."""
    work = NO_WORK
    if kept is not None and kept.fits(problem, equations.d0):
        result = _iterate(equations, y, kept)
        if result.failure is None:
            return result
        work, y = result.work, result.y if _was_contracting(result) else y
    result = Correction(y, problem, None, work)
    for _ in range(MAX_LINEARISATIONS):
        work = work.plus(Counters(jacobians=1, factorisations=1))
        try:
            fresh = _linearise(problem, equations, y)
        except np.linalg.LinAlgError as error:
            return Correction(y, problem, None, work, str(error))
        result = _iterate(equations, y, fresh)
        work = work.plus(result.work)
        if result.failure is None or not _was_contracting(result):
            break
        y = result.y
    if result.failure is None:
        return replace(result, work=work)
    full = _full_newton(problem, equations, result.y if _was_contracting(result) else y)
    return replace(full, work=full.work.plus(work))


def _full_newton(problem: DaeProblem, equations: StepEquations, y: FloatArray) -> Correction:
    """Linearise at every iterate, and let corrections grow in between, as they do across corners of a law."""
    sizes: list[float] = []
    work = NO_WORK
    for iteration in range(1, MAX_FULL + 1):
        work = Counters(
            jacobians=iteration, factorisations=iteration, residuals=iteration, newton_iterations=iteration
        )
        try:
            linearisation = _linearise(problem, equations, y)
        except np.linalg.LinAlgError as error:
            return Correction(y, problem, None, work, str(error))
        correction = -linearisation.factorisation.solve(problem.residual(equations.t, y, *equations.rates(y)))
        if not np.isfinite(correction).all():
            return Correction(y, problem, None, work, "the residual or a Newton correction is not finite")
        y = y + correction
        sizes.append(float(np.abs(correction / linearisation.negligible).max()))
        if sizes[-1] <= 1.0:
            return Correction(y, problem, linearisation, work)
        if iteration > 4 and sizes[-1] > 0.5 * sizes[-3]:
            break
    return Correction(y, problem, None, work, "Newton's method converges too slowly")


def _was_contracting(result: Correction) -> bool:
    """Say whether the last iterate of an unfinished iteration is better than the first one."""
    return result.linearisation is not None and 0.0 < result.linearisation.rate < DIVERGING


def _linearise(problem: DaeProblem, equations: StepEquations, y: FloatArray) -> Linearisation:
    """Factorise the Newton matrix at y."""
    d0 = equations.d0
    matrix = problem.jacobian(equations.t, y, *equations.rates(y), d0, d0 * d0)
    scaling = index3_scaling(matrix, problem.order_of, problem.constraint)
    return Linearisation(
        problem, d0, factorise(matrix, scaling, equations.permc_spec), _negligible(problem, scaling)
    )


def _negligible(problem: DaeProblem, scaling: Scaling) -> FloatArray:
    """Return `newton_scale`, for multipliers at least the inertia force of a negligible change of position.

    No multiplier is known better than that, of the order of m d0^2 dq; a test that asked for more would fail
    for small steps, and again for the smaller steps that follow the failure.
    """
    scale = problem.newton_scale
    position = float(scale[problem.order_of == 2].min(initial=np.inf))
    if not np.isfinite(position):
        return scale
    return np.where(problem.constraint, np.maximum(scale, scaling.row * position), scale)


def _iterate(equations: StepEquations, y: FloatArray, linearisation: Linearisation) -> Correction:
    """Newton iteration with a fixed matrix; ends by the estimate rate/(1 - rate) of the remaining error.

    References
    ----------
    Hairer & Wanner 1996, section IV.8, eq. (8.10); Hindmarsh et al. 2005, section 2.2.
    """
    problem, solve = linearisation.problem, linearisation.factorisation.solve
    damping, mismatch = _account_for_d0(linearisation.d0, equations.d0, int(problem.order_of.max()))
    floor = max(linearisation.rate, mismatch)
    rate = max(floor, UNKNOWN_RATE)
    failure: str | None = "Newton's method converges too slowly"
    observed = linearisation.rate
    size = previous = 0.0
    iteration = 0
    for iteration in range(1, MAX_ITERATIONS + 1):
        residual = problem.residual(equations.t, y, *equations.rates(y))
        correction = solve(residual) * -damping
        if not np.isfinite(correction).all():
            failure = "the residual or a Newton correction is not finite"
            break
        y = y + correction
        previous, size = size, float(np.abs(correction / linearisation.negligible).max())
        if iteration > 1:
            observed = max(observed, size / previous)
            rate = max(floor, size / previous)
        if rate < 1.0 and rate / (1.0 - rate) * size <= 1.0:
            failure = None
            break
        if iteration > 1 and (
            rate >= DIVERGING or rate ** (MAX_ITERATIONS - iteration + 1) / (1.0 - rate) * size > 1.0
        ):
            break
    work = Counters(residuals=iteration, newton_iterations=iteration)
    return Correction(y, problem, replace(linearisation, rate=observed), work, failure)


def _account_for_d0(old: float, new: float, order: int) -> tuple[float, float]:
    """Return the factor of the corrections and the contraction rate that a change of d0 leads to.

    With r = (new / old)^order the kept matrix applied to the present one has its spectrum between 1
    (constraints, stiffness) and r (inertia). Corrections multiplied by 2 / (1 + r) contract both ends by the
    same |r - 1| / (r + 1); IDA does this for order = 1 (Hindmarsh et al. 2005, section 2.2).
    """
    r = (new / old) ** order
    return 2.0 / (1.0 + r), abs(r - 1.0) / (r + 1.0)
