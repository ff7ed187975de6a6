"""How near a matrix is to being singular, and along which direction, for some triangular solves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from catenaria.solvers.linear import Factorisation
from catenaria.solvers.problem import FloatArray

_ROUNDS = 4
_SEED = 0


@dataclass(frozen=True)
class Softest:
    """The largest answer that a matrix gives to a unit load.

    Attributes
    ----------
    give : float
        Largest scaled response of an unknown to a unit load in one equation; infinite if it is not finite.
    load, moved : int
        That equation, and that unknown.
    motion : FloatArray, shape (n,)
        Responses of all unknowns, the near-null vector if give is large; largest scaled entry +-1.
    """

    give: float
    load: int
    moved: int
    motion: FloatArray


def softest(
    factorisation: Factorisation, unit_load: FloatArray, looked_at: FloatArray, rounds: int = _ROUNDS
) -> Softest:
    r"""Estimate the largest response to a unit load.

    Parameters
    ----------
    factorisation : Factorisation
        LU factors of a matrix A of shape (n, n).
    unit_load : FloatArray, shape (n,)
        What counts as a unit load w in each equation, 0 where there is none.
    looked_at : FloatArray, shape (n,)
        By what each response is multiplied, u; 0 for unknowns that are not looked at.
    rounds : int
        Limit of rounds that improve the first estimate, two triangular solves each; the estimate takes two.

    Returns
    -------
    Softest

    Notes
    -----
    The largest entry of :math:`B = U A^{-1} W` is :math:`\lVert B\rVert_{1\to\infty}`, and its inverse is the
    smallest singular value in a mixed norm: the least size, sum of absolute entries, of what must be added to
    :math:`W^{-1} A U^{-1}` to make it singular. The search goes from the largest entry of a column to the
    largest one of its row and so on until it stays: a power iteration. It gives a lower bound, which is exact
    where one direction is much softer than all others, the case that matters: a nearly singular A has
    :math:`A^{-1}\approx x y^T/\sigma`; the first transposed solve finds y, the next solve x.

    Examples
    --------
    >>> from catenaria.solvers.linear import factorise
    >>> from scipy.sparse import csc_array
    >>> lu = factorise(csc_array([[2.0, 0.0], [0.0, 0.001]]))
    >>> soft = softest(lu, np.ones(2), np.ones(2))
    >>> soft.give, soft.moved, soft.motion
    (1000.0, 1, array([0., 1.]))

    References
    ----------
    Higham 2002, Accuracy and Stability of Numerical Algorithms, chapters 6 and 15 (Boyd's power method).
    """
    start = np.random.default_rng(_SEED).standard_normal(looked_at.size)
    with np.errstate(invalid="ignore", over="ignore"):
        left = unit_load * factorisation.solve_transposed(looked_at * start)
    best = _response(factorisation, unit_load, looked_at, int(np.argmax(np.abs(left))))
    for _ in range(rounds):
        if not np.isfinite(best.give):
            return best
        left = resisted(factorisation, unit_load, looked_at, best.moved)
        trial = _response(factorisation, unit_load, looked_at, int(np.argmax(np.abs(left))))
        if not trial.give > best.give:
            break
        best = trial
    return best


def resisted(
    factorisation: Factorisation, unit_load: FloatArray, looked_at: FloatArray, moved: int
) -> FloatArray:
    """Return the responses of one unknown to unit loads in all equations, shape (n,): the left vector."""
    unit = np.zeros(looked_at.size)
    unit[moved] = looked_at[moved]
    return unit_load * factorisation.solve_transposed(unit)


def _response(
    factorisation: Factorisation, unit_load: FloatArray, looked_at: FloatArray, load: int
) -> Softest:
    unit = np.zeros(looked_at.size)
    unit[load] = unit_load[load]
    motion = factorisation.solve(unit)
    with np.errstate(invalid="ignore", over="ignore"):  # what is not finite is dealt with below
        scaled = np.abs(looked_at * motion)
    moved = int(np.argmax(scaled))  # the first NaN, if there is one
    give = float(scaled[moved])
    if not np.isfinite(give):
        return Softest(np.inf, load, moved, np.zeros_like(motion))
    return Softest(give, load, moved, motion / give if give > 0.0 else motion)
