"""The track in space: circle, clothoid, cant and slope against closed forms, frames and their inverse."""

from __future__ import annotations

from dataclasses import replace
from math import cos, factorial, radians, sin, sqrt, tan

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.line.alignment import Alignment, Frames
from catenaria.line.track import Curve, Gradient, Track

LEFT = Curve(start=100.0, length=600.0, radius=500.0, transition=120.0, cant=0.15)
RIGHT = Curve(start=850.0, length=400.0, radius=-800.0, transition=80.0, cant=0.09)
SLOPES = (Gradient(start=50.0, slope=0.01), Gradient(start=500.0, slope=-0.004))
TRACK = Track(curves=(LEFT, RIGHT), gradients=SLOPES)


def bent(radius: float, length: float, transition: float = 0.0, cant: float = 0.0) -> Alignment:
    """Return a track with one curve, which begins at chainage 0."""
    curve = Curve(start=0.0, length=length, radius=radius, transition=transition, cant=cant)
    return Alignment.of(Track(curves=(curve,)), 0.0)


def clothoid(chainage: float, radius: float, length: float) -> tuple[float, float]:
    """Return x and y of a clothoid by its power series in the angle turned."""
    angle = chainage**2 / (2.0 * radius * length)
    x = sum((-1) ** n * angle ** (2 * n) / (factorial(2 * n) * (4 * n + 1)) for n in range(15))
    y = sum((-1) ** n * angle ** (2 * n + 1) / (factorial(2 * n + 1) * (4 * n + 3)) for n in range(15))
    return chainage * x, chainage * y


def rate(alignment: Alignment, chainage: np.ndarray, h: float = 1e-3) -> np.ndarray:
    """Return the derivative of the axis by the chainage, by central differences."""
    ahead, behind = alignment.frames(chainage + h), alignment.frames(chainage - h)
    return (ahead.origin - behind.origin) / (2.0 * h)


def tangent_error(alignment: Alignment) -> float:
    """Return by how much the derivative of the axis in plan differs from the tangent, also across knots."""
    chainage = np.append(np.linspace(-50.0, 1400.0, 500), alignment.plan.knot)
    return float(np.max(np.abs(rate(alignment, chainage) - alignment.frames(chainage).along)[:, :2]))


def locating_error(alignment: Alignment, reference: Alignment) -> float:
    """Return by how much chainages differ that are found from points of the reference."""
    rng = np.random.default_rng(3)
    chainage = rng.uniform(-100.0, 1500.0, 300)
    frames = reference.frames(chainage)
    points = frames.point(rng.uniform(-10.0, 10.0, 300), rng.uniform(-1.0, 9.0, 300))
    return float(np.max(np.abs(alignment.locate(points, chainage + rng.uniform(-20, 20, 300)) - chainage)))


@pytest.mark.parametrize("start", [0.0, 123.4, -77.7, 54321.0])
def test_a_straight_level_track_is_the_x_axis_bit_for_bit(start: float) -> None:
    chainage = np.random.default_rng(1).uniform(-1e6, 1e6, 1000)
    frames = Alignment.of(Track(), start).frames(chainage)
    assert np.array_equal(frames.chainage, chainage)
    assert np.array_equal(frames.origin, np.stack([chainage, np.zeros(1000), np.zeros(1000)], axis=1))
    for axes, unit in ((frames.along, [1, 0, 0]), (frames.left, [0, 1, 0]), (frames.up, [0, 0, 1])):
        assert np.array_equal(axes, np.tile(unit, (1000, 1)))
        assert not np.any(np.signbit(axes))
    assert np.array_equal(frames.point(0.25, 5.5)[:, 1:], np.tile([0.25, 5.5], (1000, 1)))


def test_a_track_is_the_x_axis_bit_for_bit_until_its_first_curve() -> None:
    chainage = np.linspace(-200.0, 100.0, 301)
    origin = Alignment.of(Track(curves=(LEFT,)), -33.3).frames(chainage).origin
    assert np.array_equal(origin, np.stack([chainage, 0 * chainage, 0 * chainage], axis=1))


