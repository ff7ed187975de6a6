"""A wire that is pressed: its differential equation, its limits, and elements that converge to it."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.catenary.pressed_wire import pressed_elements, pressed_wire

T, EJ, L = 15e3, 300.0, 12.0


@pytest.mark.parametrize("x", [0.05, 0.7, 6.0, 11.5])
def test_is_what_a_series_gives(x: float) -> None:
    """Sum of sines, each a solution of EJ w'''' - T w'' = delta between hinges."""
    k = np.arange(1, 200_001) * np.pi / L
    series = float(np.sum(2.0 / L * np.sin(k * x) ** 2 / (EJ * k**4 + T * k**2)))
    assert pressed_wire(np.array([x]), L, T, EJ)[0] == pytest.approx(series, rel=1e-6)
    assert pressed_wire(np.array([x]), L, T, 1.1 * EJ)[0] != pytest.approx(series, rel=1e-6)


def test_is_a_string_without_bending_and_a_beam_without_tension() -> None:
    """Which is x (L - x)/(T L), and L^3/(48 EJ) in the middle."""
    x = np.array([3.0])
    np.testing.assert_allclose(pressed_wire(x, L, T, 0.0), 3.0 * 9.0 / (T * L))
    np.testing.assert_allclose(pressed_wire(x, L, T, 1e-8), 3.0 * 9.0 / (T * L), rtol=1e-6)
    np.testing.assert_allclose(pressed_wire(np.array([L / 2]), L, 1e-3, EJ), L**3 / (48.0 * EJ), rtol=1e-4)


def test_gives_way_nowhere_at_the_hinges() -> None:
    np.testing.assert_allclose(pressed_wire(np.array([0.0, L]), L, T, EJ), 0.0, atol=1e-18)


def test_elements_converge_to_it_from_below() -> None:
    x = np.array([6.1])
    exact, errors = pressed_wire(x, L, T, EJ)[0], []
    for n in (6, 12, 24, 48, 96):
        knots = np.linspace(0.0, L, n + 1)
        errors.append(exact - pressed_elements(knots, int(6.1 / L * n), x, T, EJ)[0])
    assert all(error > 0.0 for error in errors)
    assert errors[0] > 20.0 * errors[2] > 100.0 * errors[4]
    assert errors[-1] < 1e-4 * exact
