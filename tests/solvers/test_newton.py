"""Newton-Raphson: quadratic convergence, damping, discrete states, typed failures."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_array

from catenaria.errors import InconsistentInputError, InfeasibleError, NotConvergedError
from catenaria.solvers.newton import NewtonOptions, Root, solve_newton


class Scalar:
    """One equation f(y) = 0 with derivative f_y."""

    newton_scale = np.array([1e-10])

    def __init__(self, f, f_y):
        self.f, self.f_y = f, f_y
        self.residuals = 0

    def residual(self, y):
        self.residuals += 1
        return np.array([self.f(y[0])])

    def jacobian(self, y):
        return csc_array(np.array([[self.f_y(y[0])]]))

    def reselect(self, y) -> Scalar | None:
        return None


class Broyden:
    """Tridiagonal function of Broyden 1965: (3 - 2 y_i) y_i - y_{i-1} - 2 y_{i+1} + 1 = 0."""

    def __init__(self, n, row_factor):
        self.newton_scale = np.full(n, 1e-12)
        self.factor = np.where(np.arange(n) % 2, row_factor, 1.0)

    def residual(self, y):
        inner = np.concatenate(([0.0], y, [0.0]))
        return self.factor * ((3 - 2 * y) * y - inner[:-2] - 2 * inner[2:] + 1)

    def jacobian(self, y):
        n = y.size
        full = np.diag(3 - 4 * y) - np.diag(np.ones(n - 1), -1) - 2 * np.diag(np.ones(n - 1), 1)
        return csc_array(self.factor[:, None] * full)

    def reselect(self, y):
        return None


@pytest.mark.parametrize("row_factor", [1.0, 1e8])
def test_convergence_is_quadratic_and_does_not_depend_on_row_scaling(row_factor):
    problem = Broyden(100, row_factor)
    start = -np.ones(100)
    root = solve_newton(problem, start)
    assert root.converged
    assert np.abs(problem.residual(root.y) / problem.factor).max() < 1e-13
    assert root.corrections.size <= 5
    size = root.corrections * 1e-12
    assert size[-1] < 3 * size[-2] ** 2 + 1e-15
    assert (root.damping == 1.0).all()
    assert (start == -1.0).all()


def test_negative_control_a_wrong_jacobian_is_not_quadratic(monkeypatch):
    problem = Broyden(100, 1.0)
    right = problem.jacobian
    monkeypatch.setattr(problem, "jacobian", lambda y: 1.1 * right(y))
    assert solve_newton(problem, -np.ones(100)).corrections.size > 6


def test_damping_saves_an_iteration_that_would_diverge():
    """Undamped Newton for arctan(y) = 0 diverges from |y| > 1.3917."""
    root = solve_newton(Scalar(np.arctan, lambda y: 1.0 / (1.0 + y * y)), np.array([10.0]))
    assert root.y[0] == pytest.approx(0.0, abs=1e-12)
    assert root.damping[0] < 1.0
    assert root.damping[-1] == 1.0


def test_discrete_state_follows_the_iterates():
    """Right of 1 the function is y - 2, left of it 3 y - 4; the state names the side."""

    class Kink(Scalar):
        def __init__(self, right):
            super().__init__(
                (lambda y: y - 2.0) if right else (lambda y: 3.0 * y - 4.0), lambda y: 1.0 if right else 3.0
            )
            self.right = right

        def reselect(self, y):
            return None if self.right == (y[0] > 1.0) else Kink(not self.right)

    root = solve_newton(Kink(False), np.array([-3.0]))
    assert root.y[0] == pytest.approx(2.0)
    assert isinstance(root.problem, Kink)
    assert root.problem.right


class Counting(Scalar):
    """Counts its Jacobians."""

    def __init__(self, f, f_y):
        super().__init__(f, f_y)
        self.jacobians = 0

    def jacobian(self, y):
        self.jacobians += 1
        return super().jacobian(y)


def test_a_full_step_that_the_test_refuses_is_made_if_it_is_good():
    """From a slope of 0.1 beyond a kink to one of 10: the old slope finds the step bad, the new one good."""
    f, f_y = (lambda y: 10.0 * y if y < 0.0 else 0.1 * y), (lambda y: 10.0 if y < 0.0 else 0.1)
    kinked = Counting(lambda y: f(y - 1.0) + 0.5, lambda y: f_y(y - 1.0))
    root = solve_newton(kinked, np.array([4.0]))
    assert root.y[0] == pytest.approx(0.95, abs=1e-12)
    np.testing.assert_array_equal(root.damping, 1.0)


def cube(shift):
    return Counting(lambda y: y**3 - shift, lambda y: 3.0 * y * y)


def test_factors_are_kept_where_they_contract_well():
    near = cube(8.0)
    root = solve_newton(near, np.array([2.001]))
    assert root.y[0] == pytest.approx(2.0, abs=1e-12)
    assert near.jacobians == 1
    assert root.simplified > 0
    assert root.iterations == root.corrections.size + root.simplified


def test_factors_are_renewed_where_they_do_not():
    far = cube(8.0)
    root = solve_newton(far, np.array([4.0]))
    assert root.y[0] == pytest.approx(2.0, abs=1e-12)
    assert far.jacobians > 2


def test_a_trial_outside_of_what_is_possible_is_damped():
    """Newton's step from 0.5 leads to 11; only up to 6 there is anything."""

    class Bounded(Scalar):
        def __init__(self, end):
            super().__init__(lambda y: y**3 - 8.0, lambda y: 3.0 * y * y)
            self.end = end

        def reselect(self, y):
            if y[0] > self.end:
                raise InfeasibleError("beyond the end")

    root = solve_newton(Bounded(6.0), np.array([0.5]))
    assert root.y[0] == pytest.approx(2.0)
    with pytest.raises(InfeasibleError, match="beyond the end"):
        solve_newton(Bounded(1.0), np.array([0.5]))


