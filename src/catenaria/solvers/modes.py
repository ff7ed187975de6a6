"""Modes of small vibrations about a state of rest: K x = omega^2 M x with sparse matrices and constraints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import ArpackError, LinearOperator, eigs  # pyright: ignore

from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.solvers.linear import ColumnOrdering, Factorisation, factorise
from catenaria.solvers.problem import FloatArray, SparseMatrix

ComplexArray = NDArray[np.complex128]

_SMALL = 60  # coordinates up to which all modes are computed at once
_NOISE = 1e-12  # times the largest 1/omega^2: what is below is the zero that a constraint leaves


@dataclass(frozen=True)
class EigenPairs:
    """Eigenvalues of smallest size and what belongs to them.

    Attributes
    ----------
    value : ComplexArray, shape (k,)
        Eigenvalues omega^2 in order of size [1/s^2].
    vector : ComplexArray, shape (n, k)
        Eigenvectors, one a column, multipliers included; largest coordinate 1.
    """

    value: ComplexArray
    vector: ComplexArray


def smallest_modes(
    K: SparseMatrix, M: SparseMatrix, count: int, permc_spec: ColumnOrdering = "COLAMD"
) -> EigenPairs:
    r"""Return the eigenpairs of K x = mu M x with the smallest eigenvalues mu.

    Parameters
    ----------
    K : SparseMatrix, shape (n, n)
        Tangent matrix of all equations, constraints included; need not be symmetric.
    M : SparseMatrix, shape (n, n)
        Mass matrix, zero in the rows and columns of everything without inertia.
    count : int
        How many.
    permc_spec : str
        Column ordering of the sparse LU.

    Returns
    -------
    EigenPairs

    Raises
    ------
    numpy.linalg.LinAlgError
        If K is singular: something is free to move without force.
    InconsistentInputError
        If there are not so many modes.
    NotConvergedError
        If the Arnoldi iteration does not converge.

    Notes
    -----
    With S the coordinates that have mass, the shift-inverted problem at zero is

    .. math:: (K^{-1})_{SS}\,M_{SS}\,y = \frac1\mu\,y,\qquad x = \mu\,K^{-1} M_{\cdot S}\,y .

    K^{-1} satisfies the constraints by itself: directions that they forbid have 1/mu = 0. Left out of y are
    multipliers, whose size would blur the iteration's test and whose infinite eigenvalues are defective.

    Examples
    --------
    Two masses of 1 kg between three springs of 1 N/m: omega^2 = 1 and 3; a constraint holds the second one.

    >>> from scipy.sparse import csc_array
    >>> K, M = csc_array([[2.0, -1.0], [-1.0, 2.0]]), csc_array([[1.0, 0.0], [0.0, 1.0]])
    >>> smallest_modes(K, M, 2).value.real.round(12)
    array([1., 3.])
    >>> held = csc_array([[2.0, -1.0, 0.0], [-1.0, 2.0, 1.0], [0.0, 1.0, 0.0]])
    >>> smallest_modes(held, csc_array(np.diag([1.0, 1.0, 0.0])), 1).value.real.round(12)
    array([2.])

    References
    ----------
    Lehoucq, Sorensen & Yang 1998, ARPACK Users' Guide, SIAM.
    Meerbergen & Spence 1997, SIAM J. Matrix Anal. Appl. 18, 1-30 (singular M).
    """
    heavy = np.unique(M.indices[M.data != 0.0])
    if not 0 < count <= heavy.size:
        raise InconsistentInputError(f"{count} modes of a system in which {heavy.size} coordinates have mass")
    flexibility = _Flexibility(factorise(K, permc_spec=permc_spec), M, heavy)
    small = heavy.size <= max(_SMALL, count + 2)
    inverse, y = _all(flexibility) if small else _largest(flexibility, count)
    order = np.argsort(-np.abs(inverse), kind="stable")[:count]
    inverse = inverse[order]
    finite = int(np.count_nonzero(np.abs(inverse) > _NOISE * np.abs(inverse[0])))
    if finite < count:
        raise InconsistentInputError(f"{count} modes of a system that has {finite}")
    x = flexibility.full(y[:, order])
    peak = np.abs(x[heavy]).argmax(axis=0)
    return EigenPairs(1.0 / inverse, x / x[heavy[peak], np.arange(count)])


@dataclass(frozen=True)
class _Flexibility:
    """Displacements under inertia forces."""

    factorisation: Factorisation
    M: SparseMatrix
    heavy: NDArray[np.intp]

    def displacement(self, y: FloatArray) -> FloatArray:
        """Return all of K^{-1} M y for coordinates y that have mass."""
        x = np.zeros(self.M.indptr.size - 1)
        x[self.heavy] = y
        return self.factorisation.solve(self.M @ x)

    def __call__(self, y: FloatArray) -> FloatArray:
        """Return it at the coordinates that have mass."""
        return self.displacement(y.ravel())[self.heavy]

    def full(self, y: ComplexArray) -> ComplexArray:
        """Return complete vectors for several columns y."""
        columns = [self.displacement(c.real) + 1j * self.displacement(c.imag) for c in y.T]
        return np.stack(columns, axis=1)


def _all(flexibility: _Flexibility) -> tuple[ComplexArray, ComplexArray]:
    matrix = np.stack([flexibility(unit) for unit in np.eye(flexibility.heavy.size)], axis=1)
    value, vector = np.linalg.eig(matrix)
    return value.astype(np.complex128), vector.astype(np.complex128)


def _largest(flexibility: _Flexibility, count: int) -> tuple[ComplexArray, ComplexArray]:
    size = flexibility.heavy.size
    operator = LinearOperator((size, size), matvec=flexibility, dtype=np.float64)  # pyright: ignore
    start = np.random.default_rng(0).normal(size=size)  # else ARPACK draws one, and no two runs are equal
    subspace = min(size, max(2 * count + 1, 20) + 10)
    try:
        found = cast("tuple[Any, Any]", eigs(operator, k=count, which="LM", v0=start, ncv=subspace))
    except ArpackError as error:
        raise NotConvergedError(f"the modes: {error}", "fewer modes") from error
    return found[0], found[1]
