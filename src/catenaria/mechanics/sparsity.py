"""Where the entries of contributions go in a sparse matrix, found once for all parts without discrete state.

When a sliding joint changes its element, only the few entries of joints and measures move: their pattern is
sorted anew and merged with the kept one, in time proportional to the size of the matrix.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.kernels.compress import Int32Array, compress, merge
from catenaria.mechanics.kernels.scatter import sum_into

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class SparsityPattern:
    """Where entries go in the data of one compressed sparse column matrix.

    Attributes
    ----------
    place : IntArray, shape (m,)
        Position in `data` of each contributed entry.
    indices, indptr : Int32Array
        Row indices and column pointers of the matrix.
    """

    place: IntArray
    indices: Int32Array
    indptr: Int32Array

    @classmethod
    def of(cls, rows: Int32Array, columns: Int32Array, size: int) -> SparsityPattern:
        """Sort the entries by column and row and give equal ones the same place."""
        return cls(*compress(rows, columns, size))

    @classmethod
    def of_parts(cls, parts: Sequence[Contribution], size: int) -> SparsityPattern:
        """Return the pattern of several contributions' entries, one after the other."""
        patterns = [part.pattern() for part in parts]
        none = np.empty(0, dtype=np.int32)
        rows = np.concatenate([none, *(rows for rows, _ in patterns)], dtype=np.int32)
        columns = np.concatenate([none, *(columns for _, columns in patterns)], dtype=np.int32)
        return cls.of(rows, columns, size)

    def data(self, entries: Sequence[FloatArray]) -> FloatArray:
        """Add the entries of several contributions up."""
        return sum_into(np.concatenate([np.empty(0), *entries]), self.place, self.indices.size)


@dataclass(frozen=True)
class MergedPattern:
    """The union of two patterns.

    Attributes
    ----------
    indices, indptr : Int32Array
        Row indices and column pointers of the union.
    first, second : IntArray
        Position in the union of each entry of either pattern.
    """

    indices: Int32Array
    indptr: Int32Array
    first: IntArray
    second: IntArray

    @classmethod
    def of(cls, first: SparsityPattern, second: SparsityPattern) -> MergedPattern:
        """Merge two patterns of the same size."""
        return cls(*merge(first.indices, first.indptr, second.indices, second.indptr))

    def data(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the data of the sum of two matrices with these patterns."""
        total = np.zeros(self.indices.size)
        total[self.first] = first
        total[self.second] += second
        return total
