"""What supports do to the first guess: rollers, friction, springs, cantilevers, arms; pulled ends."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.spatial.guess import Guess, guess, weightless
from catenaria.discretise.spatial.layout import LaidCantilever, Layout
from catenaria.mechanics.chain import Section

FloatArray = NDArray[np.float64]

H, G, EA = 10e3, 9.8, 1e7
SAGGING = (0.0, 50.0, 120.0, 170.0)


def over(drawn: SimpleNamespace, *holds: object, **wire: object) -> Layout:
    """One wire over supports at unequal distances, of which the inner ones are given."""
    ends = (SAGGING[0], 0.0, 6.0), (SAGGING[-1], 0.0, 6.0)
    return drawn.lay([drawn.rope(ends, H, **wire)], holds)


def tensions_beside(found: Guess, at: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the tensions before and behind material points of the first wire, by Green strain."""

    def tension(s: FloatArray) -> FloatArray:
        size = np.linalg.norm(found.courses[0].place(s)[1], axis=1)
        return EA * 0.5 * (size**2 - 1.0) * size

    return tension(at - 1e-9), tension(at + 1e-9)


def test_rollers_let_the_tension_pass_and_brackets_its_part_along_the_track(drawn: SimpleNamespace) -> None:
    for kind, passes in (("sliding", True), ("bracket", False)):
        found = guess(over(drawn, *(drawn.hold(0, x, 6.0, kind=kind) for x in SAGGING[1:-1])))
        before, behind = tensions_beside(found, found.hold_s)
        assert np.all(np.abs(behind - before) < 0.01) == passes
        assert np.all(np.abs(found.hold_force[:, 0]) < 1e-9) != passes
        assert found.hold_force[:, 2].min() < -500.0


def check_friction(found: Guess, friction: float) -> None:
    before, behind = tensions_beside(found, found.hold_s)
    load = np.linalg.norm(found.hold_force, axis=1)
    np.testing.assert_allclose(behind - before, friction * load, atol=0.02)


@pytest.mark.parametrize("at_end", [False, True])
def test_friction_takes_from_the_tension(drawn: SimpleNamespace, at_end: bool) -> None:
    """T2 - T1 = f |la|, and the tension is the prescribed one at the end where it is measured."""
    held = [drawn.hold(0, x, 6.0, friction=-0.1) for x in SAGGING[1:-1]]
    found = guess(over(drawn, *held, at_end=at_end))
    check_friction(found, -0.1)
    with pytest.raises(AssertionError):
        check_friction(found, -0.101)
    size = np.linalg.norm(found.end_force[0], axis=1)
    assert size[int(at_end)] == pytest.approx(H, abs=0.01)
    assert abs(size[1 - int(at_end)] - H) > 100.0


def test_springs_give_way_by_force_over_stiffness(drawn: SimpleNamespace) -> None:
    compliance = (1e-4, 5e-5)
    held = drawn.hold(0, 50.0, 6.0, lateral=0.3, kind="spring", compliance=compliance)
    layout = over(drawn, held, drawn.hold(0, 120.0, 6.0))
    found = guess(layout)
    r, _ = found.courses[0].place(found.hold_s[:1])
    way = (r[0] - layout.holds.X[0])[1:]
    np.testing.assert_allclose(way, found.hold_force[0, 1:] * compliance, rtol=1e-6)
    assert np.all(np.abs(way) > 1e-3)


def test_cantilever_gives_way_like_a_clamped_beam(drawn: SimpleNamespace) -> None:
    """F L^3/(3 EJ) and its own weight, q L^4/(8 EJ); hardly at all along itself."""
    beam = Section(EA=2e8, EJ=4e5, rhoA=8.0)
    layout = over(drawn, drawn.hold(0, 50.0, 6.0, lateral=0.3, kind="cantilever"), drawn.hold(0, 120.0, 6.0))
    layout = replace(layout, cantilevers=(LaidCantilever(0, layout.holds.X[0] + [0.0, 3.0, 0.0], beam, 4),))
    found = guess(layout)
    r, _ = found.courses[0].place(found.hold_s[:1])
    way, force = r[0] - layout.holds.X[0], found.hold_force[0]
    sag = force[2] * 27.0 / (3.0 * beam.EJ) - beam.rhoA * G * 81.0 / (8.0 * beam.EJ)
    assert way[2] == pytest.approx(sag, rel=1e-6)
    assert way[2] != pytest.approx(force[2] * 27.0 / (3.0 * beam.EJ), rel=1e-3)
    assert way[1] == pytest.approx(force[1] * 3.0 / beam.EA, rel=1e-5)


def arm(drawn: SimpleNamespace, side: float, length: float = 1.0) -> Layout:
    """A steady arm of 0.5 kg pulls (1) or pushes (-1) a wire to the left, between two brackets."""
    hinge = (50.0, 0.3 + side * 0.98, 6.2)
    held = drawn.hold(
        0, 50.0, 6.0, lateral=0.3, kind="arm", hinge=hinge, arm_length=length, arm_mass=0.5, side=side
    )
    before, behind = (drawn.hold(0, x, 6.0, lateral=0.28, kind="bracket") for x in (45.0, 55.0))
    return over(drawn, before, held, behind)


