"""Radial forces of steady arms and messenger supports against the polygon of the standards.

Kiessling et al. 2018, Contact Lines for Electric Railways: a wire under tension T pulls its support sideways
by T a/R in a curve and by T ((b_(i-1) - b_i)/a_(i-1) + (b_(i+1) - b_i)/a_i) where staggers b differ.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.line import Line
from catenaria.results import FormResult

Change = dict[str, Any]
Make = Callable[..., Line]
Find = Callable[[Line], FormResult]

LENGTHS = (60.0, 50.0, 55.0)
STAGGERS = (0.2, -0.25, 0.3, -0.15)
UP = np.array([0.0, 0.0, 1.0])
GRAVITY = 9.80665
WEIGHT = 1.07 * GRAVITY  # N/m of the contact wire


@pytest.fixture(scope="module")
def sideways(arm: Change, strings: Change) -> Callable[..., Change]:
    """Return changes to three unequal spans of strings, or wires, with arms that hold them at staggers."""

    def change(*, bending: bool = False) -> Change:
        held: Change = {} if bending else strings.copy()
        held |= {"supports.*.contact_wire": arm, "supports.*.contact_wire.arm.side": "left"}
        for i, (length, droppers) in enumerate(zip(LENGTHS, (5, 4, 5), strict=True)):
            held[f"spans.{i}.length"] = length
            positions = np.linspace(5.0, length - 5.0, droppers).tolist()
            held[f"spans.{i}.droppers"] = {"positions": positions}
        return held | {f"supports.{i}.stagger": b for i, b in enumerate(STAGGERS)}

    return change


def curve(radius: float, transition: float = 0.0) -> Change:
    """Return a curve without cant, whose first transition begins after the first support."""
    start = 20.0 if transition else -300.0
    bend = {"start": start, "length": 900.0, "radius": radius, "transition": transition}
    return {"track": {"curves": [bend]}}


def _on_supports(result: FormResult, wire: str) -> tuple[np.ndarray, np.ndarray]:
    """Return lateral forces [N] and places in plan [m] at the supports of a wire."""
    table = result.supports
    own = np.array(table.wire) == wire
    return table.force_lateral[own], np.column_stack((table.x, table.y))[own]


def polygon(line: Line, result: FormResult, wire: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the pull of a polygon of a wire in plan at its ends, and sideways at inner supports [N].

    An arm takes nothing along the track: from span to span, the component of the tension along it is kept.
    A roller keeps the tension itself.
    """
    at = _on_supports(result, wire)[1]
    along = line.alignment.frames(np.array(line.support_x)).along[:, :2]
    chord = np.diff(at, axis=0)
    chord /= np.linalg.norm(chord, axis=1)[:, None]
    chord = np.concatenate((along[:1], chord, along[-1:]))
    before, behind = (np.einsum("ni,ni->n", part, along) for part in (chord[:-1], chord[1:]))
    H = float(np.hypot(*result.wire(wire).end_force[1, :2]))
    change = behind / before if wire == "contact wire" else np.ones(along.shape[0])
    H = H * np.append(np.cumprod(change[::-1])[::-1], 1.0)
    force = np.diff(H[:, None] * chord, axis=0)
    left = np.column_stack((-along[:, 1], along[:, 0]))
    return H[[0, -1]], np.einsum("ni,ni->n", left, force)[1:-1]


def standard(T: float, radius: float) -> np.ndarray:
    """Return the formula of the standards for the inner supports [N], positive to the left."""
    a, b = np.array(LENGTHS), np.array(STAGGERS)
    stagger = np.diff(b) / a
    return T * (np.diff(stagger) + (a[1:] + a[:-1]) / (2.0 * radius))


def check_radial(line: Line, result: FormResult) -> None:
    """Droppers hang vertically, as both wires have the same stagger: nothing else pulls sideways.

    The messenger's rollers keep T, not H, which is (V/T)^2/2 or 8e-4 less where it is V/T = 0.04 steep.
    """
    assert result.droppers.inclination.max() < 1e-5
    for wire, bound in (("contact wire", 1e-5), ("messenger wire", 8e-4)):
        ends, sideways = polygon(line, result, wire)
        np.testing.assert_allclose(_on_supports(result, wire)[0][1:-1], sideways, rtol=bound, atol=0.02)
        found = np.hypot(*result.wire(wire).end_force[:, :2].T)
        np.testing.assert_allclose(found, ends, rtol=bound)


