"""Every way to fail ends in a typed error with what was computed until then."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.solvers import Options, Solution, Start, Status, integrate

AT_REST = Start(0.0, np.array([1.0, 0.0, 0.0]), np.zeros(3))


def failure(*arguments):
    """Return the error with which an integration fails, and what was computed until then."""
    with pytest.raises(NotConvergedError) as caught:
        integrate(*arguments)
    partial = caught.value.partial
    assert isinstance(partial, Solution)
    return caught.value, partial


def test_residual_that_is_not_a_number(pendulum, monkeypatch):
    problem = pendulum()
    right = problem.residual
    monkeypatch.setattr(
        problem, "residual", lambda t, *rest: right(t, *rest) if t < 0.5 else np.full(3, np.nan)
    )
    error, partial = failure(problem, AT_REST, 1.0, Options(min_step=1e-7))
    assert partial.status is Status.STEP_FAILED
    assert "not finite" in error.reason
    assert 0.4 < partial.t[-1] < 0.5
    assert np.isfinite(partial.y).all()
    assert partial.counters.newton_failures > 5
    assert error.advice


def test_constraint_that_is_given_twice(base_problem, to_sparse):
    class Twice(base_problem):
        def residual(self, t, y, yd, ydd):
            return np.array([ydd[0] + y[1] + y[2], y[0], y[0]])

        def jacobian(self, t, y, yd, ydd, c1, c2):
            return to_sparse(np.array([[c2, 1.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))

    error, partial = failure(Twice([2, 0, 0], [1, 2], 1e-6, 1e-9), Start(0.0, np.zeros(3), np.zeros(3)), 1.0)
    assert "singular" in error.reason
    assert partial.t.size == 1


def test_solution_that_ends(base_problem, to_sparse):
    """The equation y' = y^2, y(0) = 1 has a pole at t = 1."""

    class Pole(base_problem):
        def residual(self, t, y, yd, ydd):
            return yd - y**2

        def jacobian(self, t, y, yd, ydd, c1, c2):
            return to_sparse(np.array([[c1 - 2 * y[0]]]))

    _, partial = failure(
        Pole([1], [], 1e-4, 1e-7), Start(0.0, np.ones(1), np.ones(1)), 2.0, Options(min_step=1e-6)
    )
    assert partial.status is Status.STEP_FAILED
    assert 0.9 < partial.t[-1] < 1.01


def test_too_many_steps(pendulum):
    _, partial = failure(pendulum(), AT_REST, 10.0, Options(max_steps=50))
    assert partial.status is Status.TOO_MANY_STEPS
    assert partial.counters.steps + partial.counters.rejected == 50
    assert partial.t.size == partial.counters.steps + 1


def test_constant_step_is_not_shortened(pendulum, monkeypatch):
    problem = pendulum()
    monkeypatch.setattr(problem, "residual", lambda t, y, yd, ydd: np.full(3, np.inf))
    _, partial = failure(problem, AT_REST, 1.0, Options(constant_step=0.1))
    assert partial.counters.rejected == 1
