"""Order of convergence of each formula with constant steps on an index-3 problem with a known solution."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.solvers import Options, Start, bdf, integrate

POSITION, MULTIPLIER, PARAMETER = [0, 1], [2], [3]


def largest_errors(problem, order, h, window=(2.0, 4.0)):
    """Return the largest errors of q, q', la and p in a time window after a start from exact history."""
    t = -h * np.arange(order, -1, -1)
    y, yd, _ = problem.exact(t)
    solution = integrate(
        problem, Start(t, y, yd), window[1], Options(max_order=order, constant_step=h, max_steps=10_000)
    )
    assert set(solution.order[order + 1 :]) == {order}
    inside = solution.t >= window[0]
    y, yd, _ = problem.exact(solution.t[inside])
    dy = np.abs(solution.y[inside] - y).max(axis=0)
    dyd = np.abs(solution.yd[inside] - yd).max(axis=0)
    return np.array([dy[POSITION].max(), dyd[POSITION].max(), dy[MULTIPLIER].max(), dy[PARAMETER].max()])


def slopes(problem, order, h):
    """Return the observed orders between steps 2 h and h, and the errors for h."""
    coarse, fine = largest_errors(problem, order, 2 * h), largest_errors(problem, order, h)
    return np.log2(coarse / fine), fine


@pytest.mark.parametrize(
    ("order", "h", "cap"),
    [(1, 0.005, 4e-2), (2, 0.01, 1e-3), (3, 0.02, 1e-4), (4, 0.02, 4e-6), (5, 0.04, 4e-6)],
)
def test_q_qd_multiplier_and_parameter_converge_with_the_order_of_the_formula(forced, order, h, cap):
    observed, errors = slopes(forced(), order, h)
    assert observed == pytest.approx(order, abs=0.2)
    assert errors.max() < cap


@pytest.mark.parametrize(("order", "h"), [(1, 0.005), (2, 0.01), (3, 0.02), (4, 0.02), (5, 0.04)])
def test_negative_control_a_wrong_coefficient_loses_the_order(forced, monkeypatch, order, h):
    right = bdf.derivative_weights

    def wrong(t, past):
        d0, d = right(t, past)
        return d0, d * (1.0 + 1e-4 * (np.arange(d.size) == d.size - 1))

    monkeypatch.setattr(bdf, "derivative_weights", wrong)
    observed, _ = slopes(forced(), order, h)
    assert np.abs(observed - order).max() > 0.4


@pytest.fixture
def prescribed(base_problem, to_sparse):
    """Return x'' + la = 0 with x - sin t = 0, whose multiplier is sin t."""

    class Prescribed(base_problem):
        def residual(self, t, y, yd, ydd):
            return np.array([ydd[0] + y[1], y[0] - np.sin(t)])

        def jacobian(self, t, y, yd, ydd, c1, c2):
            return to_sparse(np.array([[c2, 1.0], [1.0, 0.0]]))

    return Prescribed([2, 0], [1], 1.0, 1e-14)


def multipliers_after_a_change(problem, order, h, ratio):
    """Return la of the first steps of length ratio h after steps h up to t = 1, relative to the exact one."""
    t = 1.0 - h * np.arange(40 + order, 39, -1)
    start = Start(t, np.stack([np.sin(t), np.sin(t)], axis=-1), np.stack([np.cos(t), np.cos(t)], axis=-1))
    before = integrate(problem, start, 1.0, Options(max_order=order, constant_step=h))
    after = integrate(
        problem, before.tail(order), 1.0 + 6 * ratio * h, Options(max_order=order, constant_step=ratio * h)
    )
    return (after.y[:, 1] / np.sin(after.t))[order:]


@pytest.mark.parametrize("ratio", [0.5, 2.0, 4.0])
def test_after_a_step_change_implicit_euler_reads_a_wrong_multiplier_once(prescribed, ratio):
    """The first one is (1 + 1/ratio) / 2 of the true one, whatever h is; the next ones are right again."""
    seen = multipliers_after_a_change(prescribed, 1, 1e-3, ratio)
    assert seen[0] == pytest.approx((1.0 + 1.0 / ratio) / 2.0, rel=0.01)
    assert seen[1:] == pytest.approx(np.ones(5), rel=0.01)


def test_after_a_step_change_order_2_loses_one_order_in_the_multipliers_for_three_steps(prescribed):
    """Error O(h) as long as the formula contains the rate of the first step, O(h^2) afterwards."""
    errors = [np.abs(multipliers_after_a_change(prescribed, 2, h, 2.0) - 1.0) for h in (4e-3, 2e-3)]
    slope = np.log2(errors[0] / errors[1])
    assert slope[:3] == pytest.approx(np.ones(3), abs=0.3)
    assert slope[3:] == pytest.approx(2.0 * np.ones(3), abs=0.1)
