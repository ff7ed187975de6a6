"""Modes of small vibrations against closed forms of chains of masses, with and without constraints."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import block_array, csc_array, diags_array
from scipy.sparse.linalg import ArpackNoConvergence

from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.solvers.modes import EigenPairs, smallest_modes


def chain(n: int) -> tuple[csc_array, csc_array]:
    """Return K and M of n masses of 2 kg between n + 1 springs of 3 N/m."""
    K = diags_array([-3.0, 6.0, -3.0], offsets=[-1, 0, 1], shape=(n, n))
    return csc_array(K), csc_array(diags_array(np.full(n, 2.0)))


def closed_form(n: int, count: int) -> np.ndarray:
    """omega_k^2 = 4 (c/m) sin^2(k pi/(2 (n + 1))), Timoshenko 1937."""
    return 4.0 * 3.0 / 2.0 * np.sin(np.arange(1, count + 1) * np.pi / (2.0 * (n + 1))) ** 2


def held(K: csc_array, M: csc_array, at: int, lever: float = 1.0) -> tuple[csc_array, csc_array]:
    """Return the matrices with one mass held by a constraint and a multiplier."""
    n = K.shape[0]
    G = csc_array(([lever], ([0], [at])), shape=(1, n))
    nothing = csc_array((1, 1))
    return csc_array(block_array([[K, G.T], [G, None]])), csc_array(block_array([[M, None], [None, nothing]]))


def check_values(pairs: EigenPairs, expected: np.ndarray) -> None:
    np.testing.assert_allclose(pairs.value, expected, rtol=1e-9)


@pytest.mark.parametrize("n", [5, 61, 400])
def test_chain_of_masses(n: int) -> None:
    """All at once, and by iteration."""
    pairs = smallest_modes(*chain(n), 5)
    check_values(pairs, closed_form(n, 5))
    with pytest.raises(AssertionError):
        check_values(pairs, closed_form(n + 1, 5))


@pytest.mark.parametrize("n", [7, 201])
@pytest.mark.parametrize("lever", [1.0, 1e-4])
def test_a_constraint_divides_the_chain(n: int, lever: float) -> None:
    """Held in the middle it is two chains: every value twice, whatever size the multiplier has."""
    half = n // 2
    pairs = smallest_modes(*held(*chain(n), half, lever), 6)
    check_values(pairs, np.repeat(closed_form(half, 3), 2))
    np.testing.assert_allclose(pairs.vector[half], 0.0, atol=1e-9)
    with pytest.raises(AssertionError):
        check_values(pairs, closed_form(n, 6))


def check_pairs(K: csc_array, M: csc_array, pairs: EigenPairs) -> None:
    """K x = mu M x in all rows, those of constraints included."""
    x = pairs.vector
    forces = M.toarray() @ (x * pairs.value)
    np.testing.assert_allclose(K.toarray() @ x, forces, atol=1e-7 * np.abs(forces).max())
    np.testing.assert_allclose(np.abs(x[: K.shape[0] - 1]).max(axis=0), 1.0, rtol=1e-12)


def test_vectors_hold_in_all_equations() -> None:
    K, M = held(*chain(150), 40)
    pairs = smallest_modes(K, M, 4)
    check_pairs(K, M, pairs)
    with pytest.raises(AssertionError):
        check_pairs(K, csc_array(1.001 * M), pairs)


def test_coordinates_without_mass_follow() -> None:
    """A spring in two pieces is one of half the stiffness."""
    K = csc_array([[6.0, -6.0], [-6.0, 6.0 + 3.0]])
    pairs = smallest_modes(K, csc_array(np.diag([0.0, 2.0])), 1)
    check_values(pairs, np.array([1.5]))
    np.testing.assert_allclose(pairs.vector[:, 0], [1.0, 1.0])


def test_unsymmetric_matrices_may_swing_up() -> None:
    """A follower force couples two equal oscillators: omega^2 = 2 +- i/2, a flutter that must be seen."""
    K = csc_array([[4.0, 1.0], [-1.0, 4.0]])
    values = smallest_modes(K, csc_array(2.0 * np.eye(2)), 2).value
    np.testing.assert_allclose(np.sort_complex(values), [2.0 - 0.5j, 2.0 + 0.5j])
    symmetric = smallest_modes(csc_array([[4.0, 1.0], [1.0, 4.0]]), csc_array(2.0 * np.eye(2)), 2).value
    np.testing.assert_allclose(symmetric, [1.5, 2.5])


def test_negative_stiffness_is_a_negative_value() -> None:
    K = csc_array(np.diag([-1.0, 4.0]))
    check_values(smallest_modes(K, csc_array(np.eye(2)), 2), np.array([-1.0, 4.0]))


def test_two_runs_are_equal() -> None:
    first, second = (smallest_modes(*chain(300), 4) for _ in range(2))
    np.testing.assert_array_equal(first.value, second.value)
    np.testing.assert_array_equal(first.vector, second.vector)
    assert not np.array_equal(first.value, smallest_modes(*chain(301), 4).value)


def test_what_moves_freely_is_refused() -> None:
    K = csc_array([[1.0, -1.0], [-1.0, 1.0]])
    with pytest.raises(np.linalg.LinAlgError, match="singular"):
        smallest_modes(K, csc_array(np.eye(2)), 1)


@pytest.mark.parametrize("count", [0, 3, 4])
def test_modes_that_do_not_exist_are_refused(count: int) -> None:
    """Three masses, one of them held: two modes."""
    with pytest.raises(InconsistentInputError, match="modes of a system"):
        smallest_modes(*held(*chain(3), 1), count)


def test_an_iteration_that_fails_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*arguments: object, **options: object) -> None:
        raise ArpackNoConvergence("No convergence (3 iterations)", np.empty(0), np.empty((0, 0)))

    monkeypatch.setattr("catenaria.solvers.modes.eigs", failing)
    with pytest.raises(NotConvergedError, match="No convergence"):
        smallest_modes(*chain(300), 4)
    check_values(smallest_modes(*chain(30), 4), closed_form(30, 4))
