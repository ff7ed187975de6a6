"""The softest direction of a matrix: against dense inverses and singular value decompositions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_array

from catenaria.solvers.linear import Scaling, factorise
from catenaria.solvers.rank import Softest, resisted, softest


def with_singular_values(sigma: np.ndarray, seed: int) -> np.ndarray:
    """Return a matrix U diag(sigma) V^T with random orthogonal factors."""
    rng = np.random.default_rng(seed)
    n = sigma.size
    U, V = (np.linalg.qr(rng.standard_normal((n, n)))[0] for _ in range(2))
    return U * sigma @ V.T


def search(matrix: np.ndarray, load: np.ndarray, look: np.ndarray) -> Softest:
    return softest(factorise(csc_array(matrix)), load, look)


@pytest.mark.parametrize("smallest", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("seed", range(5))
def test_a_nearly_singular_matrix_is_found_out(smallest: float, seed: int) -> None:
    """The largest entry of the inverse is exact, and the motion is the singular vector."""
    sigma = np.append(np.linspace(1.0, 2.0, 39), smallest)
    matrix = with_singular_values(sigma, seed)
    ones = np.ones(40)
    found = search(matrix, ones, ones)
    assert found.give == pytest.approx(np.abs(np.linalg.inv(matrix)).max(), rel=1e-6)
    _, _, Vt = np.linalg.svd(matrix)
    null = Vt[-1] / np.abs(Vt[-1]).max()
    close = 30.0 * smallest + 1e-6  # what the other 39 directions add
    np.testing.assert_allclose(found.motion * np.sign(found.motion @ null), null, atol=close)


def test_the_left_vector_is_that_of_the_singular_value() -> None:
    matrix = with_singular_values(np.append(np.linspace(1.0, 2.0, 39), 1e-9), 7)
    ones, lu = np.ones(40), factorise(csc_array(matrix))
    left = resisted(lu, ones, ones, softest(lu, ones, ones).moved)
    U, _, _ = np.linalg.svd(matrix)
    cosine = abs(left @ U[:, -1]) / np.linalg.norm(left)
    assert cosine == pytest.approx(1.0, abs=1e-12)
    assert abs(left @ U[:, 0]) < 1e-6 * np.linalg.norm(left)  # another direction would be noticed


@pytest.mark.parametrize("seed", range(10))
def test_a_regular_matrix_is_bounded_from_below(seed: int) -> None:
    matrix = with_singular_values(np.linspace(1.0, 2.0, 30), seed)
    exact = np.abs(np.linalg.inv(matrix)).max()
    found = search(matrix, np.ones(30), np.ones(30)).give
    assert 0.5 * exact < found <= exact * (1.0 + 1e-12)


def test_its_inverse_is_the_distance_to_singularity() -> None:
    """1/give taken away at the one right place makes the matrix singular, taken elsewhere it does not."""
    matrix = with_singular_values(np.append(np.linspace(1.0, 2.0, 19), 1e-4), 3)
    found = search(matrix, np.ones(20), np.ones(20))
    sign = np.sign(np.linalg.inv(matrix)[found.moved, found.load])
    change = np.zeros((20, 20))
    change[found.load, found.moved] = -sign / found.give
    smallest = np.linalg.svd(matrix + change, compute_uv=False)[-1]
    assert smallest < 1e-12
    elsewhere = np.roll(change, 1, axis=1)
    assert np.linalg.svd(matrix + elsewhere, compute_uv=False)[-1] > 1e-6


def test_scales_choose_what_is_compared() -> None:
    matrix = np.diag([1.0, 1e-6, 1e-3])
    ones = np.ones(3)
    assert search(matrix, ones, ones).moved == 1
    assert search(matrix, ones, np.array([1.0, 0.0, 1.0])).moved == 2
    assert search(matrix, np.array([1.0, 0.0, 1.0]), ones).moved == 2
    assert search(matrix, np.array([1e9, 1.0, 1.0]), ones).moved == 0


def test_a_scaled_factorisation_gives_the_same() -> None:
    matrix = csc_array(with_singular_values(np.append(np.linspace(1.0, 2.0, 19), 1e-8), 5))
    rng = np.random.default_rng(6)
    row, column = 10.0 ** rng.uniform(-3, 3, 20), 10.0 ** rng.uniform(-3, 3, 20)
    plain = softest(factorise(matrix), np.ones(20), np.ones(20))
    scaled = softest(factorise(matrix, Scaling(row, column)), np.ones(20), np.ones(20))
    assert scaled.give == pytest.approx(plain.give, rel=1e-6)
    assert (scaled.load, scaled.moved) == (plain.load, plain.moved)


def test_transposed_solutions_are_transposed() -> None:
    matrix = csc_array(np.array([[2.0, 1.0], [0.0, 4.0]]))
    for scaling in (None, Scaling(np.array([2.0, 3.0]), np.array([5.0, 7.0]))):
        lu = factorise(matrix, scaling)
        np.testing.assert_allclose(matrix.T @ lu.solve_transposed(np.array([1.0, 2.0])), [1.0, 2.0])
        assert not np.allclose(matrix.T @ lu.solve(np.array([1.0, 2.0])), [1.0, 2.0])
