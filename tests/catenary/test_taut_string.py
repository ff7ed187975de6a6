"""The taut string against closed forms and against its own differential equation."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.catenary.taut_string import taut_string
from catenaria.errors import InconsistentInputError

H, W = 15e3, 9.0
SUPPORTS = (np.array([0.0, 40.0, 105.0]), np.array([1.0, 1.4, 0.9]))
LOADS = (np.array([5.0, 39.0, 41.0, 70.0]), np.array([80.0, 60.0, 90.0, 85.0]))


def check_equilibrium(
    height: np.ndarray, x: np.ndarray, loads: tuple[np.ndarray, np.ndarray], tolerance: float = 1e-6
) -> None:
    """H z'' = w + loads, away from the supports: second differences on a grid that has nodes at the loads."""
    h = x[1] - x[0]
    force = H * (height[2:] - 2 * height[1:-1] + height[:-2]) / h
    expected = np.full(x.size - 2, W * h)
    for at, load in zip(*loads, strict=True):
        expected[np.argmin(np.abs(x[1:-1] - at))] += load
    free = np.abs(x[1:-1] - 40.0) > h / 2
    np.testing.assert_allclose(force[free], expected[free], atol=tolerance)


def test_mid_span_sag() -> None:
    """Weight: w L^2/(8 H); load: P L/(4 H)."""
    supports = (np.array([0.0, 65.0]), np.zeros(2))
    height, slope = taut_string(np.array([32.5, 0.0]), supports, H, W, (np.array([32.5]), np.array([100.0])))
    assert height[0] == pytest.approx(-W * 65**2 / (8 * H) - 100.0 * 65 / (4 * H), rel=1e-12)
    assert slope[1] == pytest.approx(-(0.5 * W * 65 + 50.0) / H, rel=1e-12)


def test_equilibrium_over_several_supports() -> None:
    x = np.linspace(0.0, 105.0, 421)
    height, _ = taut_string(x, SUPPORTS, H, W, LOADS)
    check_equilibrium(height, x, LOADS)
    np.testing.assert_allclose(np.interp(SUPPORTS[0], x, height), SUPPORTS[1], atol=1e-12)


def test_a_load_left_out_is_noticed() -> None:
    x = np.linspace(0.0, 105.0, 421)
    height, _ = taut_string(x, SUPPORTS, H, W, (LOADS[0][1:], LOADS[1][1:]))
    with pytest.raises(AssertionError):
        check_equilibrium(height, x, LOADS)


def test_slope_is_the_derivative_of_the_height() -> None:
    x = np.array([3.0, 17.0, 55.0, 99.0])
    above, _ = taut_string(x + 1e-5, SUPPORTS, H, W, LOADS)
    below, _ = taut_string(x - 1e-5, SUPPORTS, H, W, LOADS)
    np.testing.assert_allclose(taut_string(x, SUPPORTS, H, W, LOADS)[1], (above - below) / 2e-5, atol=1e-9)


def test_level_beyond_the_supports() -> None:
    height, slope = taut_string(np.array([-0.5, 105.5]), SUPPORTS, H, W, LOADS)
    np.testing.assert_array_equal(height, [1.0, 0.9])
    np.testing.assert_array_equal(slope, 0.0)


@pytest.mark.parametrize(("tension", "count"), [(0.0, 3), (-1.0, 3), (1.0, 1)])
def test_impossible_strings_are_refused(tension: float, count: int) -> None:
    with pytest.raises(InconsistentInputError):
        taut_string(np.zeros(1), (SUPPORTS[0][:count], SUPPORTS[1][:count]), tension, W)
