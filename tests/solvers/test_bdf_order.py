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


def accelerations_after_a_change(problem, order, h, ratio):
    """Return x'' of the first steps of length ratio h after a run with steps h, relative to the exact one."""
    t = -h * np.arange(order, -1, -1)
    y, yd, _ = problem.exact(t)
    options = Options(max_order=order, constant_step=h)
    before = integrate(problem, Start(t, y, yd), 40 * h, options)
    seen = []

    def watch(step):
        seen.append(step.ydd[0] / problem.exact(step.t)[2][0])

    options = Options(max_order=order, constant_step=ratio * h)
    start = before.tail(order + 1)
    integrate(problem, start, start.t[-1] + 4 * ratio * h, options, observers=(watch,))
    return np.array(seen)


@pytest.mark.parametrize("ratio", [0.5, 2.0, 4.0])
def test_after_a_step_change_implicit_euler_reads_a_wrong_acceleration_once(forced, ratio):
    """The first one is (1 + 1/ratio) / 2 of the true one, whatever h is; the next ones are right again."""
    seen = accelerations_after_a_change(forced(), 1, 0.02 / ratio, ratio)
    assert seen[0] == pytest.approx((1.0 + 1.0 / ratio) / 2.0, rel=0.05)
    assert seen[1:] == pytest.approx(np.ones(3), rel=0.15)


def test_after_a_step_change_order_2_loses_one_order_in_the_multipliers_for_two_steps(forced):
    """Error of the acceleration O(h) in the two steps after the change, O(h^2) before and afterwards."""
    errors = [np.abs(accelerations_after_a_change(forced(), 2, h, 2.0) - 1.0) for h in (2e-3, 1e-3)]
    changed = np.log2(errors[0] / errors[1])
    assert changed[:2] == pytest.approx([1.0, 1.0], abs=0.35)
    unchanged = [np.abs(accelerations_after_a_change(forced(), 2, h, 1.0) - 1.0) for h in (2e-3, 1e-3)]
    assert (errors[1][:2] > 5.0 * unchanged[1][:2]).all()