@pytest.mark.parametrize(
    ("f", "f_y", "y", "complaint"),
    [
        (lambda y: y * y + 1.0, lambda y: 2.0 * y, 0.0, "singular"),
        (lambda y: y * y + 1.0, lambda y: 2.0 * y, 0.3, "no damping|iterations"),
        (lambda y: np.nan, lambda y: 1.0, 0.5, "not finite"),
    ],
)
def test_failures_carry_their_reason_and_the_last_iterate(f, f_y, y, complaint):
    with pytest.raises(NotConvergedError, match=complaint) as caught:
        solve_newton(Scalar(f, f_y), np.array([y]))
    partial = caught.value.partial
    assert isinstance(partial, Root)
    assert not partial.converged
    assert np.isfinite(partial.y).all()


def test_iterations_are_limited():
    problem = Scalar(lambda y: y**3, lambda y: 3.0 * y * y)
    with pytest.raises(NotConvergedError, match="3 iterations") as caught:
        solve_newton(problem, np.ones(1), NewtonOptions(max_iterations=3))
    partial = caught.value.partial
    assert isinstance(partial, Root)
    assert partial.corrections.size == 3


def test_the_first_factors_are_shown_and_may_be_refused():
    """Only the first ones, before a step is made."""
    problem, seen = Broyden(20, 1.0), []
    solve_newton(problem, -np.ones(20), inspect=lambda matrix, lu: seen.append((matrix, lu)))
    (matrix, lu) = seen[0]
    assert len(seen) == 1
    np.testing.assert_array_equal(matrix.toarray(), problem.jacobian(-np.ones(20)).toarray())
    np.testing.assert_allclose(matrix @ lu.solve(np.ones(20)), np.ones(20))

    def refuse(matrix, lu):
        raise InconsistentInputError("not this one")

    with pytest.raises(InconsistentInputError, match="not this one"):
        solve_newton(problem, -np.ones(20), inspect=refuse)