def check_arm(layout: Layout, found: Guess, mass: float) -> None:
    """The wire is as far from the hinge as the arm is long; the force less half a weight runs along it."""
    r, _ = found.courses[0].place(found.hold_s[1:2])
    d = r[0] - layout.holds.hinge[1]
    assert np.linalg.norm(d) == pytest.approx(1.0, abs=3e-4)
    axial = found.hold_force[1] - [0.0, 0.0, 0.5 * mass * G]
    assert abs(np.cross(axial, d)[0]) < 0.05
    assert abs(r[0, 1] - 0.3) < 0.1


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_force_of_an_arm_runs_along_it(drawn: SimpleNamespace, side: float) -> None:
    layout = arm(drawn, side)
    found = guess(layout)
    check_arm(layout, found, 0.5)
    assert found.hold_force[1, 1] < -50.0
    with pytest.raises(AssertionError):
        check_arm(layout, found, 0.6)


def test_prescribed_lift_is_the_vertical_force(drawn: SimpleNamespace) -> None:
    held = drawn.hold(0, 50.0, 6.0, lateral=0.3, kind="arm", lift=80.0, side=1.0)
    layout = over(drawn, held, drawn.hold(0, 120.0, 6.0))
    found = guess(layout)
    assert found.hold_force[0, 2] == pytest.approx(-80.0, abs=1e-6)
    r, _ = found.courses[0].place(found.hold_s[:1])
    assert r[0, 1] == pytest.approx(0.3, abs=1e-6)
    assert r[0, 2] < 5.7  # 80 N carry less than a tenth of the wire


def sagging(drawn: SimpleNamespace, pulled: tuple[bool, bool]) -> Layout:
    return over(drawn, *(drawn.hold(0, x, 6.0) for x in SAGGING[1:-1]), pulled=pulled)


@pytest.mark.parametrize("pulled", [(True, True), (True, False), (False, True)])
def test_weightless_wire_is_pulled_straight(drawn: SimpleNamespace, pulled: tuple[bool, bool]) -> None:
    """What the arcs were longer than their chords, w^2 a^3/(24 H^2) each, the pulled ends share."""
    layout = sagging(drawn, pulled)
    full = guess(layout)
    light = weightless(layout, full)
    w, spans = G / float(stretch(H, EA)), np.diff(SAGGING)
    excess = float(np.sum(w**2 * spans**3)) / (24.0 * H**2)
    course = light.courses[0]
    assert course.length == full.courses[0].length
    assert course.pull * sum(pulled) == pytest.approx(excess, rel=5e-3)
    assert full.courses[0].pull == 0.0
    r, r1 = course.place(np.linspace(0.0, course.length, 50))
    ends = layout.wires[0].ends + np.outer(np.array([-1.0, 1.0]) * pulled * course.pull, [1.0, 0.0, 0.0])
    np.testing.assert_allclose(r[[0, -1]], ends, atol=1e-8)
    np.testing.assert_allclose(r[:, 2], 6.0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(r1, axis=1), float(stretch(H, EA)), rtol=1e-9)
    assert np.ptp(full.courses[0].place(np.linspace(0.0, course.length, 50))[0][:, 2]) > 0.2


def test_weightless_droppers_only_reach(drawn: SimpleNamespace) -> None:
    ropes = [
        drawn.rope(((0.0, 0.2, 5.0), (60.0, 0.2, 5.0)), H, name="contact wire", role="contact wire"),
        drawn.rope(((0.0, 0.0, 6.5), (60.0, 0.0, 6.5)), H),
    ]
    layout = drawn.lay(ropes, hung=[drawn.dropper(0, 1, x, 5.0, rhoA=0.1) for x in (15.0, 30.0, 45.0)])
    light = weightless(layout, guess(layout))
    np.testing.assert_array_equal(light.density, 0.0)
    np.testing.assert_allclose(light.dropper_length, np.hypot(1.5, 0.2), atol=1e-9)
    np.testing.assert_allclose(light.end_force[..., 2], 0.0, atol=1e-9)


def test_weightless_tied_wire_is_made_shorter(drawn: SimpleNamespace) -> None:
    """Of a tied wire the mesh stays, and `pull` is how much longer it is made."""
    ropes = [
        drawn.rope(((0.0, 0.0, 7.0), (120.0, 0.0, 7.0)), H),
        drawn.rope(None, 2e3, name="stitch wire", role="stitch wire"),
    ]
    tied = [drawn.tie(1, end, 0, x) for end, x in enumerate((51.0, 69.0))]
    layout = drawn.lay(ropes, [drawn.hold(0, 60.0, 7.0)], tied=tied, massive=[drawn.mass(1, 60.0, 15.0)])
    full = guess(layout)
    light = weightless(layout, full)
    course = light.courses[1]
    assert course.length == full.courses[1].length
    assert course.length + course.pull == pytest.approx(18.0 / float(stretch(2e3, EA)), abs=1e-6)
    assert course.pull < -0.01
    (r, r1), s = course.place(np.array([0.0, course.length])), light.tie_s
    np.testing.assert_allclose(r, light.courses[0].place(s)[0], atol=1e-8)
    np.testing.assert_allclose(np.linalg.norm(r1, axis=1), 18.0 / course.length, rtol=1e-9)