@pytest.mark.parametrize("radius", [150.0, 1200.0, -400.0])
def test_an_arc_is_a_circle(radius: float) -> None:
    chainage = np.linspace(0.0, 1000.0, 41)
    frames = bent(radius, 1000.0).frames(chainage)
    angle = chainage / radius
    assert np.allclose(frames.origin[:, 0], radius * np.sin(angle), rtol=0, atol=1e-12)
    assert np.allclose(frames.origin[:, 1], radius * (1.0 - np.cos(angle)), rtol=0, atol=1e-12)
    assert np.allclose(frames.along[:, 1], np.sin(angle), rtol=0, atol=1e-14)


@pytest.mark.parametrize(("radius", "length"), [(150.0, 400.0), (800.0, 120.0), (300.0, 900.0)])
def test_a_transition_is_a_clothoid(radius: float, length: float) -> None:
    alignment = bent(radius, 2.0 * length, transition=length)
    for chainage in np.linspace(0.0, length, 13):
        place = alignment.frames(chainage).origin[0, :2]
        assert np.allclose(place, clothoid(chainage, radius, length), rtol=0, atol=1e-12)
    end = alignment.frames(length).origin[0, :2]
    assert not np.allclose(end, clothoid(length, 1.001 * radius, length), rtol=0, atol=1e-3)


def test_the_chord_of_a_whole_curve_halves_the_angle_that_it_turns() -> None:
    alignment = bent(500.0, 1000.0, transition=150.0)
    end = alignment.frames(1000.0)
    turned = (1000.0 - 150.0) / 500.0
    assert np.allclose(end.along[0, :2], [cos(turned), sin(turned)], rtol=0, atol=1e-14)
    assert end.origin[0, 1] == pytest.approx(end.origin[0, 0] * tan(turned / 2.0), abs=1e-12)


def test_a_curve_to_the_right_is_the_mirror_image_of_one_to_the_left() -> None:
    chainage = np.linspace(-20.0, 700.0, 73)
    left = bent(400.0, 600.0, 100.0, cant=0.12).frames(chainage)
    right = bent(-400.0, 600.0, 100.0, cant=0.12).frames(chainage)
    mirror = np.array([1.0, -1.0, 1.0])
    assert np.allclose(right.origin, left.origin * mirror, rtol=0, atol=1e-12)
    assert np.allclose(right.up, left.up * mirror, rtol=0, atol=1e-15)
    assert np.allclose(right.left, -left.left * mirror, rtol=0, atol=1e-15)


def test_the_chainage_is_the_length_in_plan() -> None:
    alignment = Alignment.of(TRACK, 0.0)
    chainage = np.linspace(-50.0, 1400.0, 500)
    speed = np.linalg.norm(rate(alignment, chainage)[:, :2], axis=1)
    assert np.allclose(speed, 1.0, rtol=0, atol=1e-8)


def test_the_tangent_is_the_derivative_of_the_axis() -> None:
    alignment = Alignment.of(TRACK, 0.0)
    assert tangent_error(alignment) < 1e-7


def test_a_wrong_heading_or_curvature_is_noticed() -> None:
    alignment = Alignment.of(TRACK, 0.0)
    plan = alignment.plan
    for wrong in (
        replace(plan, heading=plan.heading * 1.0001),
        replace(plan, curvature_rate=plan.curvature_rate * 1.001),
        replace(plan, drift=plan.drift * 1.0001),
    ):
        assert tangent_error(replace(alignment, plan=wrong)) > 1e-5


def test_frames_are_right_handed_and_orthonormal() -> None:
    frames = Alignment.of(TRACK, 0.0).frames(np.linspace(-50.0, 1400.0, 500))
    axes = np.stack([frames.along, frames.left, frames.up], axis=1)
    assert np.allclose(axes @ axes.transpose(0, 2, 1), np.eye(3), rtol=0, atol=1e-14)
    assert np.allclose(np.cross(frames.along, frames.left), frames.up, rtol=0, atol=1e-14)
    assert np.all(frames.along[:, 2] == 0.0)


