"""Load stepping, f(y) - (1 - p) f(y0) = 0, where Newton's method fails, and its failures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import csc_array

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.solvers.load_stepping import Released, SteppingOptions, solve_by_steps
from catenaria.solvers.newton import NewtonOptions, solve_newton


class Scalar:
    """One equation f(y) = 0 with derivative f_y."""

    newton_scale = np.array([1e-10])

    def __init__(self, f, f_y):
        self.f, self.f_y = f, f_y

    def residual(self, y):
        return np.array([self.f(y[0])])

    def jacobian(self, y):
        return csc_array(np.array([[self.f_y(y[0])]]))

    def reselect(self, y) -> Scalar | None:
        return None


def stiffening() -> Scalar:
    """Return an equation that is flat on both sides of a step, where Newton's method overshoots."""
    return Scalar(
        lambda y: y - 3.0 + 100.0 * np.tanh(20.0 * (y - 3.0)) - 99.5 * 0.999,
        lambda y: 1.0 + 2000.0 / np.cosh(min(abs(20.0 * (y - 3.0)), 300.0)) ** 2,
    )


class Pendulum:
    """A stiff bar of length 1 with a weight at its end; y[1] points down."""

    newton_scale = np.array([1e-10, 1e-10])

    def __init__(self, k, weight):
        self.k, self.weight = k, weight

    def residual(self, y):
        stretch = 0.5 * self.k * (y @ y - 1.0)
        return stretch * y - np.array([0.0, self.weight])

    def jacobian(self, y):
        stretch = 0.5 * self.k * (y @ y - 1.0)
        return csc_array(stretch * np.eye(2) + self.k * np.outer(y, y))

    def reselect(self, y):
        return None


NARROW = SteppingOptions(newton=NewtonOptions(max_iterations=8))


def test_a_pendulum_is_lowered_where_newton_fails() -> None:
    """A stretched bar held aside: Newton's method wanders about, the bar that is let go turns down."""
    problem, aside = Pendulum(1e5, 1.0), 1.01 * np.array([np.cos(0.5), np.sin(0.5)])
    with pytest.raises(NotConvergedError):
        solve_newton(problem, aside)
    released = solve_by_steps(problem, aside, NARROW)
    np.testing.assert_allclose(released.root.y, [0.0, 1.0 + 1e-5], atol=1e-8)  # weight over stiffness
    assert released.part == 1.0
    assert released.root.converged
    assert released.iterations > released.parts.size
    assert np.all(np.diff(released.parts) > 0.0)


def test_the_guess_is_kept_and_an_easy_problem_takes_few_steps() -> None:
    start = np.zeros(1)
    released = solve_by_steps(Scalar(lambda y: y**3 + y - 10.0, lambda y: 3.0 * y * y + 1.0), start)
    assert released.root.y[0] == pytest.approx(2.0)
    assert released.parts.size <= 5
    assert released.refused == 0
    assert start[0] == 0.0


def test_steps_are_shortened_where_the_way_is_steep() -> None:
    released = solve_by_steps(stiffening(), np.array([-2.0]), SteppingOptions(newton=NewtonOptions(4)))
    assert abs(stiffening().residual(released.root.y)[0]) < 1e-9
    assert released.refused > 0
    assert np.diff(released.parts).min() < 0.125


def fold(y0: float) -> Scalar:
    """Return y^2 + 1 = 0, whose path from y0 ends at y = 0, where y0^2/(1 + y0^2) is released."""
    assert y0 > 0.0
    return Scalar(lambda y: y * y + 1.0, lambda y: 2.0 * y)


@pytest.mark.parametrize("y0", [0.5, 1.0, 3.0])
def test_a_fold_ends_it_with_the_part_that_was_reached(y0: float) -> None:
    with pytest.raises(NotConvergedError, match="stuck") as caught:
        solve_by_steps(fold(y0), np.array([y0]))
    assert str(caught.value).count("Try:") == 1
    reached = caught.value.partial
    assert isinstance(reached, Released)
    part = y0**2 / (1.0 + y0**2)
    assert part - 2e-3 < reached.part <= part
    assert not reached.root.converged
    y = reached.root.y[0]
    assert y * y + 1.0 == pytest.approx((1.0 - reached.part) * (1.0 + y0**2), abs=1e-9)


def test_steps_are_limited() -> None:
    options = SteppingOptions(first=0.01, max_steps=3)
    with pytest.raises(NotConvergedError, match="made 3 steps") as caught:
        solve_by_steps(Scalar(lambda y: y - 1.0, lambda y: 1.0), np.zeros(1), options)
    partial = caught.value.partial
    assert isinstance(partial, Released)
    np.testing.assert_allclose(partial.parts, [0.01, 0.03, 0.07])
    enough = replace(options, max_steps=7)
    assert solve_by_steps(Scalar(lambda y: y - 1.0, lambda y: 1.0), np.zeros(1), enough).part == 1.0


def test_a_residual_that_is_not_finite_is_refused() -> None:
    with pytest.raises(NotConvergedError, match="not finite"):
        solve_by_steps(Scalar(lambda y: np.nan, lambda y: 1.0), np.zeros(1))


class Kink(Scalar):
    """Right of 1 the function is y - 2, left of it 3 y - 4; the state names the side."""

    def __init__(self, right):
        self.right = right
        super().__init__(
            (lambda y: y - 2.0) if right else (lambda y: 3.0 * y - 4.0), lambda y: 1.0 if right else 3.0
        )

    def reselect(self, y):
        return None if self.right == (y[0] > 1.0) else Kink(not self.right)


def test_the_discrete_state_follows() -> None:
    root = solve_by_steps(Kink(False), np.array([-3.0])).root
    assert root.y[0] == pytest.approx(2.0)
    assert isinstance(root.problem, Kink)
    assert root.problem.right


def test_a_state_without_equilibrium_shortens_the_step_too() -> None:
    class Edge(Scalar):
        def reselect(self, y):
            if y[0] > 0.4:
                raise InfeasibleError("slid off")

    with pytest.raises(NotConvergedError, match="slid off") as caught:
        solve_by_steps(Edge(lambda y: y - 1.0, lambda y: 1.0), np.zeros(1))
    partial = caught.value.partial
    assert isinstance(partial, Released)
    assert partial.part == pytest.approx(0.4, abs=1e-3)
