"""Springs as tensioning devices: force and travel of a bar that becomes longer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.mechanics.controls.measures import ReactionTension
from catenaria.mechanics.controls.sprung import Sprung
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.controls.value import Value
from catenaria.mechanics.state import State

# Tension T [N] and travel p [m] of a bar of stiffness EA/L that becomes longer by u: T = EA/L (p - u).
BAR, K, T0 = 2e5, 5e4, 1e4
TENSION, TRAVEL = np.array([0]), np.array([1])
DEVICE = Sprung(Value(TENSION), TRAVEL, np.array([K]))
START = np.array([T0, T0 / BAR])


def rest(device: Sprung, longer: float) -> np.ndarray:
    """Return tension and travel when the bar has become longer, with the device as it was."""
    target = Targets(TRAVEL, device, device.value(0.0, START))
    z, f = START.copy(), np.zeros(2)
    target.add_residual(State.at_rest(z), f)
    matrix = np.zeros((2, 2))
    matrix[target.pattern()] = target.jacobian(State.at_rest(z), 0.0, 0.0)
    f[0], matrix[0] = z[0] - BAR * (z[1] - longer), [1.0, -BAR]
    return z - np.linalg.solve(matrix, f)


def check_series(device: Sprung, longer: float) -> None:
    """A spring and a bar in series share what the bar grows: T falls by u / (1/k + L/EA)."""
    tension, travel = rest(device, longer)
    fall = longer / (1.0 / K + 1.0 / BAR)
    assert T0 - tension == pytest.approx(fall, rel=1e-12)
    assert travel - START[1] == pytest.approx(fall / K, rel=1e-12)


def test_spring_and_bar_in_series() -> None:
    check_series(DEVICE, 0.03)
    with pytest.raises(AssertionError):
        check_series(replace(DEVICE, stiffness=np.array([0.99 * K])), 0.03)
    with pytest.raises(AssertionError):
        check_series(replace(DEVICE, stiffness=np.array([-K])), 0.03)


def test_a_weight_keeps_its_force() -> None:
    tension, travel = rest(replace(DEVICE, stiffness=np.zeros(1)), 0.03)
    assert tension == pytest.approx(T0, rel=1e-12)
    assert travel - START[1] == pytest.approx(0.03, rel=1e-12)


def test_columns_and_gradient() -> None:
    np.testing.assert_array_equal(DEVICE.columns(), [[0, 1]])
    np.testing.assert_array_equal(DEVICE.gradient(0.0, START), [[1.0, K]])
    assert DEVICE.relocate(START) is None
    reaction = Sprung(ReactionTension(np.array([[0, 1, 2]]), np.eye(3)[:1]), np.array([3]), np.array([K]))
    z = np.array([-5.0, 0.0, 0.0, 0.1])  # the wire pulls against the device
    assert reaction.value(0.0, z)[0] == pytest.approx(5.0 + 0.1 * K)
