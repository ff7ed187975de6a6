"""Values that go into and come out of the integrator: start, options, steps, solution."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.solvers.bdf_coefficients import extrapolation_weights
from catenaria.solvers.linear import ColumnOrdering
from catenaria.solvers.problem import DaeProblem, FloatArray


class Status(Enum):
    """How an integration ended."""

    END_REACHED = "the end time was reached"
    STOPPED = "the stop function gave a reason"
    STEP_FAILED = "a step failed at the smallest length allowed"
    TOO_MANY_STEPS = "the number of steps reached its limit"


class Counters(NamedTuple):
    """Work done: attempts, evaluations and factorisations."""

    steps: int = 0
    rejected: int = 0
    newton_failures: int = 0
    residuals: int = 0
    jacobians: int = 0
    factorisations: int = 0
    newton_iterations: int = 0
    reselections: int = 0

    def plus(self, other: Counters) -> Counters:
        """Return the sums of the counters."""
        return Counters(*map(sum, zip(self, other, strict=True)))


NO_WORK = Counters()


@dataclass(frozen=True)
class Start:
    """State, or table of past states in ascending time, from which an integration begins.

    Parameters
    ----------
    t : float or FloatArray, shape (m,)
        Times [s].
    y, yd : FloatArray, shape (n,) or (m, n)
        Unknowns and their rates.
    """

    t: float | FloatArray
    y: FloatArray
    yd: FloatArray


@dataclass(frozen=True)
class Options:
    """How to integrate.

    Parameters
    ----------
    max_order : int
        Highest order, 1 to 5. Formulas above order 2 are not A-stable and undamped wires oscillate.
    initial_step : float, optional
        First step [s]; chosen from the error scale and the time span if not given.
    min_step, max_step : float
        Bounds of the step [s].
    max_steps : int
        Limit of attempted steps.
    permc_spec : str
        Column ordering of the sparse LU; ``NATURAL`` for unknowns that are numbered along a line.
    constant_step : float, optional
        Run with this step [s] and, as soon as there is enough history, with order `max_order`; no error test.
    """

    max_order: int = 2
    initial_step: float | None = None
    min_step: float = 1e-12
    max_step: float = np.inf
    max_steps: int = 100_000
    permc_spec: ColumnOrdering = "COLAMD"
    constant_step: float | None = None


@dataclass(frozen=True)
class Step:
    """An accepted step; its arrays are read-only.

    Attributes
    ----------
    number : int
        Counted from 1.
    t, h : float
        Time at its end and length [s].
    order : int
        Order of the formula.
    y, yd, ydd : FloatArray, shape (n,)
        Unknowns and the derivatives of the formula; those of algebraic unknowns have no meaning.
    counters : Counters
        Work done since the start.
    problem : DaeProblem
        The problem with the discrete state that fits y.
    """

    number: int
    t: float
    h: float
    order: int
    y: FloatArray
    yd: FloatArray
    ydd: FloatArray
    counters: Counters
    problem: DaeProblem


@dataclass(frozen=True)
class Solution:
    """Accepted steps of an integration, first the rows of its start.

    Attributes
    ----------
    t : FloatArray, shape (m,)
        Times, ascending [s].
    y, yd : FloatArray, shape (m, n)
        Unknowns and rates.
    h : FloatArray, shape (m,)
        Length of the step that ends at t, 0 for rows of the start [s].
    order : NDArray[np.int64], shape (m,)
        Order of that step, 0 for rows of the start.
    counters : Counters
        Work done.
    status : Status
        How the integration ended.
    reason : str
        The same in words.
    problem : DaeProblem
        The problem with its final discrete state.
    """

    t: FloatArray
    y: FloatArray
    yd: FloatArray
    h: FloatArray
    order: NDArray[np.int64]
    counters: Counters
    status: Status
    reason: str
    problem: DaeProblem

    def __call__(self, t: float) -> FloatArray:
        """Return y at any time of the integration by the BDF polynomial of the step that contains it.

        Parameters
        ----------
        t : float
            Between the first and the last time [s].

        Returns
        -------
        FloatArray, shape (n,)
            Continuous over step ends; a step of order k has an interpolation error of order k + 1.

        Raises
        ------
        ValueError
            If t lies outside.
        """
        if not self.t[0] <= t <= self.t[-1]:
            raise ValueError(f"t = {t} lies outside [{self.t[0]}, {self.t[-1]}]")
        end = max(int(np.searchsorted(self.t, t)), 1)
        first = end - max(int(self.order[end]), 1)
        weights = extrapolation_weights(t, tuple(self.t[first : end + 1].tolist()))
        return weights @ self.y[first : end + 1]

    def tail(self, count: int) -> Start:
        """Return the last `count` rows as the start of another run."""
        return Start(self.t[-count:], self.y[-count:], self.yd[-count:])
