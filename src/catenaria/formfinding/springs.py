"""Scales by which responses of metres, slopes and newtons are compared: everything as a spring."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.unknowns import Kind
from catenaria.solvers.problem import SparseMatrix

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_SHORTEST = 1e-3  # m, lever of a slope that nothing resists


@dataclass(frozen=True)
class Springs:
    """What a unit load and a unit motion are, for each equation and unknown.

    Attributes
    ----------
    stiffest : float
        Largest diagonal stiffness of a position, k [N/m].
    unit_load : FloatArray, shape (n,)
        1 N on a position, a moment of 1 N times a slope's lever, an error of 1 N of a force that is
        prescribed and of 1 N/k of a length that is.
    looked_at : FloatArray, shape (n,)
        By what unknowns are multiplied to be metres: a slope by its lever, a force by 1/k.

    Notes
    -----
    The lever of a slope is sqrt(K/k) with its own diagonal stiffness K [N m]. Every response is then in m/N,
    and that of the stiffest parts is 1/k. Unlike equilibration by rows and columns, this keeps what nothing
    holds soft; and unlike singular values of the bare matrix it does not depend on the mesh: a force of 1 N
    is 1 N on any node.
    """

    stiffest: float
    unit_load: FloatArray
    looked_at: FloatArray

    @classmethod
    def of(cls, kind: IntArray, matrix: SparseMatrix) -> Springs:
        """Return the scales of a Jacobian whose unknowns are of the given kinds, shape (n,)."""
        diagonal = np.abs(matrix.diagonal())
        k = float(np.max(diagonal, where=kind == Kind.POSITION, initial=0.0)) or 1.0
        looked_at = np.ones(kind.size)
        slope = kind == Kind.SLOPE
        looked_at[slope] = np.maximum(np.sqrt(diagonal[slope] / k), _SHORTEST)
        looked_at[kind == Kind.MULTIPLIER] = 1.0 / k
        unit_load = looked_at.copy()
        mixed = kind >= Kind.SLIDING  # equations of lengths or of forces: the matrix tells
        unit_load[mixed] = _row_size(matrix, mixed, looked_at) / k
        return cls(k, unit_load, looked_at)


def _row_size(matrix: SparseMatrix, rows: NDArray[np.bool_], looked_at: FloatArray) -> FloatArray:
    """Return the largest coefficient, of unknowns in metres, in each of some rows; 1 where all are zero."""
    entry = np.flatnonzero(rows[matrix.indices])
    column = np.searchsorted(matrix.indptr, entry, side="right") - 1
    size = np.zeros(rows.size)
    np.maximum.at(size, matrix.indices[entry], np.abs(matrix.data[entry]) / looked_at[column])
    return np.where(size > 0.0, size, 1.0)[rows]
