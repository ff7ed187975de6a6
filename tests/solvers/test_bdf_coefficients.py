"""Weights on variable grids against polynomials, textbook values and a measured local error."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from catenaria.solvers.bdf_coefficients import derivative_weights, error_constant, extrapolation_weights

STEPS = st.lists(st.floats(0.2, 2.0), min_size=1, max_size=6)


def grid(steps, t):
    return tuple(float(value) for value in t - np.cumsum(steps))


@given(steps=STEPS, t=st.floats(-3.0, 3.0))
def test_both_kinds_of_weights_are_exact_for_polynomials_of_their_degree(steps, t):
    past = grid(steps, t)
    d0, d = derivative_weights(t, past)
    for power in range(len(past) + 1):
        values = (np.array(past) - t + 1.0) ** power
        assert d0 + d @ values == pytest.approx(power, abs=1e-8)
        if power < len(past):
            assert extrapolation_weights(t, past) @ values == pytest.approx(1.0, abs=1e-8)


@given(steps=STEPS, t=st.floats(-3.0, 3.0))
def test_negative_control_one_degree_more_leaves_the_known_remainder(steps, t):
    """(s - t)^(k+1) has no slope at t; the formula returns minus the product of the nodes' distances."""
    past = grid(steps, t)
    distance = t - np.array(past)
    _, d = derivative_weights(t, past)
    remainder = d @ (-distance) ** (len(past) + 1)
    assert remainder == pytest.approx(-np.prod(distance), rel=1e-6)
    assert abs(remainder) > 5e-6


@pytest.mark.parametrize(
    ("order", "classical"),
    [
        (1, [1, -1]),
        (2, [3 / 2, -2, 1 / 2]),
        (3, [11 / 6, -3, 3 / 2, -1 / 3]),
        (4, [25 / 12, -4, 3, -4 / 3, 1 / 4]),
        (5, [137 / 60, -5, 5, -10 / 3, 5 / 4, -1 / 5]),
    ],
)
def test_constant_steps_give_the_classical_formulas(order, classical):
    """Values of Hairer, Norsett & Wanner 1993, section III.1, eq. (1.22')."""
    d0, d = derivative_weights(0.0, tuple(-float(i) for i in range(1, order + 1)))
    assert [d0, *d] == pytest.approx(classical, rel=1e-13)


def measured_constant(order, h):
    """One step for y' = f(t), y = exp(t), from exact history on an uneven grid: error / (y - predicted)."""
    past = tuple(-h * value for value in np.cumsum([1.0, 0.7, 1.3, 1.1, 0.8, 1.2])[: order + 1].tolist())
    history = np.exp(past)
    d0, d = derivative_weights(0.0, past[:order])
    y = (1.0 - d @ history[:order]) / d0
    return (y - 1.0) / (y - extrapolation_weights(0.0, past) @ history), past


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_error_constant_is_the_measured_ratio_of_error_to_predictor_difference(order):
    measured, past = measured_constant(order, 0.01)
    assert abs(measured) == pytest.approx(error_constant(0.0, past, order), rel=0.02)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_negative_control_the_constant_of_dassl_measures_something_else(order):
    measured, past = measured_constant(order, 0.01)
    dassl = -past[0] / -past[order]
    assert dassl > 1.3 * abs(measured)
