"""An unknown as measure: its target is its value."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.controls.value import Value
from catenaria.mechanics.state import State

Z = np.array([3.0, -1.0, 4.0, 1.5, -9.0])
INDEX, ROW = np.array([4, 1]), np.array([0, 2])


def test_value() -> None:
    measure = Value(INDEX)
    np.testing.assert_array_equal(measure.value(0.0, Z), [-9.0, -1.0])
    np.testing.assert_array_equal(measure.columns(), [[4], [1]])
    np.testing.assert_array_equal(measure.gradient(0.0, Z), [[1.0], [1.0]])
    assert measure.relocate(Z) is None


def solved(target: np.ndarray) -> np.ndarray:
    """Return the unknowns after one Newton step on rows 0 and 2 by unknowns 4 and 1; the step is exact."""
    part, f, matrix = Targets(ROW, Value(INDEX), target), np.zeros(5), np.zeros((5, 5))
    part.add_residual(State.at_rest(Z), f)
    matrix[part.pattern()] = part.jacobian(State.at_rest(Z), 0.0, 0.0)
    z = Z.copy()
    z[INDEX] -= np.linalg.solve(matrix[np.ix_(ROW, INDEX)], f[ROW])
    return z


def test_a_target_gives_an_unknown_its_value_in_the_row_of_another() -> None:
    target = np.array([2.0, 7.0])
    np.testing.assert_allclose(solved(target)[INDEX], target, rtol=1e-14)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(solved(target[::-1])[INDEX], target, rtol=1e-14)


def test_in_its_own_row_it_is_a_given_value() -> None:
    f, h = np.zeros(5), np.zeros(5)
    Targets(INDEX, Value(INDEX), np.array([2.0, 7.0])).add_residual(State.at_rest(Z), f)
    Given(INDEX, np.array([2.0, 7.0])).add_residual(State.at_rest(Z), h)
    np.testing.assert_array_equal(f, h)
