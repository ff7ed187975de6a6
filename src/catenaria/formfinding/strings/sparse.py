"""Sparse matrices, with the types that SciPy does not state."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy import sparse  # pyright: ignore
from scipy.sparse.linalg import splu  # pyright: ignore

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Matrix = Any  # one of SciPy's sparse arrays
Entries = list[tuple[IntArray, IntArray, FloatArray]]


def matrix(entries: Entries, shape: tuple[int, int]) -> Matrix:
    """Return the matrix of rows, columns and values; what is at the same place adds up."""
    row, column, value = (np.concatenate(part) for part in zip(*entries, strict=True))
    return cast("Matrix", sparse.csr_array((value, (row, column)), shape))


def diagonal(values: FloatArray) -> Matrix:
    """Return the matrix with these values on its diagonal."""
    return cast("Matrix", sparse.diags_array(values))


def blocks(parts: Sequence[Sequence[Matrix | None]]) -> Matrix:
    """Return the matrix that consists of these blocks; None stands for zeros."""
    return cast("Matrix", sparse.block_array(parts, format="csc"))


def factorised(square: Matrix) -> Callable[[FloatArray], FloatArray]:
    """Return what solves a system for any right-hand side.

    Raises
    ------
    RuntimeError
        If the matrix is singular.
    """
    return cast("Any", splu(square.tocsc())).solve
