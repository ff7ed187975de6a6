"""Coefficients of the backward difference formulas on the true, variable grid.

Nothing is scaled from a constant step: all weights come from Lagrange's polynomial through the actual past
points. Times are tuples of floats, newest first; a handful of plain floats is faster than an array here.
"""

from __future__ import annotations

from math import prod

import numpy as np

from catenaria.solvers.problem import FloatArray


def derivative_weights(t: float, past: tuple[float, ...]) -> tuple[float, FloatArray]:
    """Return the weights of eq. (26): the derivative at t of the polynomial through t and the past points.

    Parameters
    ----------
    t : float
        New point [s].
    past : tuple of float
        The k points before it, newest first [s].

    Returns
    -------
    d0 : float
        Weight of the new value [1/s].
    d : FloatArray, shape (k,)
        Weights of the past values [1/s].

    Notes
    -----
    With the Lagrange basis l_i on the nodes t_0 = t, t_1, ..., t_k

        d_0 = sum_{i>0} 1/(t_0 - t_i),
        d_i = l_i'(t_0) = 1/(t_i - t_0) prod_{j != 0, i} (t_0 - t_j)/(t_i - t_j).

    Constant steps give the classical formulas (Hairer, Norsett & Wanner 1993, III.1, eq. 1.22').

    Examples
    --------
    >>> d0, d = derivative_weights(0.0, (-1.0, -2.0))
    >>> d0, [float(value) for value in d]
    (1.5, [-2.0, 0.5])
    """
    d0 = sum(1.0 / (t - node) for node in past)
    d = [prod((t - other) / (node - other) for other in past if other != node) / (node - t) for node in past]
    return d0, np.array(d)


def extrapolation_weights(t: float, past: tuple[float, ...]) -> FloatArray:
    """Return the values at t of the Lagrange basis on the past points.

    Examples
    --------
    >>> [float(value) for value in extrapolation_weights(0.0, (-1.0, -2.0, -3.0))]
    [3.0, -3.0, 1.0]
    """
    return np.array([prod((t - other) / (node - other) for other in past if other != node) for node in past])


def error_constant(t: float, past: tuple[float, ...], order: int) -> float:
    """Return the ratio of the local error to the difference between corrector and predictor.

    Parameters
    ----------
    t : float
        New point [s].
    past : tuple of float
        At least order + 1 points before it, newest first [s].
    order : int
        Order k of the formula; the predictor is the polynomial through the last k + 1 points.

    Returns
    -------
    float
        1 / (1 + d_0 (t_n - t_{n-k-1})): 1/3 for k = 1 and 2/11 for k = 2 with constant steps.

    Notes
    -----
    The interpolation errors of predictor and formula contain the same derivative, which Milne's device
    eliminates (derivation in docs/theory/bdf.md; Hindmarsh et al. 2005, section 2.1, use the same quantity).
    The constant h_n / (t_n - t_{n-k-1}) of DASSL (Brenan, Campbell & Petzold 1996, section 5.2) measures the
    defect of the formula, not the error of the solution, and is (h_n d_0 + h_n / (t_n - t_{n-k-1})) times as
    large.

    Examples
    --------
    >>> round(1.0 / error_constant(0.0, (-1.0, -2.0, -3.0), 2), 12)
    5.5
    """
    d0 = sum(1.0 / (t - node) for node in past[:order])
    return 1.0 / (1.0 + d0 * (t - past[order]))
