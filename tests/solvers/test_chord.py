"""The simplified Newton method against roots that are known, and where it must give up."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_array

from catenaria.errors import InfeasibleError
from catenaria.solvers.chord import solve_chord
from catenaria.solvers.linear import factorise

SCALE = 1e-12


class Circle:
    """x^2 + y^2 = 2, x = y, with a root at (1, 1); counts evaluations."""

    newton_scale = np.full(2, SCALE)

    def __init__(self) -> None:
        self.count = 0

    def residual(self, y: np.ndarray) -> np.ndarray:
        self.count += 1
        return np.array([y @ y - 2.0, y[0] - y[1]])

    def jacobian(self, y: np.ndarray) -> csc_array:
        return csc_array([[2.0 * y[0], 2.0 * y[1]], [1.0, -1.0]])

    def reselect(self, y: np.ndarray) -> None:
        return None


def test_finds_a_root_with_factors_from_nearby() -> None:
    problem, start = Circle(), np.array([1.02, 1.01])
    root = solve_chord(problem, start, factorise(problem.jacobian(start)))
    assert root is not None
    assert np.abs(root - 1.0).max() < SCALE
    assert start.tolist() == [1.02, 1.01]


@pytest.mark.parametrize(("distance", "most"), [(1e-3, 6), (1e-6, 4)])
def test_takes_fewer_corrections_the_nearer_the_factors_are(distance: float, most: int) -> None:
    problem = Circle()
    factors = factorise(problem.jacobian(np.ones(2) + distance))
    assert solve_chord(problem, np.ones(2) + distance, factors) is not None
    assert problem.count <= most


@pytest.mark.parametrize("factor", [-1.0, 0.3, 3.0])
def test_gives_up_with_factors_that_do_not_contract(factor: float) -> None:
    problem = Circle()
    wrong = factorise(csc_array(factor * problem.jacobian(np.ones(2)).toarray()))
    assert solve_chord(problem, np.array([1.1, 1.05]), wrong) is None


def test_gives_up_where_a_joint_is_left() -> None:
    class Sliding(Circle):
        def reselect(self, y: np.ndarray) -> None:
            raise InfeasibleError("the wire has slid out")

    problem = Sliding()
    assert solve_chord(problem, np.array([1.02, 1.01]), factorise(problem.jacobian(np.ones(2)))) is None


def test_is_not_patient_without_end() -> None:
    problem = Circle()
    slow = factorise(csc_array(1.6 * problem.jacobian(np.ones(2)).toarray()))  # contracts by 0.4
    assert solve_chord(problem, np.array([1.02, 1.01]), slow, max_iterations=5) is None
    assert solve_chord(problem, np.array([1.02, 1.01]), slow, max_iterations=60) is not None