@pytest.mark.parametrize("track", [{}, curve(500.0), curve(-500.0), curve(500.0, 80.0)])
def test_wires_pull_supports_like_a_polygon(
    make: Make, find: Find, sideways: Callable[..., Change], track: Change
) -> None:
    line = make(3, sideways(), track)
    result = find(line)
    check_radial(line, result)
    with pytest.raises(AssertionError):
        check_radial(make(3, sideways(), curve(510.0)), result)
    other = replace(result.supports, force_lateral=1.004 * result.supports.force_lateral)
    with pytest.raises(AssertionError):
        check_radial(line, replace(result, supports=other))


def lever(line: Line, result: FormResult) -> np.ndarray:
    """Return what inclined droppers pull inner supports sideways, by the law of the lever [N]."""
    droppers, at = result.droppers, np.array(line.support_x)
    share = np.array([np.interp(droppers.x, at, hat) for hat in np.eye(at.size)[1:-1]])
    return share @ droppers.on_contact[:, 1]


def bent(line: Line, result: FormResult) -> np.ndarray:
    """Return the formula of the standards for strings that pass a wire's supports as bending makes them [N].

    A wire that is pulled by F is rounded within l = (EJ/T)^(1/2), and its string passes by F l/(2 T) outside
    of it: staggers seem larger.
    """
    layer = np.sqrt(line.conductor("contact").EJ / 15e3)
    beside = _on_supports(result, "contact wire")[0] * layer / (2.0 * 15e3)
    return 15e3 * np.diff(np.diff(STAGGERS - beside) / LENGTHS)


def test_bending_makes_staggers_larger(make: Make, find: Find, sideways: Callable[..., Change]) -> None:
    """1 N of 280 N here; the messenger is rounded less, so that droppers lean by a millimetre: 0.1 N."""
    line = make(3, sideways(bending=True))
    result = find(line)
    force = _on_supports(result, "contact wire")[0][1:-1]
    np.testing.assert_allclose(force, bent(line, result) + lever(line, result), rtol=0.0, atol=0.01)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(force, standard(15e3, np.inf), rtol=0.0, atol=0.5)


@pytest.mark.parametrize("radius", [np.inf, 500.0, -500.0])
def test_the_formula_of_the_standards_holds(
    make: Make, find: Find, sideways: Callable[..., Change], radius: float
) -> None:
    """It takes sines for angles, which costs (a/R)^2/24, and offsets for arcs, b/R; see the bound."""
    line = make(3, sideways(), curve(radius) if np.isfinite(radius) else {})
    result = find(line)
    force = _on_supports(result, "contact wire")[0][1:-1]
    expected = standard(15e3, radius)
    bound = 0.02 + 15e3 * (0.12**3 / 24.0 + 3.0 * 0.3 * 0.12 / 500.0) * np.isfinite(radius)
    assert bound < 4.5
    np.testing.assert_allclose(force, expected, rtol=0.0, atol=bound)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(force, standard(15e3, -radius) - 9.0, rtol=0.0, atol=bound)


def test_inclined_droppers_pull_by_the_law_of_the_lever(
    make: Make, find: Find, sideways: Callable[..., Change]
) -> None:
    """A messenger in the middle of the track leaves droppers inclined, which pull the contact wire there."""
    line = make(3, sideways(), {"supports.*.messenger_stagger": 0.0})
    result = find(line)
    force = _on_supports(result, "contact wire")[0][1:-1]
    assert result.droppers.inclination.max() > 0.1
    polygon = standard(15e3, np.inf)
    np.testing.assert_allclose(force, polygon + lever(line, result), rtol=0.0, atol=0.05)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(force, polygon + 0.99 * lever(line, result), rtol=0.0, atol=0.05)


