"""Sparse matrices from triplets, with the types that SciPy does not state."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_diag, csr_array  # pyright: ignore
from scipy.sparse.linalg import splu  # pyright: ignore

Matrix = Any  # SciPy's csr_array


def matrix(
    values: NDArray[np.float64], rows: NDArray[np.int64], columns: NDArray[np.int64], shape: tuple[int, int]
) -> Matrix:
    """Return the sparse matrix of these triplets; entries at the same place add up."""
    return cast("Matrix", csr_array((values, (rows, columns)), shape=shape))


def diagonal_blocks(first: Matrix, second: Matrix) -> Matrix:
    """Return the matrix with these two on its diagonal."""
    return cast("Matrix", block_diag((first, second), format="csr"))


def solve(system: Matrix, right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the solution of a square system for one or several right-hand sides, shape (n,) or (n, k)."""
    return cast("Any", splu(system.tocsc())).solve(right)
