"""Sparse LU with the row and column scaling that index-3 systems need."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, Protocol, cast

import numpy as np
from scipy.sparse import csc_array  # pyright: ignore[reportMissingTypeStubs]
from scipy.sparse.linalg import splu  # pyright: ignore

from catenaria.solvers.problem import BoolArray, FloatArray, OrderArray, SparseMatrix

ColumnOrdering = Literal["COLAMD", "MMD_AT_PLUS_A", "NATURAL"]


_PANEL = 4  # columns that SuperLU treats at once; its default of 12 is for matrices with larger dense blocks


class Scaling(NamedTuple):
    """Factors by which rows and columns of a matrix are multiplied before it is factorised."""

    row: FloatArray
    column: FloatArray


class _Lu(Protocol):
    def solve(self, rhs: FloatArray, trans: Literal["N", "T"] = "N", /) -> FloatArray: ...


@dataclass(frozen=True)
class Factorisation:
    """LU factors of a scaled matrix R A C."""

    lu: _Lu
    scaling: Scaling | None = None

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Return x of A x = rhs; shape (n,)."""
        if self.scaling is None:
            return self.lu.solve(rhs)
        return self.scaling.column * self.lu.solve(self.scaling.row * rhs)

    def solve_transposed(self, rhs: FloatArray) -> FloatArray:
        """Return x of A^T x = rhs; shape (n,)."""
        if self.scaling is None:
            return self.lu.solve(rhs, "T")
        return self.scaling.row * self.lu.solve(self.scaling.column * rhs, "T")


def index3_scaling(matrix: SparseMatrix, order_of: OrderArray, constraint: BoolArray) -> Scaling:
    """Return the scaling that keeps the condition of an index-3 Newton matrix bounded as the step shrinks.

    Parameters
    ----------
    matrix : SparseMatrix, shape (n, n)
        F_y + d0 F_y' + d0^2 F_y''.
    order_of : OrderArray, shape (n,)
        Highest time derivative of each unknown.
    constraint : BoolArray, shape (n,)
        Rows of position-level constraints, which are also the columns of their multipliers.

    Returns
    -------
    Scaling
        Constraint rows and multiplier columns are multiplied by the size of the dynamic rows, the median of
        their diagonal, which grows like d0^2; all other factors are 1.

    Notes
    -----
    [[d0^2 M + K, G'], [G, 0]] has a condition number of the order of h^-4 in this form; with both
    off-diagonal blocks of the size of the first one it tends to that of [[M, G'], [G, 0]].

    Examples
    --------
    >>> matrix = csc_array([[1e8, 1.0], [1.0, 0.0]])
    >>> index3_scaling(matrix, np.array([2, 0], dtype=np.int8), np.array([False, True])).row
    array([1.e+00, 1.e+08])

    References
    ----------
    Petzold & Lotstedt 1986, SIAM J. Sci. Stat. Comput. 7, 720-733.
    Bottasso, Dopico & Trainelli 2008, Multibody Syst. Dyn. 19, 3-20.
    """
    factor = np.ones(constraint.size)
    dynamic = np.abs(matrix.diagonal()[order_of == 2])
    size = float(np.median(dynamic)) if dynamic.size else 0.0
    if size > 0.0:
        factor[constraint] = size
    return Scaling(factor, factor)


def factorise(
    matrix: SparseMatrix, scaling: Scaling | None = None, permc_spec: ColumnOrdering = "COLAMD"
) -> Factorisation:
    """Factorise a sparse matrix by SuperLU.

    Parameters
    ----------
    matrix : SparseMatrix, shape (n, n)
        In compressed column form.
    scaling : Scaling, optional
        Row and column factors, applied before and undone by `Factorisation.solve`.
    permc_spec : str
        SuperLU's column ordering.

    Returns
    -------
    Factorisation

    Raises
    ------
    numpy.linalg.LinAlgError
        If an entry is not finite or the matrix is exactly singular.

    Examples
    --------
    >>> factorise(csc_array([[2.0, 1.0], [1.0, 0.0]])).solve(np.array([3.0, 1.0]))
    array([1., 1.])
    """
    if not np.isfinite(matrix.data).all():
        raise np.linalg.LinAlgError("the matrix has an entry that is not finite")
    scaled = _nonzero(matrix if scaling is None else _scale(matrix, scaling))
    try:
        lu = cast("_Lu", splu(cast("Any", scaled), permc_spec=permc_spec, panel_size=_PANEL))
    except RuntimeError as error:  # SuperLU's only way to say so
        raise np.linalg.LinAlgError("the matrix is singular") from error
    return Factorisation(lu, scaling)


def _nonzero(matrix: SparseMatrix) -> SparseMatrix:
    """Return the matrix without stored zeros: in a plane problem these would tie the third direction in."""
    compact = cast("Any", matrix).copy()
    compact.eliminate_zeros()
    return compact


def _scale(matrix: SparseMatrix, scaling: Scaling) -> SparseMatrix:
    column = np.repeat(scaling.column, np.diff(matrix.indptr))
    data = matrix.data * scaling.row[matrix.indices] * column
    return cast("SparseMatrix", csc_array((data, matrix.indices, matrix.indptr)))