@pytest.mark.parametrize(("chainage", "share"), [(-10.0, 0.0), (50.0, 0.5), (300.0, 1.0), (575.0, 0.25)])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_cant_raises_the_outer_rail_and_leans_inwards(side: float, chainage: float, share: float) -> None:
    frame = bent(side * 500.0, 600.0, transition=100.0, cant=0.15).frames(chainage)
    inner, outer = frame.point(side * 0.75, 0.0), frame.point(-side * 0.75, 0.0)
    assert outer[0, 2] - inner[0, 2] == pytest.approx(share * 0.15, abs=1e-14)
    assert (inner + outer)[0, 2] == pytest.approx(0.0, abs=1e-14)
    head = frame.point(0.0, 6.0) - frame.origin
    inwards = side * (head[0, 1] * frame.along[0, 0] - head[0, 0] * frame.along[0, 1])
    assert inwards == pytest.approx(6.0 * share * 0.1, abs=1e-12)
    assert head[0, 2] == pytest.approx(6.0 * sqrt(1.0 - (share * 0.1) ** 2), abs=1e-12)


def test_a_wider_track_leans_less() -> None:
    curve = Curve(start=0.0, length=100.0, radius=300.0, cant=0.15)
    lean = [
        Alignment.of(Track(curves=(curve,), rail_spacing=spacing), 0.0).frames(50.0).left[0, 2]
        for spacing in (1.0, 1.5)
    ]
    assert lean == pytest.approx([-0.15, -0.1], abs=1e-15)


def test_the_axis_is_a_polygon_in_elevation() -> None:
    alignment = Alignment.of(TRACK, 0.0)
    heights = alignment.frames([-20.0, 0.0, 50.0, 150.0, 500.0, 1500.0]).origin[:, 2]
    assert np.allclose(heights, [0.0, 0.0, 0.0, 1.0, 4.5, 0.5], rtol=0, atol=1e-14)


def test_rounded_slopes_are_parabolas_of_constant_curvature() -> None:
    """Differences: the slope grows by 10 mm/m over 40 m about 100 m, evenly; a sharp change does not."""
    chainage = np.arange(60.0, 141.0)
    for rounding, even in ((40.0, True), (0.0, False)):
        gradient = Gradient(start=100.0, slope=0.01, rounding=rounding)
        z = Alignment.of(Track(gradients=(gradient,)), 0.0).frames(chainage).origin[:, 2]
        bend = np.diff(z, 2)[np.abs(chainage[1:-1] - 100.0) < 19.5]
        assert np.allclose(bend, 0.01 / 40.0, rtol=0, atol=1e-12) == even
        assert np.allclose(z[chainage >= 120.0], 0.01 * (chainage[chainage >= 120.0] - 100.0), atol=1e-12)
        assert np.allclose(z[chainage <= 80.0], 0.0, atol=1e-15)


def test_a_gradient_leaves_plan_and_planes_across_the_track_as_they_are() -> None:
    chainage = np.linspace(-50.0, 1400.0, 100)
    frames, level = (
        Alignment.of(track, 0.0).frames(chainage) for track in (TRACK, Track(curves=TRACK.curves))
    )
    assert np.array_equal(frames.origin[:, :2], level.origin[:, :2])
    assert np.array_equal(frames.up, level.up)
    assert not np.array_equal(frames.origin, level.origin)


@pytest.mark.parametrize("start", [0.0, 130.0, 400.0, 800.0, 1100.0, 2000.0])
def test_the_first_support_stands_where_the_axes_begin(start: float) -> None:
    alignment = Alignment.of(TRACK, start)
    first = alignment.frames(start)
    assert np.allclose(first.origin[0], [start, 0.0, 0.0], rtol=0, atol=1e-12)
    assert np.allclose(first.along[0], [1.0, 0.0, 0.0], rtol=0, atol=1e-15)
    chainage = np.linspace(-50.0, 1400.0, 30)
    moved, origin = alignment.frames(chainage).origin, Alignment.of(TRACK, 0.0).frames(chainage).origin
    apart = [np.linalg.norm(r[:, np.newaxis] - r, axis=2) for r in (moved, origin)]
    assert np.allclose(*apart, rtol=0, atol=1e-11)