MASS: Change = {"supports.*.contact_wire.arm.mass": 4.0}


def check_arms(result: FormResult, weight: float) -> None:
    """Moments about the hinge, the weight in the middle of the arm, and the force in it."""
    arms, supports = result.arms, result.supports
    own = np.array(supports.kind) == "arm"
    force = np.column_stack((supports.force_x, supports.force_y, supports.force_z))[own]
    d = arms.tip - arms.hinge
    moment = np.cross(d, force) + np.cross(0.5 * d, -weight * UP)
    np.testing.assert_allclose(moment, 0.0, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(d, axis=1), arms.length, rtol=1e-12)
    along = d / arms.length[:, None]
    tension = np.einsum("ni,ni->n", along, force - 0.5 * weight * UP)
    np.testing.assert_allclose(arms.axial, tension, atol=1e-9)
    np.testing.assert_allclose(arms.angle, np.arctan2(d[:, 2], np.hypot(d[:, 0], d[:, 1])), atol=1e-12)
    np.testing.assert_allclose(arms.vertical, -supports.force_z[own], atol=1e-12)


def test_arms_are_in_balance_about_their_hinges(
    make: Make, find: Find, sideways: Callable[..., Change]
) -> None:
    result = find(make(3, sideways(), MASS, curve(500.0, 80.0)))
    check_arms(result, 4.0 * GRAVITY)
    with pytest.raises(AssertionError):
        check_arms(result, 4.01 * GRAVITY)


def test_arms_in_tension_and_compression_are_told_apart(
    make: Make, find: Find, sideways: Callable[..., Change]
) -> None:
    """The second wire corner pulls to the left, where the hinge is: the arm is pushed."""
    arms = find(make(3, sideways())).arms
    assert arms.radial[1] < -100.0
    assert arms.axial[1] < -100.0
    assert arms.radial[2] > 100.0
    assert arms.axial[2] > 100.0
    np.testing.assert_array_equal(arms.enough, [True, False, True, False])


def test_a_given_hinge_brings_the_wire_to_its_place(
    make: Make, find: Find, sideways: Callable[..., Change]
) -> None:
    """The hinge that was found for a place of the wire, given, leads back to that place."""
    found = find(make(3, sideways(), MASS))
    given: Change = {}
    for i, (b, h) in enumerate(zip(found.arms.hinge_stagger, found.arms.hinge_height, strict=True)):
        given[f"supports.{i}.contact_wire.arm.hinge"] = {"stagger": float(b), "height": float(h)}
        given[f"supports.{i}.contact_wire.arm.side"] = None
    back = find(make(3, sideways(), MASS, given))
    np.testing.assert_allclose(back.arms.tip, found.arms.tip, rtol=0.0, atol=1e-7)
    np.testing.assert_allclose(back.arms.axial, found.arms.axial, rtol=0.0, atol=1e-4)
    given["supports.1.contact_wire.arm.hinge"]["stagger"] += 0.01
    other = find(make(3, sideways(), MASS, given))
    assert np.abs(other.arms.tip - found.arms.tip).max() > 5e-3


def lifted(lift: float) -> float:
    """Return by how much a string is lifted by a force between two droppers 5 m away on either side [m]."""
    d = 5.0
    w = WEIGHT / (1.0 + 15e3 / (120e9 * 120e-6))
    return (lift - w * d) * d / (2.0 * 15e3)


def test_a_prescribed_lift_finds_the_height(
    make: Make, find: Find, sideways: Callable[..., Change], strings: Change
) -> None:
    """Second order terms of a slope of 1e-2 are what 5 um allow."""
    lift = 60.0
    result = find(make(3, sideways(), strings, {"supports.1.contact_wire.arm.lift": lift}))
    own = np.array(result.supports.kind) == "arm"
    assert result.arms.vertical[1] == pytest.approx(lift, abs=1e-9)
    height = result.supports.height[own][1] - 5.3
    assert height == pytest.approx(lifted(lift), abs=5e-6)
    assert height != pytest.approx(lifted(lift + 0.1), abs=5e-6)
