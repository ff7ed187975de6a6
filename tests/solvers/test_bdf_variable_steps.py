"""Error control, work, dense output, continuation and steering of runs with variable steps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.solvers import Options, Start, Status, integrate

AT_REST = Start(0.0, np.array([1.0, 0.0, 0.0]), np.zeros(3))


def start_of(problem):
    y, yd, _ = problem.exact(0.0)
    return Start(0.0, y, yd)


def largest_error(problem, max_order):
    solution = integrate(problem, start_of(problem), 5.0, Options(max_order=max_order))
    y, _, _ = problem.exact(solution.t)
    return np.abs(solution.y - y)[:, [0, 1, 3]].max()


@pytest.mark.parametrize("max_order", [1, 2, 3])
def test_error_follows_the_tolerance(forced, max_order):
    """Error per step control: the error goes like tolerance^(k/(k+1))."""
    tolerances = np.array([1e-4, 1e-6]) if max_order > 1 else np.array([1e-3, 1e-5])
    errors = [largest_error(forced(error, 1e-3 * error), max_order) for error in tolerances]
    power = np.log(errors[0] / errors[1]) / np.log(tolerances[0] / tolerances[1])
    assert power == pytest.approx(max_order / (max_order + 1), abs=0.2)
    assert errors[0] < 300 * tolerances[0]


def test_work_is_bounded(forced):
    problem = forced(1e-6, 1e-7)
    counters = integrate(problem, start_of(problem), 5.0).counters
    assert counters.steps < 1000
    assert counters.rejected < 0.05 * counters.steps
    assert counters.newton_failures == 0
    assert counters.residuals < 2.2 * counters.steps
    assert counters.jacobians == counters.factorisations < 0.1 * counters.steps


def test_negative_control_a_wrong_jacobian_costs_more_work_than_the_bounds(forced, monkeypatch):
    problem = forced(1e-6, 1e-7)
    right = problem.jacobian

    def wrong(*arguments):
        matrix = right(*arguments)
        matrix.data[0] *= 3.0
        return matrix

    monkeypatch.setattr(problem, "jacobian", wrong)
    counters = integrate(problem, start_of(problem), 5.0).counters
    assert counters.residuals > 2.2 * counters.steps


def test_dense_output_is_continuous_and_as_accurate_as_the_steps(forced):
    problem = forced(1e-6, 1e-9)
    solution = integrate(problem, start_of(problem), 5.0, Options(max_order=3))
    for t, y in zip(solution.t[1:-1:7], solution.y[1:-1:7], strict=True):
        assert solution(t) == pytest.approx(y, abs=1e-13)
        assert solution(np.nextafter(t, 9.0)) == pytest.approx(y, abs=1e-11)
    middle = 0.5 * (solution.t[1:] + solution.t[:-1])
    y, _, _ = problem.exact(middle)
    dense = np.array([solution(t) for t in middle])
    at_ends = np.abs(solution.y - problem.exact(solution.t)[0])[:, :2].max()
    assert np.abs(dense - y)[:, :2].max() < 1.5 * at_ends
    with pytest.raises(ValueError, match="outside"):
        solution(5.1)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_dense_output_has_the_order_of_the_formula_plus_one(forced, order):
    """Interpolation error alone: rows of the solution are replaced by exact values."""
    problem, errors = forced(), []
    for h in (0.1, 0.05):
        t = np.arange(-order, 1) * h
        y, yd, _ = problem.exact(t)
        solution = integrate(problem, Start(t, y, yd), 3.0, Options(max_order=order, constant_step=h))
        solution = replace(solution, y=problem.exact(solution.t)[0])
        middle = 0.5 * (solution.t[order + 1 :] + solution.t[order:-1])
        dense = np.array([solution(value) for value in middle])
        errors.append(np.abs(dense - problem.exact(middle)[0])[:, 0].max())
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order + 1, abs=0.2)


def test_a_continued_run_goes_on_like_an_uninterrupted_one(forced):
    problem = forced(1e-6, 1e-9)
    whole = integrate(problem, start_of(problem), 4.0)
    first = integrate(problem, start_of(problem), 2.0)
    second = integrate(problem, first.tail(3), 4.0)
    assert second.t[2] == first.t[-1]
    assert list(second.order[:4]) == [0, 0, 0, 2]
    assert second.counters.rejected <= 2
    assert second.y[-1, [0, 1, 3]] == pytest.approx(whole.y[-1, [0, 1, 3]], abs=1e-4)
    assert second.y[-1, 2] == pytest.approx(whole.y[-1, 2], abs=5e-3)


def test_observers_see_every_accepted_step_once_and_in_order(pendulum):
    seen = []
    solution = integrate(pendulum(), AT_REST, 2.0, observers=(seen.append,))
    assert [step.number for step in seen] == list(range(1, solution.t.size))
    assert (np.diff([step.t for step in seen]) > 0.0).all()
    assert np.array([step.t for step in seen]) == pytest.approx(solution.t[1:], rel=0, abs=0)
    assert seen[-1].counters == solution.counters
    assert solution.t[-1] == 2.0
    assert solution.status is Status.END_REACHED
    with pytest.raises(ValueError, match="read-only"):
        seen[0].y[0] = 1.0


def test_derivatives_of_a_step_solve_the_equations(forced):
    problem, worst = forced(1e-5, 1e-12), []

    def watch(step):
        worst.append(np.abs(problem.residual(step.t, step.y, step.yd, step.ydd)).max())

    integrate(problem, start_of(problem), 1.0, Options(initial_step=1e-3), observers=(watch,))
    assert len(worst) > 20
    assert max(worst) < 1e-5


def test_stop_ends_the_run_with_its_reason(pendulum):
    solution = integrate(
        pendulum(), AT_REST, 5.0, stop=lambda step: "passed the middle" if step.y[0] < 0.0 else None
    )
    assert solution.status is Status.STOPPED
    assert solution.reason == "passed the middle"
    assert solution.y[-2, 0] >= 0.0 > solution.y[-1, 0]


def test_steps_stay_below_their_limit(pendulum):
    solution = integrate(pendulum(error=1e-2), AT_REST, 2.0, Options(max_step=0.01))
    assert solution.h.max() <= 0.01 * (1 + 1e-12)


def test_a_constant_step_is_kept_to_the_end(pendulum):
    solution = integrate(pendulum(), AT_REST, 1.0, Options(max_order=3, constant_step=0.01))
    assert solution.h[1:] == pytest.approx(0.01)
    assert list(solution.order[:5]) == [0, 1, 2, 3, 3]


@pytest.mark.parametrize(
    ("start", "t_end", "options", "complaint"),
    [
        (Start(0.0, np.zeros(2), np.zeros(2)), 1.0, Options(), "shape"),
        (Start(0.0, np.full(3, np.nan), np.zeros(3)), 1.0, Options(), "not finite"),
        (Start(np.array([0.0, 0.0]), np.zeros((2, 3)), np.zeros((2, 3))), 1.0, Options(), "ascend"),
        (AT_REST, 0.0, Options(), "t_end"),
        (AT_REST, np.inf, Options(), "t_end"),
        (AT_REST, 1.0, Options(max_order=6), "max_order"),
        (AT_REST, 1.0, Options(initial_step=0.0), "step length"),
    ],
)
def test_contradictory_input_is_refused(pendulum, start, t_end, options, complaint):
    with pytest.raises(InconsistentInputError, match=complaint):
        integrate(pendulum(), start, t_end, options)
