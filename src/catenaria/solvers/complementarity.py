"""Linear complementarity: what is either closed and bears a force, or open and bears none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

_TRIES = 5  # exchanges of all at once that need not reduce the number of wrong signs
_ROUNDING = 1e-12  # of the largest entry: a wrong sign that counts as none


@dataclass(frozen=True)
class Complementary:
    """A solution of a linear complementarity problem.

    Attributes
    ----------
    opening : FloatArray, shape (n,)
        x >= 0.
    force : FloatArray, shape (n,)
        w + M x >= 0, zero where x > 0.
    open : NDArray of bool, shape (n,)
        Where x may differ from 0.
    iterations : int
        Linear systems that were solved.
    """

    opening: FloatArray
    force: FloatArray
    open: Mask
    iterations: int


def solve_complementarity(
    M: FloatArray, w: FloatArray, start: Mask | None = None, max_iterations: int = 10_000
) -> Complementary:
    """Find x >= 0 with w + M x >= 0 of which one or the other is zero in every entry.

    Parameters
    ----------
    M : FloatArray, shape (n, n)
        A P-matrix: all its principal minors are positive, as those of a positive definite matrix.
    w : FloatArray, shape (n,)
        Constant part.
    start : NDArray of bool, shape (n,), optional
        Which entries of x are perhaps not zero; none if left out.
    max_iterations : int
        Limit of linear systems.

    Returns
    -------
    Complementary

    Raises
    ------
    NotConvergedError
        If a principal minor is zero, or the limit is reached, which no P-matrix of a sensible size does.

    Notes
    -----
    Block principal pivoting: all entries with a wrong sign change sides at once, which takes few steps; if
    their number has not fallen for some steps, only the last of them does, until it has (Murty's rule, which
    ends for every P-matrix).

    Examples
    --------
    >>> found = solve_complementarity(np.array([[2.0, -1.0], [-1.0, 2.0]]), np.array([-3.0, 2.0]))
    >>> found.opening.tolist(), found.force.tolist()
    ([1.5, 0.0], [0.0, 0.5])

    References
    ----------
    Judice & Pires 1994, Computers & Operations Research 21, 587-596.
    Murty 1974, Linear Algebra and its Applications 9, 65-108.
    """
    open_ = np.zeros(w.size, dtype=np.bool_) if start is None else start.copy()
    fewest, tries = w.size + 1, _TRIES
    for iteration in range(1, max_iterations + 1):
        x, force = _pivoted(M, w, open_)
        small = _ROUNDING * np.abs(w).max(initial=0.0)
        wrong = np.where(open_, x < 0.0, force < -small)
        count = int(np.count_nonzero(wrong))
        if count == 0:
            return Complementary(x, np.where(open_, 0.0, np.maximum(force, 0.0)), open_, iteration)
        if count < fewest:
            fewest, tries = count, _TRIES
        elif tries > 0:
            tries -= 1
        else:
            last = int(np.flatnonzero(wrong)[-1])
            wrong = np.arange(w.size) == last
        open_ = open_ ^ wrong
    raise NotConvergedError(
        f"{max_iterations} pivots have not solved a linear complementarity problem",
        "a matrix with other signs",
    )


def _pivoted(M: FloatArray, w: FloatArray, open_: Mask) -> tuple[FloatArray, FloatArray]:
    """Return x and w + M x where x is zero but in the open entries, and w + M x is zero there."""
    x, at = np.zeros(w.size), np.flatnonzero(open_)
    if at.size == 0:
        return x, w
    try:
        x[at] = np.linalg.solve(M[np.ix_(at, at)], -w[at])
    except np.linalg.LinAlgError as error:
        raise NotConvergedError(
            "A linear complementarity problem has a singular block", "a definite matrix"
        ) from error
    return x, w + M[:, at] @ x[at]
