"""Compiled kernels against the NumPy formulas and against scipy.sparse."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import coo_array

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.kernels.compress import compress
from catenaria.numerics.hermite import shape, shape_1, shape_2


@pytest.mark.parametrize("dtype", [np.float64, np.complex128])
def test_points_of_a_chain_follow_the_shape_functions(dtype: type) -> None:
    rng = np.random.default_rng(5)
    chain = Chain(
        rng.permutation(30).reshape(5, 6).astype(np.int64),
        np.array([0.0, 0.4, 1.5, 1.7, 3.0]),
        Section(1, 1, 1),
    )
    z, at = rng.normal(size=30).astype(dtype), rng.uniform(0.0, 3.0, 40)
    s, element = at.astype(dtype), chain.locate(at)
    point = chain.evaluate(z, s, element)
    L = chain.L[element]
    xi = 2.0 * (s - chain.knots[element]) / L - 1.0
    q = z[chain.dofs[element]].reshape(-1, 4, 3)
    for found, functions in ((point.r, shape), (point.r1, shape_1), (point.r2, shape_2)):
        N = functions(xi, L)
        np.testing.assert_allclose(found, np.einsum("nk,nki->ni", N, q), rtol=1e-12, atol=1e-12)
        with pytest.raises(AssertionError):
            np.testing.assert_allclose(found, np.einsum("nk,nki->ni", N[:, ::-1], q), rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(point.N, shape(xi, L), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(point.N1, shape_1(xi, L), rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(point.dofs.reshape(-1, 12), chain.dofs[element])


def test_compressed_columns_are_those_of_scipy() -> None:
    rng = np.random.default_rng(6)
    rows, columns = rng.integers(0, 50, (2, 900), dtype=np.int32)
    values = rng.normal(size=900)
    place, indices, indptr = compress(rows, columns, 50)
    data = np.bincount(place, values, indices.size)
    expected = coo_array((values, (rows, columns)), shape=(50, 50)).tocsc()
    expected.sum_duplicates()
    np.testing.assert_array_equal(indices, expected.indices)
    np.testing.assert_array_equal(indptr, expected.indptr)
    np.testing.assert_allclose(data, expected.data, atol=1e-12)
    assert not np.array_equal(compress(columns, rows, 50)[1], expected.indices)


def test_columns_without_entries_are_empty() -> None:
    _, indices, indptr = compress(np.array([2, 0], np.int32), np.array([1, 3], np.int32), 5)
    np.testing.assert_array_equal(indices, [2, 0])
    np.testing.assert_array_equal(indptr, [0, 0, 1, 1, 2, 2])
