"""Compiled sorting of matrix entries into columns, in time proportional to their number."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.kernels.compile import compiled

IntArray = NDArray[np.int64]
Int32Array = NDArray[np.int32]  # half as many bytes to move as numpy's own integers


@compiled
def _sorted_by(keys: Int32Array, order: Int32Array, size: int) -> Int32Array:
    """Return the order sorted by key, a counting sort that keeps the order of equal keys."""
    start = np.zeros(size + 1, np.int32)
    for k in range(keys.size):
        start[keys[k] + 1] += 1
    for key in range(size):
        start[key + 1] += start[key]
    result = np.empty_like(order)
    for k in range(order.size):
        key = keys[order[k]]
        result[start[key]] = order[k]
        start[key] += 1
    return result


@compiled
def compress(rows: Int32Array, columns: Int32Array, size: int) -> tuple[IntArray, Int32Array, Int32Array]:
    """Return the place of each entry, row indices and column pointers of the compressed column form.

    Entries of the same row and column get the same place; rows ascend within a column.
    """
    order = _sorted_by(columns, _sorted_by(rows, np.arange(rows.size).astype(np.int32), size), size)
    place = np.empty(rows.size, np.int64)
    indices = np.empty(rows.size, np.int32)
    indptr = np.zeros(size + 1, np.int32)
    last_row, last_column, count = -1, -1, 0
    for k in order:
        row, column = rows[k], columns[k]
        if row != last_row or column != last_column:
            indices[count] = row
            indptr[column + 1] += 1
            count += 1
            last_row, last_column = row, column
        place[k] = count - 1
    for column in range(size):
        indptr[column + 1] += indptr[column]
    return place, indices[:count].copy(), indptr


@compiled
def merge(
    indices_a: Int32Array,
    indptr_a: Int32Array,
    indices_b: Int32Array,
    indptr_b: Int32Array,
) -> tuple[Int32Array, Int32Array, IntArray, IntArray]:
    """Return row indices and column pointers of the union of two patterns, and the places of both."""
    indices = np.empty(indices_a.size + indices_b.size, np.int32)
    indptr = np.zeros_like(indptr_a)
    place_a, place_b = np.empty(indices_a.size, np.int64), np.empty(indices_b.size, np.int64)
    count = 0
    for column in range(indptr_a.size - 1):
        a, b = indptr_a[column], indptr_b[column]
        while a < indptr_a[column + 1] or b < indptr_b[column + 1]:
            in_a = a < indptr_a[column + 1]
            in_b = b < indptr_b[column + 1]
            if in_a and in_b:
                in_a, in_b = indices_a[a] <= indices_b[b], indices_b[b] <= indices_a[a]
            if in_a:
                indices[count] = indices_a[a]
                place_a[a] = count
                a += 1
            if in_b:
                indices[count] = indices_b[b]
                place_b[b] = count
                b += 1
            count += 1
        indptr[column + 1] = count
    return indices[:count].copy(), indptr, place_a, place_b
