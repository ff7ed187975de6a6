"""The iteration in a step: what is kept, what is renewed, and what a changed leading coefficient costs."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.solvers import corrector
from catenaria.solvers.corrector import StepEquations, correct
from catenaria.solvers.error_control import NOTHING_HELD, Held, after_acceptance, after_rejection


def equations(problem, d0, t=0.3):
    """Return equations whose solution is the exact one of `forced` at t."""
    y, yd, ydd = problem.exact(t)
    return StepEquations(t, d0, yd - d0 * y, ydd - d0 * yd), y


def test_a_factorisation_is_kept_while_d0_changes_little(forced):
    problem = forced(newton=1e-6)
    problem.newton_scale[2] = 1e-2
    first, y = equations(problem, 100.0)
    start = y + 1e-3
    kept = correct(problem, first, start, None).linearisation
    near = correct(problem, equations(problem, 110.0)[0], start, kept)
    far = correct(problem, equations(problem, 140.0)[0], start, kept)
    assert near.work.factorisations == 0
    assert far.work.factorisations == 1
    for result in (near, far):
        assert result.failure is None
        assert result.y == pytest.approx(y, abs=1e-2)


@pytest.mark.parametrize("ratio", [0.9, 1.1, 1.2])
def test_contraction_with_a_kept_factorisation_is_the_predicted_one(linear, ratio, monkeypatch):
    """For y' = 0 and order 1 the spectrum is r alone, and the rate |r - 1| / (r + 1) is exact."""
    problem = linear(newton=1e-4)
    monkeypatch.setattr(problem, "A", 0.0 * problem.A)
    kept = correct(
        problem, StepEquations(0.0, 50.0, np.zeros(2), np.zeros(2)), np.ones(2), None
    ).linearisation
    result = correct(problem, StepEquations(0.0, 50.0 * ratio, np.zeros(2), np.zeros(2)), np.ones(2), kept)
    assert result.linearisation is not None
    assert result.linearisation.rate == pytest.approx(abs(ratio - 1) / (ratio + 1), rel=1e-6)


def test_negative_control_without_the_damping_the_iteration_contracts_more_slowly(linear, monkeypatch):
    problem = linear(newton=1e-2)
    monkeypatch.setattr(problem, "A", 0.0 * problem.A)
    monkeypatch.setattr(corrector, "_account_for_d0", lambda old, new, order: (1.0, 0.0))
    kept = correct(
        problem, StepEquations(0.0, 50.0, np.zeros(2), np.zeros(2)), np.ones(2), None
    ).linearisation
    result = correct(problem, StepEquations(0.0, 60.0, np.zeros(2), np.zeros(2)), np.ones(2), kept)
    assert result.linearisation is not None
    assert result.linearisation.rate > 1.5 * 0.2 / 2.2


def test_a_slow_iteration_renews_the_matrix_before_it_gives_up(pendulum):
    """Start 40 degrees from the solution: one matrix does not suffice."""
    problem = pendulum(newton=1e-10)
    y = np.array([0.0, -1.0, 5.0])
    step = StepEquations(0.0, 1.0, -y, np.zeros(3))
    result = correct(problem, step, np.array([0.64, -0.77, 5.0]), None)
    assert result.failure is None
    assert result.work.factorisations > 1
    assert result.y[0] ** 2 + result.y[1] ** 2 == pytest.approx(1.0, abs=1e-9)


def test_tested_multipliers_do_not_stop_tiny_steps(pendulum):
    """A multiplier known to m d0^2 dq = 1e4 cannot be asked for 1e-6."""
    problem = pendulum(newton=1e-10)
    problem.newton_scale[2] = 1e-6
    y, d0 = np.array([0.6, -0.8, 4.0]), 1e7
    step = StepEquations(0.0, d0, -d0 * y, np.zeros(3))
    assert correct(problem, step, y + np.array([0.0, 0.0, 1.0]), None).failure is None


@pytest.mark.parametrize(
    ("errors", "order", "held", "expected"),
    [
        ({2: 0.5}, 2, Held(9, 0.5), (2, 1.0)),  # within the band
        ({2: 1e-6}, 2, Held(1, 1e-6), (2, 2.0)),  # grows at once by the limit
        ({2: 0.1}, 2, Held(2, 0.1), (2, 1.0)),  # waits for three equal steps
        ({2: 0.1}, 2, Held(3, 0.1), (2, 0.8 * 0.1 ** (-1 / 3))),
        ({2: 0.1}, 2, Held(3, 0.6), (2, 1.0)),  # remembers a larger error
        ({2: 0.95}, 2, Held(9, 0.95), (2, 0.8 * 0.95 ** (-1 / 3))),  # shrinks at once
        ({2: 0.5, 1: 1e-4}, 2, Held(9, 0.5), (1, 2.0)),
        ({1: 0.2, 2: 1e-5}, 1, Held(1, 0.2), (2, 2.0)),
        ({2: 0.0, 1: 0.0}, 2, NOTHING_HELD, (2, 2.0)),
    ],
)
def test_choice_of_order_and_step(errors, order, held, expected):
    assert after_acceptance(errors, order, held) == pytest.approx(expected)


def test_rejected_steps_shrink_within_bounds():
    assert after_rejection(1.01, 2) == pytest.approx(0.8, rel=0.01)
    assert after_rejection(1e9, 2) == 0.25
