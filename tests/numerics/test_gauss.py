"""Gauss-Legendre quadrature against exact integrals of monomials."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from catenaria.numerics.gauss import gauss_legendre

Rule = Callable[[int], tuple[np.ndarray, np.ndarray]]


def check_degree(rule: Rule, count: int) -> None:
    """Monomials up to degree 2 count - 1 are integrated exactly over [-1, 1]."""
    points, weights = rule(count)
    for degree in range(2 * count):
        exact = Fraction(0 if degree % 2 else 2, degree + 1)
        np.testing.assert_allclose(weights @ points**degree, float(exact), rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 8, 20, 60])
def test_exact_up_to_degree_2n_minus_1(count: int) -> None:
    check_degree(gauss_legendre, count)
    points, weights = gauss_legendre(count)
    assert points.dtype == weights.dtype == np.float64
    assert np.all(np.diff(points) > 0.0)
    assert np.all(weights > 0.0)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 8])
def test_not_exact_one_degree_further(count: int) -> None:
    """The claim is sharp: degree 2 count is missed."""
    points, weights = gauss_legendre(count)
    assert abs(weights @ points ** (2 * count) - 2.0 / (2 * count + 1)) > 1e-6


def test_control_equidistant_points_fail() -> None:
    def midpoint(count: int) -> tuple[np.ndarray, np.ndarray]:
        return (2.0 * np.arange(count) + 1.0) / count - 1.0, np.full(count, 2.0 / count)

    with pytest.raises(AssertionError):
        check_degree(midpoint, 4)


@pytest.mark.parametrize("count", [0, -1])
def test_refuses_no_points(count: int) -> None:
    with pytest.raises(ValueError, match="positive"):
        gauss_legendre(count)
