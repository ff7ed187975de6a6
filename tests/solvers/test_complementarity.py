"""Linear complementarity: its conditions, all sets tried one by one, and a matrix on which blocks cycle."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.solvers.complementarity import solve_complementarity

FloatArray = NDArray[np.float64]


def fits(M: FloatArray, w: FloatArray, x: FloatArray) -> bool:
    force = w + M @ x
    return bool((x >= 0.0).all() and (force >= -1e-9).all() and abs(x @ force) < 1e-9)


def by_trial(M: FloatArray, w: FloatArray) -> list[FloatArray]:
    """Return every solution, from every set of entries that may be open."""
    found: list[FloatArray] = []
    for mask in product((False, True), repeat=w.size):
        open_, x = np.array(mask), np.zeros(w.size)
        if open_.any():
            x[open_] = np.linalg.solve(M[np.ix_(open_, open_)], -w[open_])
        if fits(M, w, x):
            found.append(x)
    return found


@pytest.mark.parametrize("seed", range(20))
def test_is_the_one_solution(seed: int) -> None:
    """Positive definite and not symmetric: there is one solution, whatever the start."""
    rng = np.random.default_rng(seed)
    A, B = rng.normal(size=(2, 6, 6))
    M, w = A @ A.T + 0.1 * np.eye(6) + B - B.T, rng.normal(size=6)
    (expected,) = by_trial(M, w)
    for start in (None, rng.random(6) > 0.5, np.ones(6, dtype=np.bool_)):
        found = solve_complementarity(M, w, start)
        np.testing.assert_allclose(found.opening, expected, atol=1e-9)
        np.testing.assert_allclose(found.force, w + M @ found.opening, atol=1e-9)
        assert not (found.opening[~found.open]).any()
    assert not fits(M, w, expected + 0.01)


def test_nothing_opens_that_bears_a_force() -> None:
    found = solve_complementarity(np.eye(3), np.array([1.0, 2.0, 0.0]))
    assert not found.open.any()
    assert found.iterations == 1


def test_ends_where_exchanges_of_all_at_once_go_in_a_circle() -> None:
    """Murty's cyclic P-matrix with w = -1: of three entries, blocks open and close all for ever."""
    M = np.array([[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]])
    w = -np.ones(3)
    found = solve_complementarity(M, w)
    np.testing.assert_allclose(found.opening, 1.0 / 3.0)
    for start in product((False, True), repeat=3):
        np.testing.assert_allclose(solve_complementarity(M, w, np.array(start)).opening, 1.0 / 3.0)
    start = np.array([True, False, False])
    with pytest.raises(NotConvergedError, match="3 pivots"):
        solve_complementarity(M, w, start, max_iterations=3)


def test_a_singular_block_is_refused() -> None:
    with pytest.raises(NotConvergedError, match="singular block"):
        solve_complementarity(np.zeros((2, 2)), np.array([-1.0, 1.0]))
