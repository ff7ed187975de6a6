"""Variable-step, variable-coefficient BDF for F(t, y, y', y'') = 0 up to index 3, eqs. (24)-(27).

The state of an integration is a value; `attempt` maps it to the next one and `integrate` drives it.
Velocities are eliminated: y' is the formula applied to y, y'' the same formula applied to y', and a step
solves for y only.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple, NoReturn

import numpy as np

from catenaria.errors import NotConvergedError
from catenaria.solvers.bdf_coefficients import derivative_weights, extrapolation_weights
from catenaria.solvers.bdf_state import State, begin
from catenaria.solvers.corrector import Correction, StepEquations, correct
from catenaria.solvers.error_control import NOTHING_HELD, after_acceptance, after_rejection, local_error
from catenaria.solvers.outcome import Counters, Options, Solution, Start, Status, Step
from catenaria.solvers.problem import DaeProblem, FloatArray

Observer = Callable[[Step], None]
StopRule = Callable[[Step], str | None]


def integrate(
    problem: DaeProblem,
    start: Start,
    t_end: float,
    options: Options | None = None,
    observers: Sequence[Observer] = (),
    stop: StopRule | None = None,
) -> Solution:
    """Integrate a differential-algebraic system from a consistent start.

    Parameters
    ----------
    problem : DaeProblem
        The system, with the discrete state that fits the start.
    start : Start
        Consistent state, or table of past states.
    t_end : float
        Where to end [s].
    options : Options, optional
        Orders, steps and limits.
    observers : sequence of callable
        Called with each accepted step.
    stop : callable, optional
        Called with each accepted step; a reason that it returns ends the integration.

    Returns
    -------
    Solution

    Raises
    ------
    InconsistentInputError
        If start, end and options contradict each other.
    NotConvergedError
        If the step becomes too small or there are too many of them; `partial` is the solution until then.

    Examples
    --------
    The equation y' + y = 0:

    >>> from scipy.sparse import csc_array
    >>> class Decay:
    ...     size, order_of, constraint = 1, np.array([1], dtype=np.int8), np.array([False])
    ...     error_scale, newton_scale = np.array([1e-6]), np.array([1e-9])
    ...
    ...     def residual(self, t, y, yd, ydd):
    ...         return yd + y
    ...
    ...     def jacobian(self, t, y, yd, ydd, c1, c2):
    ...         return csc_array([[1.0 + c1]])
    ...
    ...     def reselect(self, y):
    ...         return None
    >>> solution = integrate(Decay(), Start(0.0, np.array([1.0]), np.array([-1.0])), 1.0)
    >>> bool(abs(solution.y[-1, 0] - np.exp(-1.0)) < 1e-4), solution.status.name
    (True, 'END_REACHED')

    References
    ----------
    Brenan, Campbell & Petzold 1996, Numerical Solution of Initial-Value Problems in DAEs, chapter 5.
    """
    options = options or Options()
    state = begin(problem, start, t_end, options)
    rows: list[_Row] = []
    while state.history.t[0] < t_end:
        if state.counters.steps + state.counters.rejected >= options.max_steps:
            _give_up(start, rows, state, Status.TOO_MANY_STEPS)
        state = attempt(state, t_end, options)
        if state.accepted is None:
            if options.constant_step is not None or state.h < _smallest_step(state.history.t[0], options):
                _give_up(start, rows, state, Status.STEP_FAILED)
            continue
        rows.append(_Row.of(state.accepted))
        for observe in observers:
            observe(state.accepted)
        reason = stop(state.accepted) if stop is not None else None
        if reason is not None:
            return _solution(start, rows, state, Status.STOPPED, reason)
    return _solution(start, rows, state, Status.END_REACHED, Status.END_REACHED.value)


class _Row(NamedTuple):
    """What is kept of an accepted step; its problem may hold megabytes of patterns."""

    t: float
    h: float
    order: int
    y: FloatArray
    yd: FloatArray

    @classmethod
    def of(cls, step: Step) -> _Row:
        return cls(step.t, step.h, step.order, step.y, step.yd)


def attempt(state: State, t_end: float, options: Options) -> State:
    """Try one step and return the state after it, with `accepted` set or with a shorter step to try."""
    history, k = state.history, state.order
    t, h = _next_time(history.t[0], state.h, t_end, options)
    d0, d = derivative_weights(t, history.t[:k])
    equations = StepEquations(t, d0, d @ history.y[:k], d @ history.yd[:k], options.permc_spec)
    predicted = extrapolation_weights(t, history.t[: k + 1]) @ history.y[: k + 1]
    correction = correct(state.problem, equations, predicted, state.linearisation)
    state = replace(
        state,
        linearisation=correction.linearisation,
        counters=state.counters.plus(correction.work),
        accepted=None,
    )
    if correction.failure is not None:
        return _after_newton_failure(state, h, correction.failure)
    if options.constant_step is None:
        inverse_scale = 1.0 / correction.problem.error_scale
        error = local_error(t, correction.y, history.t, history.y, k, inverse_scale)
        if error > 1.0:
            return _after_error_failure(state, h, error)
        state = _choose_next(state, t, h, correction.y, error, inverse_scale, options)
    return _accept(state, h, k, equations, correction, options)


def _next_time(t: float, h: float, t_end: float, options: Options) -> tuple[float, float]:
    """Return end and length of a step that neither passes t_end nor leaves a sliver before it.

    A sliver would spoil the multipliers: their error grows with the ratio of neighbouring steps.
    """
    remaining = t_end - t
    if remaining <= h * (1.0 + 1e-6):
        return t_end, remaining
    if options.constant_step is None and 2.0 * h > remaining:
        h = 0.5 * remaining
    return t + h, h


def _smallest_step(t: float, options: Options) -> float:
    return max(options.min_step, 16.0 * float(np.spacing(abs(t))))


def _after_newton_failure(state: State, h: float, failure: str) -> State:
    """Halve the step; quarter it at the next failure, and so on: a first step may be wrong by decades."""
    failures = state.failures + 1
    return replace(
        state,
        h=0.5**failures * h,
        counters=state.counters.plus(Counters(rejected=1, newton_failures=1)),
        held=NOTHING_HELD,
        failures=failures,
        complaint=failure,
    )


def _after_error_failure(state: State, h: float, error: float) -> State:
    """Shorten the step; after three failures the past is not believed any more and order 1 begins anew."""
    failures = state.failures + 1
    ratio, order = (after_rejection(error, state.order), state.order) if failures < 3 else (0.25, 1)
    return replace(
        state,
        h=ratio * h,
        order=order,
        counters=state.counters.plus(Counters(rejected=1)),
        held=NOTHING_HELD,
        failures=failures,
        complaint=f"the local error is {error:.3g} times what is allowed",
    )


def _choose_next(
    state: State, t: float, h: float, y: FloatArray, error: float, inverse_scale: FloatArray, options: Options
) -> State:
    """Set order and length of the step after an accepted one."""
    history, k = state.history, state.order
    highest = min(options.max_order, state.points - 1)
    errors = {
        order: local_error(t, y, history.t, history.y, order, inverse_scale)
        for order in (k - 1, k + 1)
        if 1 <= order <= highest
    }
    held = state.held.after(error)
    order, ratio = after_acceptance({k: error, **errors}, k, held)
    if state.failures:
        ratio = min(ratio, 1.0)
    next_h = min(max(ratio * h, _smallest_step(t, options)), options.max_step)
    return replace(state, h=next_h, order=order, held=held if (order, next_h) == (k, h) else NOTHING_HELD)


def _accept(
    state: State, h: float, order: int, equations: StepEquations, correction: Correction, options: Options
) -> State:
    """Return the state after an accepted step of the given length and order."""
    yd, ydd = equations.rates(correction.y)
    for array in (correction.y, yd, ydd):
        array.flags.writeable = False
    counters = state.counters.plus(Counters(steps=1))
    step = Step(counters.steps, equations.t, h, order, correction.y, yd, ydd, counters, correction.problem)
    points = min(state.points + 1, options.max_order + 1)
    return replace(
        state,
        history=state.history.pushed(equations.t, correction.y, yd, points),
        points=points,
        problem=correction.problem,
        order=state.order if options.constant_step is None else min(options.max_order, points),
        counters=counters,
        failures=0,
        accepted=step,
        complaint="",
    )


def _solution(start: Start, rows: list[_Row], state: State, status: Status, reason: str) -> Solution:
    """Collect the rows of the start and the accepted steps."""
    t, y, yd = np.atleast_1d(start.t), np.atleast_2d(start.y), np.atleast_2d(start.yd)
    given = t.size
    return Solution(
        t=np.concatenate((t, [row.t for row in rows])),
        y=np.vstack((y, *(row.y for row in rows))),
        yd=np.vstack((yd, *(row.yd for row in rows))),
        h=np.array([0.0] * given + [row.h for row in rows]),
        order=np.array([0] * given + [row.order for row in rows]),
        counters=state.counters,
        status=status,
        reason=reason,
        problem=state.problem,
    )


def _give_up(start: Start, rows: list[_Row], state: State, status: Status) -> NoReturn:
    reason = f"At t = {state.history.t[0]:.6g} s {status.value} (next step {state.h:.3g} s)"
    if state.complaint:
        reason = f"{reason}: {state.complaint}"
    advice = {
        Status.STEP_FAILED: "consistent starting values, a wider error or Newton scale, smoother inputs",
        Status.TOO_MANY_STEPS: "a larger max_steps, a wider error scale, an earlier end",
    }[status]
    raise NotConvergedError(reason, advice, _solution(start, rows, state, status, reason))
