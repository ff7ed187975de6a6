"""Local error estimates and what follows from them: acceptance, order and length of the next step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from catenaria.solvers.bdf_coefficients import error_constant, extrapolation_weights
from catenaria.solvers.problem import FloatArray

SAFETY = 0.8
GROWTH_LIMIT = 2.0  # below 1 + sqrt(2), up to which variable-step BDF-2 is zero-stable (Grigorieff 1983)
SHRINK_LIMIT = 0.25
KEEP_BAND = (0.9, 1.3)  # step ratios that are not worth a new factorisation
NEGLIGIBLE = 1e-12  # errors below are treated alike, so that powers stay finite
MEMORY = 0.8  # part of an earlier error that still counts one step later
ORDER_GAIN = 1.1  # advantage in step length that another order must offer


class Held(NamedTuple):
    """Number of accepted steps with the present length and order; their largest error, slowly forgotten."""

    steps: int = 0
    worst_error: float = 0.0

    def after(self, error: float) -> Held:
        """Return the record after one more accepted step."""
        return Held(self.steps + 1, max(MEMORY * self.worst_error, error))


NOTHING_HELD = Held()


class Choice(NamedTuple):
    """Order of the next step and its length relative to the last one."""

    order: int
    ratio: float


def local_error(
    t: float,
    y: FloatArray,
    past_t: tuple[float, ...],
    past_y: FloatArray,
    order: int,
    inverse_scale: FloatArray,
) -> float:
    """Return the local error of a formula in the scaled maximum norm.

    Parameters
    ----------
    t, y : float, FloatArray of shape (n,)
        New time and solution.
    past_t, past_y : tuple of float, FloatArray of shape (m, n)
        At least order + 1 past points, newest first.
    order : int
        Order of the formula.
    inverse_scale : FloatArray, shape (n,)
        1 / error_scale, zero for unknowns that take no part.

    Returns
    -------
    float
        At most 1 if the step is good enough.

    Examples
    --------
    The step to t = 1 of y = t^2 by implicit Euler, from exact values at 0 and -1: the predictor says 0, so
    a third of the difference is taken for the error.

    >>> past = np.array([[0.0], [1.0]])
    >>> round(local_error(1.0, np.array([2.0]), (0.0, -1.0), past, 1, np.array([1.0])), 12)
    1.0
    """
    nodes = past_t[: order + 1]
    difference = y - extrapolation_weights(t, nodes) @ past_y[: order + 1]
    return error_constant(t, nodes, order) * float(np.abs(difference * inverse_scale).max())


def step_ratio(error: float, order: int) -> float:
    """Return the ratio of steps for which the local error of the next step is acceptable with some safety.

    Examples
    --------
    >>> round(step_ratio(0.001, order=2), 12)
    8.0
    """
    return SAFETY * max(error, NEGLIGIBLE) ** (-1.0 / (order + 1))


def after_rejection(error: float, order: int) -> float:
    """Return the ratio of steps after a failed error test."""
    return min(max(step_ratio(error, order), SHRINK_LIMIT), 0.9)


def after_acceptance(errors: dict[int, float], order: int, held: Held) -> Choice:
    """Choose order and length of the next step.

    Parameters
    ----------
    errors : dict of int to float
        Scaled local error of the accepted step for its order and for the neighbours that may be chosen.
    order : int
        Order of the accepted step.
    held : Held
        Record of the steps with this length and order, the accepted one included.

    Returns
    -------
    Choice
        The step shrinks at once. It grows at once if it may grow by the limit; if by less, only after
        order + 1 equal steps and as far as the largest error in them allows. In a vibration the error passes
        through zero twice a period: a step that follows it up is soon rejected, and each change costs a
        factorisation.

    Examples
    --------
    >>> after_acceptance({2: 0.4}, 2, Held(steps=9, worst_error=0.4))
    Choice(order=2, ratio=1.0)
    """
    ratios = {k: min(step_ratio(error, k), GROWTH_LIMIT) for k, error in errors.items()}
    best = max(ratios, key=lambda k: ratios[k])
    if ratios[best] < ORDER_GAIN * ratios[order]:
        best = order
    ratio = max(ratios[best], SHRINK_LIMIT)
    if KEEP_BAND[0] <= ratio < GROWTH_LIMIT:
        if held.steps <= order:
            return Choice(order, 1.0)
        ratio = min(ratio, step_ratio(held.worst_error, order))
        ratio = 1.0 if ratio < KEEP_BAND[1] else ratio
    return Choice(best, ratio)
