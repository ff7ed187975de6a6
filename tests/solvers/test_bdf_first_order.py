"""Stiff systems of first order and an index-1 problem with an algebraic row that is no constraint."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from catenaria.solvers import Options, Start, integrate

RATES = (0.04, 1e4, 3e7)
FIRST = np.array([1.0, 0.0, 0.0])


def robertson_ode(t, y):
    a, b, c = RATES
    fast = b * y[1] * y[2]
    return np.array([-a * y[0] + fast, a * y[0] - fast - c * y[1] ** 2, c * y[1] ** 2])


@pytest.fixture
def robertson(base_problem, to_sparse):
    """Robertson 1966 with the third equation replaced by the sum of the concentrations."""

    class Robertson(base_problem):
        def __init__(self):
            super().__init__([1, 1, 0], [], 1.0, 1.0)
            self.error_scale = np.array([1e-6, 1e-10, np.inf])
            self.newton_scale = 1e-2 * np.array([1e-6, 1e-10, 1e-6])

        def residual(self, t, y, yd, ydd):
            rates = robertson_ode(t, y)
            return np.array([yd[0] - rates[0], yd[1] - rates[1], y.sum() - 1.0])

        def jacobian(self, t, y, yd, ydd, c1, c2):
            a, b, c = RATES
            return to_sparse(
                np.array(
                    [
                        [c1 + a, -b * y[2], -b * y[1]],
                        [-a, c1 + b * y[2] + 2 * c * y[1], b * y[1]],
                        [1.0, 1.0, 1.0],
                    ]
                )
            )

    return Robertson()


def test_stiff_linear_system_follows_its_smooth_solution(linear):
    problem = linear(error=1e-6, newton=1e-9)
    solution = integrate(problem, Start(0.0, np.array([0.0, 1.0]), np.array([1.0, 0.0])), 10.0)
    assert np.abs(solution.y - problem.exact(solution.t)).max() < 3e-4
    assert solution.counters.steps < 1500  # an explicit method needs 5000 for stability


@pytest.mark.parametrize("max_order", [2, 5])
def test_stiff_transient_is_resolved_then_left_behind(linear, max_order):
    """The deviation (1, -1) decays like exp(-1000 t)."""
    problem = linear(error=1e-5, newton=1e-8)
    begin = Start(0.0, np.array([1.0, 0.0]), np.array([-999.0, 1000.0]))
    solution = integrate(problem, begin, 1.0, Options(max_order=max_order))
    expected = problem.exact(solution.t) + np.exp(-1000 * solution.t)[:, None] * np.array([1.0, -1.0])
    assert np.abs(solution.y - expected).max() < 1e-3
    assert solution.h.max() > 100 * solution.h[1:20].min()


@pytest.mark.parametrize("max_order", [2, 5])
def test_robertson_agrees_with_an_implicit_runge_kutta_method(robertson, max_order):
    solution = integrate(
        robertson, Start(0.0, FIRST, robertson_ode(0.0, FIRST)), 400.0, Options(max_order=max_order)
    )
    reference = solve_ivp(robertson_ode, (0.0, 400.0), FIRST, method="Radau", rtol=1e-9, atol=1e-13)
    assert solution.y[-1] == pytest.approx(reference.y[:, -1], rel=1e-3)
    assert np.abs(solution.y.sum(axis=1) - 1.0).max() < 1e-8
    assert solution.counters.steps < {2: 600, 5: 250}[max_order]
    assert solution.counters.factorisations < {2: 200, 5: 150}[max_order]
