"""What is said of a wire in equilibrium, against closed forms of tensioned wires."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
Vary = Callable[[dict[str, Any]], Line]

T, EJ, WEIGHT = 15e3, 400.0, 7710 * 120e-6 * 9.8  # the example's contact wire
BENDING = np.sqrt(EJ / T)


def held_depth(bay: float) -> float:
    """Return the depth of a tensioned beam of this length whose ends are level: T z'' - EJ z'''' = w [m]."""
    string, bent = WEIGHT * bay**2 / (8.0 * T), WEIGHT * bay * BENDING / (2.0 * T)
    return float(string - bent * np.tanh(bay / (4.0 * BENDING)))


def pinned_depth(bay: float) -> float:
    """Return the same with ends free to turn: less by w l^2/T (1 - 1/cosh(bay/2l)) [m]."""
    lost = WEIGHT * BENDING**2 / T * (1.0 - 1.0 / np.cosh(bay / (2.0 * BENDING)))
    return float(WEIGHT * bay**2 / (8.0 * T) - lost)


def short_line(vary: Vary, length: float, positions: tuple[float, ...], height: float = 0.0) -> Line:
    """Return one span whose contact wire is held at 0 m."""
    span = {"length": length, "droppers": {"positions": positions}, "contact_wire_height": height}
    support = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}}
    return vary({"spans": (span,), "supports": (support, support)})


def test_sag_between_equal_bays_is_that_of_a_clamped_tensioned_beam(result: FormResult) -> None:
    """Droppers 3 and 4 have equal bays on both sides, so the wire is level at them."""
    shape, x = result.wires[0].profile, result.droppers.x[2:4]
    inside = (shape.x >= x[0]) & (shape.x <= x[1])
    depth = -shape.z[inside].min()
    assert depth == pytest.approx(held_depth(9.5), rel=2e-3)
    assert depth != pytest.approx(WEIGHT * 9.5**2 / (8.0 * T), rel=2e-3)
    assert held_depth(9.5) < result.wires[0].sag < pinned_depth(9.5)


def test_one_dropper_leaves_two_bays_to_the_supports(variant: Vary) -> None:
    """Each bay is level at the dropper; at the support it turns half of its angle, its tail the rest."""
    sag = solve(short_line(variant, 20.0, (10.0,))).wires[0].sag
    assert sag == pytest.approx(0.75 * held_depth(10.0) + 0.25 * pinned_depth(10.0), rel=0.01)
    assert held_depth(10.0) < sag < pinned_depth(10.0)


def test_the_deepest_bay_may_be_the_one_beside_a_support(variant: Vary) -> None:
    """A bay of 12 m from the support sags twice as much as those of 8 m between droppers."""
    form = solve(short_line(variant, 36.0, (12.0, 20.0, 28.0)))
    assert held_depth(12.0) < form.wires[0].sag < pinned_depth(12.0)
    assert pinned_depth(8.0) < held_depth(12.0)


def test_sag_is_measured_from_a_chord_that_slopes(variant: Vary) -> None:
    """Droppers 5 mm above the supports add no depth of their own: 10 m bays sag as they do when level."""
    level = solve(short_line(variant, 20.0, (10.0,))).wires[0]
    raised = solve(short_line(variant, 20.0, (10.0,), height=0.005)).wires[0]
    assert raised.sag == pytest.approx(level.sag, rel=0.1)
    assert -raised.profile.z.min() < level.sag - 1e-3  # below the supports it hangs far less


def test_messenger_sag_is_below_the_chord_of_its_supports(result: FormResult) -> None:
    messenger = result.wires[1]
    assert messenger.sag == pytest.approx(1.5 - messenger.profile.z.min(), abs=1e-12)


def test_lengths_between_the_end_supports(result: FormResult) -> None:
    """Unstressed from tension: L0 = L/(1 + e) with Green's T = EA e (1 + e) to second order."""
    for wire, EA in zip(result.wires, (130e9 * 120e-6, 81.7e9 * 153e-6), strict=True):
        mean = 1.0 + T / EA - 1.5 * (T / EA) ** 2
        assert wire.stretched_length / wire.unstressed_length == pytest.approx(mean, rel=3e-6)
        assert wire.stretched_length > 195.0
        assert wire.stretched_length / wire.unstressed_length != pytest.approx(1.0 + T / EA, rel=1e-7)


def test_stretched_length_is_that_of_the_drawn_curve(result: FormResult) -> None:
    for wire in result.wires:
        shape = wire.profile
        between = (shape.x > 0.0) & (shape.x < 195.0)
        x = np.concatenate(([0.0], shape.x[between], [195.0]))
        z = np.interp(x, shape.x, shape.z)
        length = float(np.sum(np.hypot(np.diff(x), np.diff(z))))
        assert length == pytest.approx(wire.stretched_length, abs=5e-5)


def test_tension_lies_between_its_extremes(result: FormResult) -> None:
    """The messenger's tension falls by weight times height from the supports to mid-span."""
    for wire in result.wires:
        assert wire.tension_min < wire.tension_mean < wire.tension_max
        assert wire.tension == pytest.approx(T, abs=1e-3)
        np.testing.assert_allclose(np.linalg.norm(wire.end_force, axis=1), T, atol=0.02)
    assert result.wires[1].tension_max - result.wires[1].tension_min > 20.0
    assert result.wires[0].tension_max - result.wires[0].tension_min < 2.0


def test_travel_is_half_of_what_the_wire_gains(result: FormResult) -> None:
    """Each end moves by half of the stretch of 196 m and of the excess of the arc over its chord."""
    for wire, EA in zip(result.wires, (130e9 * 120e-6, 81.7e9 * 153e-6), strict=True):
        excess = wire.stretched_length - 195.0
        stretch = 196.0 * (T / EA - 1.5 * (T / EA) ** 2)
        assert wire.travel == pytest.approx(0.5 * (stretch - excess), abs=1e-4)
        assert wire.travel != pytest.approx(0.5 * stretch - excess, abs=1e-6)
