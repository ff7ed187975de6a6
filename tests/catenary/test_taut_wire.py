"""The taut wire against quadrature of its slope, its differential equation and a clamped beam."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.catenary.taut_string import taut_string
from catenaria.catenary.taut_wire import TautWire

FloatArray = NDArray[np.float64]

H, W, EJ = 15e3, 9.0, 300.0
BEND = float(np.sqrt(EJ / H))
SUPPORTS = (np.array([-0.6, 0.0, 40.0, 105.0, 105.7]), np.array([1.0, 1.0, 1.4, 0.9, 0.9]))
LOADS = (np.array([5.0, 37.0, 44.0, 70.0]), np.array([80.0, 60.0, 90.0, 85.0]))
GRID = np.linspace(-0.6, 105.7, 1_063_001)


@pytest.fixture
def wire() -> TautWire:
    """A wire with tails, bending and loads."""
    return TautWire.held(SUPPORTS, H, W, EJ, LOADS)


def check_passes_through_supports(wire: TautWire) -> None:
    np.testing.assert_allclose(
        wire.height(SUPPORTS[0]), SUPPORTS[1], atol=2e-5
    )  # 1.5 % of a layer reaches the next kink


def test_wire_passes_through_its_supports(wire: TautWire) -> None:
    check_passes_through_supports(wire)
    z, _ = taut_string(wire.x, SUPPORTS, H, W, LOADS)  # not raised by what bending takes
    with pytest.raises(AssertionError):
        check_passes_through_supports(replace(wire, z=z))


def test_without_bending_it_is_the_string() -> None:
    x = GRID[::1000]
    height, slope = taut_string(x, SUPPORTS, H, W, LOADS)
    string = TautWire.held(SUPPORTS, H, W, 0.0, LOADS)
    np.testing.assert_allclose(string.height(x), height, atol=1e-12)
    between = np.min(np.abs(x[:, None] - string.x), axis=1) > 1e-6
    np.testing.assert_allclose(string.slope(x)[between], slope[between], atol=1e-12)


def check_beam(wire: TautWire, stiffness: float) -> None:
    """EJ z'''' - H z'' = -w between the kinks, by differences, near and far from them."""
    for x0 in (0.1, 0.5, 36.6, 39.9, 69.8, 90.0):
        h = 0.02
        z = wire.height(x0 + h * np.arange(-2.0, 3.0))
        fourth = (z[0] - 4 * z[1] + 6 * z[2] - 4 * z[3] + z[4]) / h**4
        second = (z[1] - 2 * z[2] + z[3]) / h**2
        assert stiffness * fourth - H * second == pytest.approx(-W, abs=0.02 * abs(H * second) + 0.1)


def test_wire_is_a_tensioned_beam(wire: TautWire) -> None:
    check_beam(wire, EJ)
    with pytest.raises(AssertionError):
        check_beam(wire, 1.2 * EJ)


def test_slope_is_continuous_and_the_derivative_of_the_height(wire: TautWire) -> None:
    np.testing.assert_allclose(np.gradient(wire.height(GRID), GRID)[1:-2], wire.slope(GRID)[1:-2], atol=2e-6)
    for x in wire.x[1:-1]:
        before, after = wire.slope(np.array([x - 1e-9, x + 1e-9]))
        assert after == pytest.approx(before, abs=1e-6)


def check_excess(wire: TautWire) -> None:
    square = np.hypot(1.0, wire.slope(GRID)) - 1.0
    integral = np.concatenate(([0.0], np.cumsum(0.5 * (square[1:] + square[:-1]) * np.diff(GRID))))
    np.testing.assert_allclose(wire.arc_excess(GRID), integral, atol=2e-6)


def test_excess_of_the_arc_is_the_integral_of_its_gain(wire: TautWire) -> None:
    check_excess(wire)


def test_excess_without_its_roundings_is_noticed(wire: TautWire, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(self: TautWire, bay: FloatArray, behind: FloatArray, ahead: FloatArray) -> FloatArray:
        return np.zeros_like(behind)

    monkeypatch.setattr(TautWire, "_layers", none)
    with pytest.raises(AssertionError):
        check_excess(wire)


def test_forces_of_kinks_carry_weight_and_loads(wire: TautWire) -> None:
    up = -H * wire.jump
    loaded = np.isin(wire.x, LOADS[0])
    np.testing.assert_allclose(-up[loaded], LOADS[1], rtol=1e-9)
    ends = H * (wire.slope(wire.x[-1:]) - wire.slope(wire.x[:1]))[0]
    assert up[~loaded].sum() + ends == pytest.approx(W * 106.3 + LOADS[1].sum(), rel=1e-3)


def test_slopes_on_both_sides_of_a_kink(wire: TautWire) -> None:
    """Far outside the rounding the wire has them, but for its weight."""
    before, behind = wire.kink_slopes(np.array([40.0]))
    assert before[0] == pytest.approx(float(wire.slope(np.array([39.0]))[0]) + W / H, abs=1e-4)
    assert behind[0] == pytest.approx(float(wire.slope(np.array([41.0]))[0]) - W / H, abs=1e-4)


def test_hinged_ends_are_not_rounded() -> None:
    """A single hinged span is a parabola whatever its bending stiffness, straight beyond its ends."""
    span = (np.array([0.0, 65.0]), np.zeros(2))
    stiff = TautWire.held(span, H, W, EJ)
    x = np.array([0.0, 0.05, 32.5, 65.0])
    np.testing.assert_allclose(stiff.height(x), -0.5 * W / H * x * (65.0 - x), atol=1e-12)
    np.testing.assert_allclose(stiff.slope(np.array([-1.0, 66.0])), [-0.0195, 0.0195], atol=1e-12)


def test_clamped_over_a_middle_support() -> None:
    """A wire over three even supports is clamped in the middle: z' = -R/H (1 - exp(-x/l)) + w x/H.

    R = -H J/2 is the support's half of the force.
    """
    wire = TautWire.held((np.array([0.0, 30.0, 60.0]), np.zeros(3)), H, W, EJ)
    half = -0.5 * H * float(wire.jump[1])
    x = np.array([0.01, 0.1, 0.4, 3.0])
    expected = -half / H * (1.0 - np.exp(-x / BEND)) + W * x / H
    np.testing.assert_allclose(wire.slope(30.0 + x), expected, atol=1e-12)
    exact = 0.5 * W * 30.0**2 / (30.0 - BEND)  # from z(L) = 0
    assert half == pytest.approx(exact, rel=1e-4)
