"""Newton-Raphson iteration for square sparse systems, globalised by Deuflhard's natural monotonicity."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.solvers.linear import ColumnOrdering, Factorisation, factorise
from catenaria.solvers.problem import AlgebraicProblem, FloatArray, SparseMatrix

Inspect = Callable[[SparseMatrix, Factorisation], None]


_SMALLER = 0.75  # part of a correction that the next one may have after a full step that was refused
_STEPS = 4  # simplified corrections that cost as much as a Jacobian and its factors


@dataclass(frozen=True)
class NewtonOptions:
    """Limits of a Newton iteration.

    Parameters
    ----------
    max_iterations : int
        Limit of iterations, each with a new Jacobian.
    min_damping : float
        Smallest fraction of a correction that is worth trying.
    permc_spec : str
        Column ordering of the sparse LU.
    """

    max_iterations: int = 50
    min_damping: float = 1e-4
    permc_spec: ColumnOrdering = "COLAMD"


@dataclass(frozen=True)
class Root:
    """Where a Newton iteration arrived.

    Attributes
    ----------
    y : FloatArray, shape (n,)
        Last iterate.
    converged : bool
        Whether it is a root; only the partial result of a `NotConvergedError` is none.
    corrections : FloatArray, shape (iterations,)
        Scaled maximum norm of the full corrections, convergence at 1.
    damping : FloatArray, shape (iterations,)
        Fraction of each correction that was applied.
    simplified : int
        Number of further corrections with factors that were kept.
    problem : AlgebraicProblem
        With the discrete state that fits y.
    """

    y: FloatArray
    converged: bool
    corrections: FloatArray
    damping: FloatArray
    simplified: int
    problem: AlgebraicProblem

    @property
    def iterations(self) -> int:
        """Number of corrections, with new factors and with kept ones."""
        return self.corrections.size + self.simplified


@dataclass(frozen=True)
class _Iterate:
    y: FloatArray
    problem: AlgebraicProblem
    corrections: tuple[float, ...] = ()
    damping: tuple[float, ...] = ()
    simplified: int = 0
    converged: bool = False
    factors: Factorisation | None = None

    def root(self) -> Root:
        corrections, damping = np.array(self.corrections), np.array(self.damping)
        return Root(self.y, self.converged, corrections, damping, self.simplified, self.problem)


def solve_newton(
    problem: AlgebraicProblem,
    y: FloatArray,
    options: NewtonOptions | None = None,
    inspect: Inspect | None = None,
    factors: Factorisation | None = None,
) -> Root:
    """Find a root of f from a starting guess.

    Parameters
    ----------
    problem : AlgebraicProblem
        The equations; after each iteration they may be exchanged by `reselect`.
    y : FloatArray, shape (n,)
        Starting guess; it is not changed.
    options : NewtonOptions, optional
        Limits.
    inspect : callable, optional
        Is shown the first Jacobian and its factors before they are used, and may refuse them by an error.
    factors : Factorisation, optional
        Of the Jacobian somewhere near, for the first correction; where they contract well they serve for all.

    Returns
    -------
    Root

    Raises
    ------
    NotConvergedError
        If the Jacobian is singular, something is not finite, no damping helps or the iterations run out;
        `partial` is the `Root` so far.

    Notes
    -----
    With the correction d = -J^{-1} f(y) a damped iterate y + a d is accepted if the simplified correction
    dbar = -J^{-1} f(y + a d), which costs a residual and a triangular solve, is smaller than d by the factor
    1 - a/4. This test does not depend on how the rows of f are scaled. The next a is Deuflhard's estimate
    a^2 |d| / (2 |dbar - (1 - a) d|). A full step that fails the test because J is bad where it leads is made
    if the correction by the J found there is smaller after all. Where a full correction contracts so well
    that four more with the same factors would reach convergence, the iteration goes on with these.

    Examples
    --------
    >>> from scipy.sparse import csc_array
    >>> class Root2:
    ...     newton_scale = np.array([1e-12])
    ...
    ...     def residual(self, y):
    ...         return y * y - 2.0
    ...
    ...     def jacobian(self, y):
    ...         return csc_array([[2.0 * y[0]]])
    ...
    ...     def reselect(self, y):
    ...         return None
    >>> root = solve_newton(Root2(), np.array([1.0]))
    >>> round(float(root.y[0]), 12), root.converged
    (1.414213562373, True)

    References
    ----------
    Deuflhard 2004, Newton Methods for Nonlinear Problems, section 3.3, algorithm NLEQ-ERR.
    """
    options = options or NewtonOptions()
    iterate = _Iterate(np.array(y, dtype=np.float64), problem, factors=factors)
    while not iterate.converged:
        if len(iterate.corrections) >= options.max_iterations:
            raise _failure(iterate, f"Newton's method has made {options.max_iterations} iterations")
        iterate = _iterate(iterate, options, inspect)
        inspect = None
    return iterate.root()


def _iterate(iterate: _Iterate, options: NewtonOptions, inspect: Inspect | None) -> _Iterate:
    """Return the next accepted iterate."""
    problem, y = iterate.problem, iterate.y
    factorisation = iterate.factors or _factorise(iterate, options, inspect)
    correction = _correction(problem, factorisation, y)
    size = _size(problem, correction)
    if not np.isfinite(size):
        raise _failure(iterate, "The residual or a Newton correction is not finite")
    if size <= 1.0:
        return _next(iterate, problem, y + correction, size, 1.0, True)
    damping, refused = 1.0, None
    while damping >= options.min_damping:
        trial = y + damping * correction
        try:
            at_trial = problem.reselect(trial) or problem
        except InfeasibleError as error:
            damping, refused = 0.5 * damping, error
            continue
        simplified = _correction(at_trial, factorisation, trial)
        reduced = _size(problem, simplified)
        if reduced <= 1.0 and damping == 1.0:
            return _next(iterate, at_trial, trial + simplified, size, damping, True)
        if reduced <= (1.0 - 0.25 * damping) * size:
            accepted = _next(iterate, at_trial, trial, size, damping, False)
            if damping == 1.0 and _pays(reduced, size):
                return _simplified(accepted, factorisation, simplified, reduced)
            return accepted
        factors = _ahead(at_trial, trial, size, options) if damping == 1.0 else None
        if factors is not None:
            return replace(_next(iterate, at_trial, trial, size, damping, False), factors=factors)
        estimate = _estimate(problem, correction, simplified, damping)
        damping *= min(max(estimate / damping, 0.1), 0.5)
    raise refused or _failure(iterate, "Newton's method finds no damping that brings it nearer to a root")


def _factorise(iterate: _Iterate, options: NewtonOptions, inspect: Inspect | None) -> Factorisation:
    jacobian = iterate.problem.jacobian(iterate.y)
    try:
        factorisation = factorise(jacobian, permc_spec=options.permc_spec)
    except np.linalg.LinAlgError as error:
        raise _failure(iterate, f"In Newton's method {error}") from error
    if inspect is not None:
        inspect(jacobian, factorisation)
    return factorisation


def _ahead(
    problem: AlgebraicProblem, y: FloatArray, size: float, options: NewtonOptions
) -> Factorisation | None:
    """Return the factors where a refused full step leads if the next correction there is smaller."""
    try:
        factors = factorise(problem.jacobian(y), permc_spec=options.permc_spec)
    except np.linalg.LinAlgError:
        return None
    return factors if _size(problem, _correction(problem, factors, y)) <= _SMALLER * size else None


def _simplified(
    iterate: _Iterate, factorisation: Factorisation, correction: FloatArray, size: float
) -> _Iterate:
    """Go on with the same factors while they contract so well that new ones would not pay."""
    problem, y, count = iterate.problem, iterate.y, iterate.simplified
    while True:
        y, count = y + correction, count + 1
        problem = problem.reselect(y) or problem
        following = _correction(problem, factorisation, y)
        reduced = _size(problem, following)
        if reduced <= 1.0:
            return replace(iterate, y=y + following, problem=problem, simplified=count + 1, converged=True)
        if not _pays(reduced, size):
            return replace(iterate, y=y, problem=problem, simplified=count)
        correction, size = following, reduced


def _pays(reduced: float, size: float) -> bool:
    """Return whether the same contraction again, a few times over, would reach convergence."""
    return reduced * (reduced / size) ** _STEPS <= 1.0


def _correction(problem: AlgebraicProblem, factorisation: Factorisation, y: FloatArray) -> FloatArray:
    return -factorisation.solve(problem.residual(y))


def _size(problem: AlgebraicProblem, correction: FloatArray) -> float:
    """Return the scaled maximum norm, infinite if an entry is not a number."""
    size = float(np.abs(correction / problem.newton_scale).max())
    return size if np.isfinite(size) else np.inf


def _estimate(
    problem: AlgebraicProblem, correction: FloatArray, simplified: FloatArray, damping: float
) -> float:
    """Return Deuflhard's estimate of the best damping, zero if the trial was not finite."""
    deviation = _size(problem, simplified - (1.0 - damping) * correction)
    return 0.5 * damping**2 * _size(problem, correction) / deviation


def _next(
    iterate: _Iterate, problem: AlgebraicProblem, y: FloatArray, size: float, damping: float, converged: bool
) -> _Iterate:
    corrections, dampings = (*iterate.corrections, size), (*iterate.damping, damping)
    return _Iterate(y, problem, corrections, dampings, iterate.simplified, converged)


def _failure(iterate: _Iterate, reason: str) -> NotConvergedError:
    return NotConvergedError(reason, "a starting guess nearer to the solution", iterate.root())
