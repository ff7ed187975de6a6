"""The cubic step: values, slope, continuity."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from catenaria.numerics.smoothstep import smoothstep, smoothstep_slope

Function = Callable[[np.ndarray], np.ndarray]

seeded = settings(derandomize=True, deadline=None)


def check_slope(function: Function, slope: Function) -> None:
    """The slope is the derivative, also across both ends of the ramp."""
    x, h = np.linspace(-0.5, 1.5, 401) + 1e-4, 1e-6
    difference = (function(x + h) - function(x - h)) / (2.0 * h)
    np.testing.assert_allclose(slope(x), difference, atol=2e-9)


def check_continuous_slope(function: Function) -> None:
    """One-sided difference quotients at both breaks agree (C1) and vanish."""
    h = 1e-6
    for x in (0.0, 1.0):
        left, right = (function(np.array([x + side * h]))[0] - function(np.array([x]))[0] for side in (-1, 1))
        assert abs(left / h) < 1e-5
        assert abs(right / h) < 1e-5


def test_slope_is_derivative() -> None:
    check_slope(smoothstep, smoothstep_slope)


def test_continuous_slope() -> None:
    check_continuous_slope(smoothstep)


def test_constant_outside() -> None:
    np.testing.assert_array_equal(
        smoothstep(np.array([-1e9, -1e-300, 0.0, 1.0, 1.0 + 1e-9, 1e9])), [0, 0, 0, 1, 1, 1]
    )
    np.testing.assert_array_equal(smoothstep_slope(np.array([-1e9, 0.0, 1.0, 1e9])), 0.0)


@seeded
@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_monotonous_and_antisymmetric(x: float, y: float) -> None:
    low, high = sorted((x, y))
    assert 0.0 <= smoothstep(low) <= smoothstep(high) + 1e-15
    assert float(smoothstep(high)) <= 1.0 + 1e-15
    np.testing.assert_allclose(smoothstep(x) + smoothstep(1.0 - x), 1.0, rtol=1e-14)


def test_control_linear_ramp_fails() -> None:
    """A linear ramp has kinks, and its slope is not this one."""

    def linear(x: np.ndarray) -> np.ndarray:
        return np.clip(x, 0.0, 1.0)

    with pytest.raises(AssertionError):
        check_continuous_slope(linear)
    with pytest.raises(AssertionError):
        check_slope(linear, smoothstep_slope)
