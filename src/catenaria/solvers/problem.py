"""What a system must offer to be solved here: arrays and callables, no mechanics."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
OrderArray = NDArray[np.int8]


class SparseMatrix(Protocol):
    """The part of a SciPy matrix in compressed sparse column form that the solvers use."""

    @property
    def data(self) -> NDArray[Any]:
        """Stored entries, column by column."""
        ...

    @property
    def indices(self) -> NDArray[Any]:
        """Row of each stored entry."""
        ...

    @property
    def indptr(self) -> NDArray[Any]:
        """Where each column begins in `data`."""
        ...

    def diagonal(self) -> NDArray[Any]:
        """Return the entries (i, i)."""
        ...

    def __matmul__(self, other: FloatArray, /) -> Any: ...


class DaeProblem(Protocol):
    """Implicit system F(t, y, y', y'') = 0, eq. (24); row i belongs to unknown i, all arrays have shape (n,).

    Notes
    -----
    Multipliers and sliding coordinates are algebraic (order 0), also where their rates could be computed.
    They do not belong in the error test of an index-3 system, but in the test of Newton's convergence, where
    the scale of a multiplier is raised where its accuracy, which falls like h^-2, cannot reach it.
    """

    @property
    def size(self) -> int:
        """Number of unknowns n."""
        ...

    @property
    def order_of(self) -> OrderArray:
        """Highest time derivative: 2 for positions, 1 for control parameters, 0 for algebraic unknowns."""
        ...

    @property
    def constraint(self) -> BoolArray:
        """Rows that are position-level constraints; a multiplier has the index of its constraint."""
        ...

    @property
    def error_scale(self) -> FloatArray:
        """Error allowed in a step; infinite for an unknown that takes no part in the error test."""
        ...

    @property
    def newton_scale(self) -> FloatArray:
        """Size of a negligible Newton correction, infinite for an unknown that is not tested."""
        ...

    def residual(self, t: float, y: FloatArray, yd: FloatArray, ydd: FloatArray) -> FloatArray:
        """Return F(t, y, y', y''), shape (n,)."""
        ...

    def jacobian(
        self, t: float, y: FloatArray, yd: FloatArray, ydd: FloatArray, c1: float, c2: float
    ) -> SparseMatrix:
        """Return F_y + c1 F_y' + c2 F_y'' (CSC); one problem object always returns one sparsity."""
        ...

    def reselect(self, y: FloatArray) -> DaeProblem | None:
        """Return None if the discrete state fits y, else the problem whose discrete state does."""
        ...


class AlgebraicProblem(Protocol):
    """Square system f(y) = 0 of n equations."""

    @property
    def newton_scale(self) -> FloatArray:
        """Size of a negligible Newton correction, infinite for an unknown that is not tested."""
        ...

    def residual(self, y: FloatArray) -> FloatArray:
        """Return f(y), shape (n,)."""
        ...

    def jacobian(self, y: FloatArray) -> SparseMatrix:
        """Return f_y (CSC)."""
        ...

    def reselect(self, y: FloatArray) -> AlgebraicProblem | None:
        """Return None if the discrete state fits y, else the problem whose discrete state does."""
        ...
