"""The simplified Newton method: many problems near one whose factors are known."""

from __future__ import annotations

import numpy as np

from catenaria.errors import InfeasibleError
from catenaria.solvers.linear import Factorisation
from catenaria.solvers.problem import AlgebraicProblem, FloatArray

_SLOWEST = 0.5  # contraction beyond which new factors pay


def solve_chord(
    problem: AlgebraicProblem, y: FloatArray, factors: Factorisation, max_iterations: int = 12
) -> FloatArray | None:
    """Find a root with the factors of one Jacobian nearby, or say that these do not serve.

    Parameters
    ----------
    problem : AlgebraicProblem
        The equations; after each iteration they may be exchanged by `reselect`.
    y : FloatArray, shape (n,)
        Starting guess; it is not changed.
    factors : Factorisation
        Of a Jacobian nearby.
    max_iterations : int
        Limit of corrections.

    Returns
    -------
    FloatArray or None
        The root, or None where corrections do not shrink by half each time, or are too many.

    Notes
    -----
    y_{k+1} = y_k - J_0^{-1} f(y_k) converges linearly, with a rate that is proportional to the distance of
    the root from where J_0 is right. The last correction is made too, so that what is left of the error is
    the tolerance times that rate.

    References
    ----------
    Deuflhard 2004, Newton Methods for Nonlinear Problems, section 2.1.2.

    Examples
    --------
    >>> from scipy.sparse import csc_array
    >>> from catenaria.solvers.linear import factorise
    >>> class Root2:
    ...     newton_scale = np.array([1e-12])
    ...
    ...     def residual(self, y):
    ...         return y * y - 2.0
    ...
    ...     def reselect(self, y):
    ...         return None
    >>> y = solve_chord(Root2(), np.array([1.4]), factorise(csc_array([[2.8]])))
    >>> round(float(y[0]), 12)
    1.414213562373
    >>> solve_chord(Root2(), np.array([1.4]), factorise(csc_array([[-2.8]]))) is None
    True
    """
    before = np.inf
    for _ in range(max_iterations):
        correction = factors.solve(problem.residual(y))
        size = float(np.abs(correction / problem.newton_scale).max())
        if not size <= _SLOWEST * before:  # also where it is not a number
            return None
        y, before = y - correction, size
        if size <= 1.0:
            return y
        try:
            problem = problem.reselect(y) or problem
        except InfeasibleError:
            return None
    return None