def test_curves_may_follow_each_other_at_once() -> None:
    s_curve = Track(
        curves=(
            Curve(start=0.0, length=300.0, radius=400.0, transition=150.0),
            Curve(start=300.0, length=300.0, radius=-400.0, transition=150.0),
        )
    )
    alignment = Alignment.of(s_curve, 0.0)
    middle, end = alignment.frames([300.0, 600.0]).origin
    assert np.allclose(end, 2.0 * middle, rtol=0, atol=1e-12)
    assert alignment.frames(600.0).along[0, 1] == pytest.approx(0.0, abs=1e-14)
    assert tangent_error(alignment) < 1e-6


def test_the_track_runs_straight_on_behind_its_last_curve() -> None:
    frames = Alignment.of(TRACK, 0.0).frames([1250.0, 1350.0, 9250.0])
    assert np.allclose(frames.along, frames.along[0], rtol=0, atol=1e-15)
    assert np.allclose(
        frames.origin[2, :2], frames.origin[0, :2] + 8000.0 * frames.along[0, :2], rtol=0, atol=1e-9
    )


def test_points_are_located_at_their_chainage() -> None:
    alignment = Alignment.of(TRACK, 0.0)
    assert locating_error(alignment, alignment) < 1e-11
    straight = Alignment.of(Track(), 0.0)
    assert locating_error(straight, straight) == 0.0


def test_points_are_not_located_on_another_track() -> None:
    other = Track(curves=(LEFT.model_copy(update={"radius": 501.0}), RIGHT), gradients=SLOPES)
    assert locating_error(Alignment.of(other, 0.0), Alignment.of(TRACK, 0.0)) > 1e-3


def test_offsets_of_points_are_found_again() -> None:
    rng = np.random.default_rng(5)
    lateral, height = rng.uniform(-3.0, 3.0, 200), rng.uniform(0.0, 8.0, 200)
    frames = Alignment.of(TRACK, 0.0).frames(rng.uniform(0.0, 1300.0, 200))
    points = frames.point(lateral, height)
    assert np.allclose(frames.lateral(points), lateral, rtol=0, atol=1e-12)
    assert np.allclose(frames.height(points), height, rtol=0, atol=1e-12)
    assert np.allclose(np.sum(frames.along * (points - frames.origin), axis=1), 0.0, rtol=0, atol=1e-12)


def test_a_point_beyond_the_centre_of_a_curve_is_not_located() -> None:
    alignment = bent(150.0, 1000.0)
    beyond = alignment.frames(100.0).point(150.001, 5.0)
    with pytest.raises(NotConvergedError, match="holds the point"):
        alignment.locate(beyond, 100.0)
    before = alignment.frames(100.0).point(149.0, 5.0)
    assert alignment.locate(before, 100.5) == pytest.approx(100.0, abs=1e-9)


def test_frames_are_chosen_and_joined() -> None:
    frames = Alignment.of(TRACK, 0.0).frames(np.linspace(0.0, 1200.0, 7))
    odd, even = frames.take(np.arange(1, 7, 2)), frames.take(slice(0, None, 2))
    joined = Frames.concatenate([even, odd])
    order = np.array([0, 2, 4, 6, 1, 3, 5])
    for name in ("chainage", "origin", "along", "left", "up"):
        assert np.array_equal(getattr(joined, name), getattr(frames, name)[order])
    assert frames.take(frames.chainage > 700.0).chainage.tolist() == [800.0, 1000.0, 1200.0]
    assert frames.take(np.zeros(0, dtype=np.int64)).origin.shape == (0, 3)


def test_no_chainages_have_no_frames() -> None:
    alignment = Alignment.of(TRACK, 0.0)
    assert alignment.frames(np.zeros(0)).up.shape == (0, 3)
    assert alignment.locate(np.zeros((0, 3)), 0.0).shape == (0,)


def test_a_known_place() -> None:
    """A quarter of a circle of 100 m to the left, from a hand calculation."""
    frames = bent(100.0, 400.0).frames(100.0 * radians(90.0))
    assert np.allclose(frames.origin[0], [100.0, 100.0, 0.0], rtol=0, atol=1e-12)
    assert np.allclose(frames.left[0], [-1.0, 0.0, 0.0], rtol=0, atol=1e-15)
