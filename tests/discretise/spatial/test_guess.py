"""The first guess of a line in space against closed forms of strings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.catenary.hanging_chain import hanging_chain
from catenaria.discretise.spatial.course import Course
from catenaria.discretise.spatial.guess import Guess, guess
from catenaria.discretise.spatial.laid import Laid
from catenaria.discretise.spatial.layout import Layout
from catenaria.line.alignment import Alignment

FloatArray = NDArray[np.float64]

SPAN, H, G = 60.0, 10e3, 9.8
EA = 1e7


def course_of(found: Guess, wire: int = 0) -> Course:
    course = found.courses[wire]
    assert isinstance(course, Course)
    return course


def forces(course: Laid, s: FloatArray) -> FloatArray:
    """Return the forces of a wire on the part before s: its axial force by Green strain along its tangent."""
    _, r1 = course.place(s)
    size = np.sum(r1**2, axis=1)
    return EA * 0.5 * (size - 1.0)[:, None] * r1


def span_of(drawn: SimpleNamespace, rise: float = 0.0, **changes: object) -> Layout:
    """A single span of a string that is held at its ends only."""
    ends = (0.0, 0.0, 6.0), (SPAN, 0.0, 6.0 + rise)
    return drawn.lay([drawn.rope(ends, H, **changes)])


def check_sag(course: Laid, w: float) -> None:
    """The parabola's sag, and an arc that is longer than the chord by w^2 L^3/(24 H^2).

    T at the end has the horizontal part T cos(w L/(2 T)), and weight is spread over the stretched wire, which
    is stretched more where it is inclined: that takes H/EA off the excess.
    """
    r, _ = course.place(np.array([0.5 * course.length]))
    assert r[0, 0] == pytest.approx(0.5 * SPAN, abs=1e-9)
    level, spread = H * np.cos(0.5 * w * SPAN / H), w / float(stretch(H, EA))
    assert r[0, 2] - 6.0 == pytest.approx(-spread * SPAN**2 / (8.0 * level), abs=1e-5)
    arc = SPAN * (1.0 + (1.0 - level / EA) * (spread * SPAN / level) ** 2 / 24.0)
    assert course.length == pytest.approx(arc / float(stretch(level, EA)), abs=2e-6)


def test_span_hangs_as_a_parabola(drawn: SimpleNamespace) -> None:
    course = course_of(guess(span_of(drawn)))
    check_sag(course, G)
    with pytest.raises(AssertionError):
        check_sag(course, 1.01 * G)
    with pytest.raises(AssertionError):
        check_sag(replace(course, length=course.length + 1e-5), G)


def check_catenary(course: Laid, rise: float) -> None:
    """The inextensible catenary of the same stretched length."""
    s = np.linspace(0.0, course.length, 301)
    r, r1 = course.place(s)
    stretched = np.linalg.norm(0.5 * (r1[1:] + r1[:-1]), axis=1) * np.diff(s)
    along = np.concatenate(([0.0], np.cumsum(stretched)))
    x, z, _, _ = hanging_chain(along, SPAN, rise, along[-1])
    np.testing.assert_allclose(r[:, 0], x, atol=5e-5)
    np.testing.assert_allclose(r[:, 2] - 6.0, z, atol=3e-4)


def test_inclined_span_hangs_as_a_catenary(drawn: SimpleNamespace) -> None:
    check_catenary(guess(span_of(drawn)).courses[0], 0.0)
    inclined = guess(span_of(drawn, rise=3.0)).courses[0]
    check_catenary(inclined, 3.0)
    with pytest.raises(AssertionError):
        check_catenary(inclined, 2.9)


def test_wire_ends_at_its_anchors_and_is_continuous(drawn: SimpleNamespace) -> None:
    bent = replace(drawn.rope(None).section, EJ=300.0)
    rope = drawn.rope(((-5.0, 0.1, 6.0), (125.0, -0.1, 6.2)), H, bent)
    held = [drawn.hold(0, x, 6.0, lateral=b) for x, b in ((0.0, 0.2), (60.0, -0.2), (120.0, 0.2))]
    layout = drawn.lay([rope], held)
    course = guess(layout).courses[0]
    s = np.linspace(0.0, course.length, 20_001)
    r, r1 = course.place(s)
    np.testing.assert_allclose(r[[0, -1]], layout.wires[0].ends, atol=1e-9)
    step = np.diff(r, axis=0) / np.diff(s)[:, None]
    np.testing.assert_allclose(step, 0.5 * (r1[1:] + r1[:-1]), atol=2e-4)
    np.testing.assert_allclose(np.linalg.norm(r1, axis=1), float(stretch(H, EA)), atol=1e-5)


def test_bending_wire_passes_through_its_supports(drawn: SimpleNamespace) -> None:
    ends = (-5.0, 0.0, 6.0), (125.0, 0.0, 6.0)
    held = [drawn.hold(0, x, 6.0, lateral=b) for x, b in ((0.0, 0.2), (60.0, -0.2), (120.0, 0.2))]
    bent = replace(drawn.rope(None).section, EJ=300.0)
    for section, kinked in ((bent, False), (drawn.rope(None).section, True)):
        layout = drawn.lay([drawn.rope(ends, H, section)], held)
        found = guess(layout)
        r, _ = found.courses[0].place(found.hold_s)
        np.testing.assert_allclose(r, layout.holds.X, atol=1e-4)
        bent_off = np.abs(course_of(found).curve.at[1:-1] - layout.holds.X).max()
        assert (bent_off < 1e-4) == kinked  # the string of a wire that bends is beside the supports


def check_polygon(found: FloatArray, stagger: float, span: float) -> None:
    inner = 4.0 * stagger * H / span
    np.testing.assert_allclose(np.abs(found[1:-1, 1]), inner, rtol=1e-6)
    assert np.all(np.sign(found[1:-1, 1]) == -np.sign(stagger) * (-1.0) ** np.arange(1, found.shape[0] - 1))


def test_staggered_wire_pulls_to_the_middle(drawn: SimpleNamespace) -> None:
    """An arm between two spans is pulled with T (2 b + 2 b)/span, and by nothing along the track."""
    places = [(SPAN * i, 0.2 * (-1.0) ** i) for i in range(6)]
    held = [drawn.hold(0, x, 5.3, lateral=b, kind="arm", side=1.0) for x, b in places]
    ends = (-1.0, 0.2, 5.3), (5 * SPAN + 1.0, -0.2, 5.3)
    found = guess(drawn.lay([drawn.rope(ends, H)], held, g=0.0)).hold_force
    check_polygon(found, 0.2, SPAN)
    np.testing.assert_allclose(found[:, 0], 0.0, atol=1e-9)  # arms take nothing along the track
    with pytest.raises(AssertionError):
        check_polygon(found, 0.21, SPAN)


def test_curve_pulls_inwards(drawn: SimpleNamespace, curved: Callable[..., Alignment]) -> None:
    """2 T tan(a/(2 R)), about T a/R, at equal spans a, whichever way the track bends."""
    for radius in (800.0, -500.0):
        alignment = curved(radius, 0.1)
        held = [drawn.hold(0, 50.0 * (i + 1), 5.3, lateral=0.2, kind="arm", side=1.0) for i in range(6)]
        ends = (49.0, 0.2, 5.3), (301.0, 0.2, 5.3)
        layout = drawn.lay([drawn.rope(ends, H)], held, g=0.0, alignment=alignment)
        force = guess(layout).hold_force[2:-2]
        left = np.cross([0.0, 0.0, 1.0], layout.holds.frame.along)[2:-2]
        inwards = np.sum(force * left, axis=1) * np.sign(radius)
        np.testing.assert_allclose(inwards, 2.0 * H * np.tan(25.0 / abs(radius)), rtol=1e-6)
        assert inwards[0] == pytest.approx(H * 50.0 / abs(radius), rel=1e-3)
        assert inwards[0] != pytest.approx(H * 49.0 / abs(radius), rel=1e-3)


def inclined_dropper(drawn: SimpleNamespace, stagger: float) -> Layout:
    """A contact wire beside a messenger wire, and one dropper at midspan between them."""
    ropes = [
        drawn.rope(((0.0, stagger, 5.0), (SPAN, stagger, 5.0)), H, name="contact wire", role="contact wire"),
        drawn.rope(((0.0, 0.0, 6.5), (SPAN, 0.0, 6.5)), 1.5 * H),
    ]
    return drawn.lay(ropes, hung=[drawn.dropper(0, 1, 0.5 * SPAN, 5.05)])


def check_pair(found: FloatArray, density: float, stagger: float) -> None:
    """Heights and lateral offsets of both clamps under one dropper, each wire with stiffness 4 H/L."""
    half = [0.5 * SPAN * G / float(stretch(T, EA)) for T in (H, 1.5 * H)]  # weights that hang at midspan
    pull = 4.0 * H / SPAN * 0.05 + half[0]
    at_ends = half[0] - 0.5 * pull, half[1] + 0.5 * pull
    k_low, k_up = (4.0 * np.sqrt(T**2 - V**2) / SPAN for T, V in zip((H, 1.5 * H), at_ends, strict=True))
    pull = k_low * 0.05 + half[0]
    top = 6.5 - (pull + half[1]) / k_up
    q = pull / (top - 5.05)
    lateral = stagger / (1.0 + q / k_low + q / k_up)  # of the upper clamp from the lower one
    expected = [
        [0.5 * SPAN, stagger - q * lateral / k_low, 5.05],
        [0.5 * SPAN, q * lateral / k_up, top],
    ]
    np.testing.assert_allclose(found, expected, atol=1e-4)
    assert density == pytest.approx(q, rel=1e-4)


def test_inclined_dropper_balances_both_wires(drawn: SimpleNamespace) -> None:
    layout = inclined_dropper(drawn, 0.3)
    found = guess(layout)
    clamps = np.concatenate(
        [course.place(s)[0] for course, s in zip(found.courses, (found.lower_s, found.upper_s), strict=True)]
    )
    check_pair(clamps, float(found.density[0]), 0.3)
    d = float(np.linalg.norm(clamps[1] - clamps[0]))
    strained = (d**2 / found.dropper_length[0] ** 2 - 1.0) / 2.0  # Green strain
    force_by_length = found.density[0] * found.dropper_length[0] * 1e-6
    assert strained == pytest.approx(force_by_length, rel=1e-6)
    with pytest.raises(AssertionError):
        check_pair(clamps, float(found.density[0]), 0.31)


def test_weights_of_droppers_and_masses_are_carried(drawn: SimpleNamespace) -> None:
    """All that hangs is carried by the ends."""
    ropes = [
        drawn.rope(((0.0, 0.0, 5.0), (SPAN, 0.0, 5.0)), H, name="contact wire", role="contact wire"),
        drawn.rope(((0.0, 0.0, 6.5), (SPAN, 0.0, 6.5)), 1.5 * H),
    ]
    hung = [drawn.dropper(0, 1, x, 5.0, rhoA=0.1, mass_bottom=0.2, mass_top=0.3) for x in (15.0, 30.0, 45.0)]
    found = guess(drawn.lay(ropes, hung=hung, massive=[drawn.mass(0, 20.0, 12.0)]))
    d = np.linalg.norm(
        found.courses[1].place(found.upper_s)[0] - found.courses[0].place(found.lower_s)[0], axis=1
    )
    mass = 12.0 + 3 * 0.5 + 0.1 * d.sum() + sum(course.length for course in found.courses)
    assert -found.end_force[..., 2].sum() == pytest.approx(G * mass, rel=1e-5)
    assert -found.end_force[..., 2].sum() != pytest.approx(G * (mass - 0.1), rel=1e-5)


def test_targets_are_normal_to_the_canted_track(
    drawn: SimpleNamespace, curved: Callable[..., Alignment]
) -> None:
    alignment = curved(600.0, 0.15)
    held = [
        drawn.hold(wire, x, height, lateral=0.2, kind="arm" if wire == 0 else "sliding", side=1.0)
        for wire, height in ((0, 5.3), (1, 6.8))
        for x in (50.0, 100.0)
    ]
    ropes = [
        drawn.rope(((49.0, 0.2, 5.3), (101.0, 0.2, 5.3)), H, name="contact wire", role="contact wire"),
        drawn.rope(((49.0, 0.2, 6.8), (101.0, 0.2, 6.8)), H),
    ]
    hung = [drawn.dropper(0, 1, x, 5.28) for x in (60.0, 75.0, 90.0)]
    layout = drawn.lay(ropes, held, hung, alignment=alignment)
    found = guess(layout)
    r, _ = found.courses[0].place(found.lower_s)
    frame = layout.droppers.frame
    np.testing.assert_allclose(frame.height(r), 5.28, atol=1e-6)
    np.testing.assert_allclose(np.sum(frame.along * (r - frame.origin), axis=1), 0.0, atol=1e-6)
    assert np.abs(r[:, 2] - 5.28).min() > 0.01  # the track is canted


def stitched(drawn: SimpleNamespace, backwards: bool = False) -> Layout:
    """A messenger wire over one support, with a stitch wire tied to it at 9 m on either side."""
    ropes = [
        drawn.rope(((0.0, 0.0, 7.0), (120.0, 0.0, 7.0)), H),
        drawn.rope(None, 2e3, name="stitch wire", role="stitch wire"),
    ]
    places = (69.0, 51.0) if backwards else (51.0, 69.0)
    tied = [drawn.tie(1, end, 0, x) for end, x in enumerate(places)]
    return drawn.lay(ropes, [drawn.hold(0, 60.0, 7.0)], tied=tied, massive=[drawn.mass(1, 60.0, 15.0)])


def check_ties(layout: Layout, tie_s: FloatArray, tie_force: FloatArray) -> None:
    """Three forces balance at each tie: the host's on both sides, and the tied wire's."""
    host, own = guess(layout).courses
    ahead, behind = forces(host, tie_s + 1e-9), forces(host, tie_s - 1e-9)
    np.testing.assert_allclose(ahead - behind + tie_force, 0.0, atol=0.2)
    at_ends = forces(own, np.array([1e-9, own.length - 1e-9])) * [[1.0], [-1.0]]
    np.testing.assert_allclose(tie_force, at_ends, atol=0.2)
    assert np.linalg.norm(tie_force[1]) == pytest.approx(2e3, abs=0.2)


@pytest.mark.parametrize("backwards", [False, True])
def test_three_forces_balance_at_a_tie(drawn: SimpleNamespace, backwards: bool) -> None:
    layout = stitched(drawn, backwards)
    found = guess(layout)
    check_ties(layout, found.tie_s, found.tie_force)
    with pytest.raises(AssertionError):
        check_ties(layout, found.tie_s, 1.001 * found.tie_force)
    with pytest.raises(AssertionError):
        check_ties(layout, found.tie_s + 0.01, found.tie_force)
    at = found.tie_s, np.array([0.0, found.courses[1].length])
    (r0, _), (r1, _) = (course.place(s) for course, s in zip(found.courses, at, strict=True))
    np.testing.assert_allclose(r0, r1, atol=1e-6)


def test_mesh_is_fine_where_something_acts(drawn: SimpleNamespace) -> None:
    layout = stitched(drawn)
    found = guess(layout)
    np.testing.assert_array_equal(found.centres(layout, 0), [found.tie_s[0], found.hold_s[0], found.tie_s[1]])
    np.testing.assert_array_equal(found.centres(layout, 1), found.mass_s)
    assert found.mass_s[0] == pytest.approx(0.5 * found.courses[1].length, abs=1e-6)
