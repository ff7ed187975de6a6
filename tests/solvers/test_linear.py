"""Sparse LU: solutions, scaling of index-3 matrices, refusal of matrices that cannot be factorised."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import block_array, csc_array, diags_array

from catenaria.solvers.linear import factorise, index3_scaling

N, M = 40, 8


def saddle(h):
    """Return [[M/h^2 + K, G'], [G, 0]] of a chain of springs with a few constraints, and its masks."""
    K = 1e4 * csc_array(2.0 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))
    mass = diags_array(0.5 + 0.5 * np.cos(np.arange(N)) ** 2)
    G = csc_array((np.ones(M), (np.arange(M), 5 * np.arange(M))), shape=(M, N))
    matrix = csc_array(block_array([[K + mass / h**2, G.T], [G, None]]))
    order_of = np.repeat(np.array([2, 0], dtype=np.int8), [N, M])
    return matrix, order_of, order_of == 0


def condition(h, scaled):
    matrix, order_of, constraint = saddle(h)
    full = matrix.toarray()
    if scaled:
        scaling = index3_scaling(matrix, order_of, constraint)
        full = scaling.row[:, None] * full * scaling.column
    return np.linalg.cond(full)


def position_error(h, scaled):
    """Return the relative error of the positions for a solution whose two parts are of natural size."""
    matrix, order_of, constraint = saddle(h)
    x = np.sin(1.0 + np.arange(N + M))
    x[constraint] /= h**2
    scaling = index3_scaling(matrix, order_of, constraint) if scaled else None
    return np.abs(factorise(matrix, scaling).solve(matrix @ x) - x)[:N].max()


@pytest.mark.parametrize("ordering", ["COLAMD", "MMD_AT_PLUS_A", "NATURAL"])
def test_solution_does_not_depend_on_scaling_or_ordering(ordering):
    matrix, order_of, constraint = saddle(1e-2)
    x = np.cos(np.arange(N + M))
    for scaling in (None, index3_scaling(matrix, order_of, constraint)):
        assert factorise(matrix, scaling, ordering).solve(matrix @ x) == pytest.approx(x, abs=1e-9)


def test_scaling_keeps_the_condition_bounded_as_the_step_shrinks():
    assert condition(1e-7, scaled=True) < 10.0
    assert condition(1e-7, scaled=True) == pytest.approx(condition(1e-5, scaled=True), rel=0.1)


@pytest.mark.parametrize("h", [1e-4, 1e-6, 1e-8])
def test_scaled_solution_keeps_its_digits_as_the_step_shrinks(h):
    assert position_error(h, scaled=True) < 1e-14


def test_negative_control_without_scaling_the_solution_loses_its_digits():
    assert position_error(1e-6, scaled=False) > 1e-9
    assert position_error(1e-8, scaled=False) > 1e-6


def test_negative_control_without_scaling_the_condition_grows_like_the_fourth_power():
    growth = condition(1e-3, scaled=False) / condition(1e-2, scaled=False)
    assert growth > 100.0
    assert condition(1e-4, scaled=False) > 1e12


def test_scaling_of_a_system_without_dynamics_is_the_identity():
    matrix, order_of, constraint = saddle(1.0)
    scaling = index3_scaling(matrix, 0 * order_of, constraint)
    assert (scaling.row == 1.0).all()
    assert (scaling.column == 1.0).all()


def test_singular_and_not_finite_matrices_are_refused():
    with pytest.raises(np.linalg.LinAlgError, match="singular"):
        factorise(csc_array(np.array([[1.0, 1.0], [1.0, 1.0]])))
    with pytest.raises(np.linalg.LinAlgError, match="not finite"):
        factorise(csc_array(np.array([[1.0, np.inf], [1.0, 1.0]])))
