"""Consistent starting values against closed forms; starts that violate a constraint are refused."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.solvers.bdf import integrate
from catenaria.solvers.initial_values import consistent_start, constraint_curvature, constraint_defects

GRAVITY = 9.81


def swinging(angle, speed):
    x, z = np.sin(angle), -np.cos(angle)
    return np.array([x, z, 0.0]), speed * np.array([-z, x, 0.0])


@pytest.mark.parametrize(("angle", "speed"), [(0.0, 0.0), (0.7, 2.0), (-2.5, 5.0)])
def test_multiplier_and_accelerations_of_the_pendulum(pendulum, angle, speed):
    """2 la = v^2 - g z on the unit circle."""
    y, yd = swinging(angle, speed)
    values = consistent_start(pendulum(), 0.0, y, yd)
    la = 0.5 * (speed**2 - GRAVITY * y[1])
    assert values.y == pytest.approx([y[0], y[1], la], abs=1e-8)
    assert values.ydd[:2] == pytest.approx([-2 * la * y[0], -2 * la * y[1] - GRAVITY], abs=1e-8)
    assert values.yd == pytest.approx(yd, abs=0)
    assert y[2] == 0.0


def test_curvature_term_of_the_pendulum_is_twice_the_speed_squared(pendulum):
    y, yd = swinging(0.7, 3.0)
    assert constraint_curvature(pendulum(), 0.0, y, yd) == pytest.approx([18.0], rel=1e-8)


def test_negative_control_without_the_curvature_term_the_multiplier_is_wrong(pendulum, monkeypatch):
    monkeypatch.setattr(
        "catenaria.solvers.initial_values.constraint_curvature", lambda *arguments: np.zeros(1)
    )
    y, yd = swinging(0.7, 2.0)
    values = consistent_start(pendulum(), 0.0, y, yd)
    assert abs(values.y[2] - 0.5 * (4.0 - GRAVITY * y[1])) > 1.0


@pytest.mark.parametrize("t", [0.0, 0.4])
def test_rates_of_first_order_unknowns_follow_their_rows(forced, t):
    problem = forced()
    y, yd, ydd = problem.exact(t)
    values = consistent_start(problem, t, y * [1, 1, 0, 1], yd * [1, 1, 0, 0])
    assert values.y == pytest.approx(y, abs=1e-8)
    assert values.yd[[0, 1, 3]] == pytest.approx(yd[[0, 1, 3]], abs=1e-8)
    assert values.ydd[:2] == pytest.approx(ydd[:2], abs=1e-8)


def moving_support(base_problem, to_sparse):
    """Return x'' + la = 0 with the constraint x - t^2 = 0 that contains the time."""

    class Moving(base_problem):
        def residual(self, t, y, yd, ydd):
            return np.array([ydd[0] + y[1], y[0] - t * t])

        def jacobian(self, t, y, yd, ydd, c1, c2):
            return to_sparse(np.array([[c2, 1.0], [1.0, 0.0]]))

    return Moving([2, 0], [1], 1e-6, 1e-9)


def test_constraint_that_contains_the_time(base_problem, to_sparse):
    problem = moving_support(base_problem, to_sparse)
    values = consistent_start(problem, 0.5, np.array([0.25, 0.0]), np.array([1.0, 0.0]))
    assert values.y[1] == pytest.approx(-2.0, abs=1e-4)
    with pytest.raises(InconsistentInputError, match="velocity level"):
        consistent_start(problem, 0.5, np.array([0.25, 0.0]), np.zeros(2))


def test_sliding_coordinate_gets_an_acceleration(base_problem, to_sparse):
    """A mass slides down the line z = -x; s is its arc length: x = s/sqrt2, z = -s/sqrt2."""
    e = np.array([1.0, -1.0]) / np.sqrt(2.0)

    class Slide(base_problem):
        def residual(self, t, y, yd, ydd):
            q, s, la = y[:2], y[2], y[3:]
            return np.concatenate((ydd[:2] + la + [0.0, GRAVITY], [-e @ la], q - s * e))

        def jacobian(self, t, y, yd, ydd, c1, c2):
            eye, none = np.eye(2), np.zeros((2, 1))
            return to_sparse(
                np.block(
                    [
                        [c2 * eye, none, eye],
                        [none.T, np.zeros((1, 1)), -e[None, :]],
                        [eye, -e[:, None], np.zeros((2, 2))],
                    ]
                )
            )

    problem = Slide([2, 2, 0, 0, 0], [3, 4], 1e-6, 1e-9)
    values = consistent_start(problem, 0.0, np.zeros(5), np.zeros(5))
    assert values.ydd[2] == pytest.approx(GRAVITY / np.sqrt(2.0))
    assert values.ydd[:2] == pytest.approx(GRAVITY / np.sqrt(2.0) * e)
    assert values.y[3:] == pytest.approx([-GRAVITY / 2, -GRAVITY / 2])
    solution = integrate(problem, values.start, 1.0)
    assert solution.y[-1, 2] == pytest.approx(0.5 * GRAVITY / np.sqrt(2.0), abs=1e-3)


def test_defects_are_reported(pendulum):
    y, yd = swinging(0.3, 1.0)
    defects = constraint_defects(pendulum(), 0.0, 1.01 * y, yd + 0.1 * y)
    assert defects.position == pytest.approx([1.01**2 - 1.0])
    assert defects.velocity == pytest.approx([2 * 1.01 * 0.1])


@pytest.mark.parametrize(
    ("factor", "radial", "level"), [(1.001, 0.0, "position level"), (1.0, 0.01, "velocity level")]
)
def test_start_off_the_constraint_is_refused(pendulum, factor, radial, level):
    y, yd = swinging(0.3, 1.0)
    with pytest.raises(InconsistentInputError, match=level):
        consistent_start(pendulum(), 0.0, factor * y, yd + radial * y)


def test_constraints_that_repeat_each_other_are_refused(base_problem, to_sparse):
    class Twice(base_problem):
        def residual(self, t, y, yd, ydd):
            return np.array([ydd[0] + y[1] + y[2], y[0], y[0]])

        def jacobian(self, t, y, yd, ydd, c1, c2):
            return to_sparse(np.array([[c2, 1.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))

    with pytest.raises(NotConvergedError, match="singular"):
        consistent_start(Twice([2, 0, 0], [1, 2], 1e-6, 1e-9), 0.0, np.zeros(3), np.zeros(3))
