"""Hermite shape functions: nodal conditions, reproduction of cubics, derivatives by complex step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.numerics.hermite import shape, shape_1, shape_2

Function = Callable[[Any, np.ndarray], Any]
LENGTHS = [0.05, 1.0, 2.4, 65.0]
XI = np.array([-1.0, -0.83, -0.2, 0.0, 0.37, 0.91, 1.0, 1.4])


def check_nodal_conditions(function: Function, slope: Function, L: float) -> None:
    """The four columns interpolate r_i, r_i', r_j, r_j' in this order, eq. (2)."""
    ends, lengths = np.array([-1.0, 1.0]), np.full(2, L)
    np.testing.assert_allclose(function(ends, lengths), [[1, 0, 0, 0], [0, 0, 1, 0]], atol=1e-15)
    np.testing.assert_allclose(slope(ends, lengths), [[0, 1, 0, 0], [0, 0, 0, 1]], atol=1e-15)


def check_derivative(function: Function, derivative: Function, L: float) -> None:
    """The derivative is by arc length: d/dl = (2/L) d/ds, eq. (5)."""
    h = 1e-30
    expected = function(XI + 1j * h, np.full(XI.size, L)).imag / h * 2.0 / L
    scale = np.abs(expected).max()
    np.testing.assert_allclose(derivative(XI, np.full(XI.size, L)), expected, rtol=1e-13, atol=1e-14 * scale)


def printed(s: np.ndarray, L: np.ndarray) -> np.ndarray:
    """Return eqs. (3)-(4) as printed, in the printed order N1, N2, N3, N4: the misprint."""
    return shape(s, L)[:, [0, 2, 1, 3]]


@pytest.mark.parametrize("L", LENGTHS)
def test_nodal_conditions(L: float) -> None:
    check_nodal_conditions(shape, shape_1, L)


@pytest.mark.parametrize("L", LENGTHS)
def test_derivatives(L: float) -> None:
    check_derivative(shape, shape_1, L)
    check_derivative(shape_1, shape_2, L)


@pytest.mark.parametrize("L", LENGTHS)
def test_reproduces_cubics(L: float) -> None:
    cubic = np.polynomial.Polynomial([0.7, -1.1, 0.4, 0.25])
    nodal = np.array([cubic(0.0), cubic.deriv()(0.0), cubic(L), cubic.deriv()(L)])
    lengths = np.full(XI.size, L)
    at = 0.5 * L * (XI + 1.0)
    for order, function in enumerate((shape, shape_1, shape_2)):
        exact = cubic.deriv(order)(at) if order else cubic(at)
        np.testing.assert_allclose(
            function(XI, lengths) @ nodal, exact, rtol=1e-11, atol=1e-11 * np.abs(exact).max()
        )


def test_broadcasts_over_elements() -> None:
    """A scalar length serves all points, and each point may have its own length."""
    lengths = np.linspace(0.5, 3.0, XI.size)
    for function in (shape, shape_1, shape_2):
        each = np.stack([function(XI[k : k + 1], lengths[k : k + 1])[0] for k in range(XI.size)])
        np.testing.assert_array_equal(function(XI, lengths), each)
        np.testing.assert_array_equal(function(XI, np.array(2.0)), function(XI, np.full(XI.size, 2.0)))


def test_control_printed_order_fails() -> None:
    with pytest.raises(AssertionError):
        check_nodal_conditions(printed, shape_1, 2.0)


def test_control_derivative_by_s_fails() -> None:
    """Forgetting ds/dl = 2/L is seen on every length but 2."""
    with pytest.raises(AssertionError):
        check_derivative(shape, lambda s, L: shape_1(s, L) * (L / 2.0)[:, None], 2.4)
