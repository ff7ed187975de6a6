"""The audit's own track against closed forms: circle, clothoid, cant, gradient."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import fresnel

from catenaria.audit.track import Across, Track, read_track

FloatArray = NDArray[np.float64]


SHARP = {"rounding": 0.0}


def track(start: float = 0.0, gradients: tuple[dict[str, float], ...] = (), **curve: float) -> Track:
    defaults = {"start": 0.0, "length": 1000.0, "radius": 800.0, "transition": 0.0, "cant": 0.0}
    inputs: dict[str, Any] = {
        "start_chainage": start,
        "track": {
            "curves": [defaults | curve] if curve else [],
            "gradients": [SHARP | gradient for gradient in gradients],
            "rail_spacing": 1.5,
        },
    }
    return read_track(inputs)


def check_orthonormal(across: Across) -> None:
    axes = np.stack((across.along, across.left, across.up), axis=1)
    unit = np.broadcast_to(np.eye(3), axes.shape)
    np.testing.assert_allclose(axes @ np.swapaxes(axes, 1, 2), unit, atol=1e-15)
    np.testing.assert_allclose(np.cross(across.along, across.left), across.up, atol=1e-15)


def test_a_straight_level_track_is_the_x_axis_to_the_last_bit() -> None:
    c = np.linspace(-30.0, 1234.5, 7)
    across = track(start=100.0).across(c)
    np.testing.assert_array_equal(across.origin, np.column_stack((c, np.zeros(7), np.zeros(7))))
    np.testing.assert_array_equal(across.left, np.tile([0.0, 1.0, 0.0], (7, 1)))


@pytest.mark.parametrize("radius", [800.0, -300.0])
def test_a_curve_without_transitions_is_a_circle(radius: float) -> None:
    c = np.linspace(0.0, 1000.0, 23)
    origin = track(radius=radius).across(c).origin
    circle = radius * np.column_stack((np.sin(c / radius), 1.0 - np.cos(c / radius)))
    np.testing.assert_allclose(origin[:, :2], circle, atol=1e-10)


def test_a_transition_is_a_clothoid() -> None:
    """Fresnel's integrals; curvature c/(R T)."""
    R, T = 500.0, 150.0
    c = np.linspace(0.0, T, 11)
    scale = np.sqrt(np.pi * R * T)
    sine, cosine = fresnel(c / scale)
    origin = track(radius=R, transition=T).across(c).origin
    np.testing.assert_allclose(origin[:, :2], scale * np.column_stack((cosine, sine)), atol=1e-11)


def test_a_circle_is_not_a_clothoid() -> None:
    c = np.array([150.0])
    bend, circle = (track(radius=500.0, transition=T).across(c).origin for T in (150.0, 0.0))
    assert np.linalg.norm(bend - circle) > 10.0


def test_the_axis_has_the_length_of_its_chainage() -> None:
    c = np.linspace(-50.0, 1100.0, 200_001)
    plan = track(start=300.0, radius=-400.0, transition=80.0).across(c).origin[:, :2]
    chord = np.linalg.norm(np.diff(plan, axis=0), axis=1)
    np.testing.assert_allclose(chord, np.diff(c), rtol=1e-9)


def test_it_begins_at_the_first_support_along_x_wherever_the_curve_is() -> None:
    across = track(start=300.0, radius=400.0, gradients=({"start": 10.0, "slope": 0.01},)).across(
        np.array([300.0])
    )
    np.testing.assert_allclose(across.origin, [[300.0, 0.0, 0.0]], atol=1e-12)
    np.testing.assert_allclose(across.along, [[1.0, 0.0, 0.0]], atol=1e-15)


def test_slopes_hold_from_where_they_begin() -> None:
    gradients = ({"start": 100.0, "slope": 0.01}, {"start": 300.0, "slope": -0.02})
    z = track(gradients=gradients).across(np.array([50.0, 100.0, 200.0, 300.0, 400.0])).origin[:, 2]
    np.testing.assert_allclose(z, [0.0, 0.0, 1.0, 2.0, 0.0], atol=1e-12)


def test_rounded_slopes_are_parabolas() -> None:
    """From level to 10 mm/m over 40 m: m l/8 above the corner, and the polygon again outside."""
    gradients = ({"start": 100.0, "slope": 0.01, "rounding": 40.0},)
    z = track(gradients=gradients).across(np.array([80.0, 90.0, 100.0, 120.0, 200.0])).origin[:, 2]
    np.testing.assert_allclose(z, [0.0, 0.01 * 10.0**2 / 80.0, 0.01 * 40.0 / 8.0, 0.2, 1.0], atol=1e-12)


@pytest.mark.parametrize("radius", [800.0, -800.0])
def test_cant_raises_the_outer_rail(radius: float) -> None:
    """Half way through the transition, half of 150 mm over 1.5 m: a twentieth."""
    across = track(radius=radius, transition=100.0, cant=0.15).across(np.array([50.0, 500.0]))
    outwards = -np.sign(radius) * across.left[:, 2]
    np.testing.assert_allclose(outwards, [0.05, 0.1], atol=1e-15)
    check_orthonormal(across)


def test_offsets_and_heights_are_those_of_the_point() -> None:
    across = track(radius=600.0, transition=60.0, cant=0.1).across(np.array([30.0, 400.0]))
    b, h = np.array([0.3, -0.2]), np.array([5.5, 7.0])
    r = across.point(b, h)
    np.testing.assert_allclose(across.lateral(r), b, atol=1e-12)
    np.testing.assert_allclose(across.height(r), h, atol=1e-12)
    np.testing.assert_allclose(across.off(r), 0.0, atol=1e-12)
    raised = r + np.array([0.0, 0.0, 1e-3])
    assert np.all(np.abs(across.height(raised) - h) > 9e-4)
