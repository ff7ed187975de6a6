"""Stitch wires, auxiliary messengers, two contact wires, anchors, wear, devices: against strings."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.catenary.green_bar import stretch
from catenaria.line import Line
from catenaria.results import FormResult

Change = dict[str, Any]
Make = Callable[..., Line]
Find = Callable[[Line], FormResult]
Hung = Callable[..., tuple[np.ndarray, np.ndarray]]

GRAVITY = 9.80665
FINER: Change = {"solver.mesh.refine": 4}  # the tension over rollers comes out to 1e-6
EA = {"contact": 120e9 * 120e-6, "messenger": 113e9 * 65.8e-6}
RHO = {"contact": 1.07, "messenger": 0.596, "dropper": 0.089}


def taut_weight(conductor: str, T: float, left: float = 1.0) -> float:
    """Return the weight of a taut wire, of which a part may be worn off [N/m]."""
    return left * RHO[conductor] * GRAVITY / float(stretch(T, left * EA[conductor]))


def force_in(result: FormResult, wire: str, near: float, at: float, w: float) -> np.ndarray:
    """Return the force (along, up) in a wire at x = `at`, of its bay around x = `near` [N].

    The bay is the parabola of a string: its slope in the middle changes by w/H per length.
    """
    shape = result.wire(wire).profile
    slope = np.interp(near, shape.x, np.gradient(shape.z, shape.x))
    H = float(np.interp(near, shape.x, shape.horizontal))
    return np.array([H, H * slope + w * (at - near)])


# --- stitch wires ---------------------------------------------------------------------------------------

STITCH: Change = {"stitch_wire": {"conductor": "dropper", "tension": 2.5e3, "length": 18.0}}


@pytest.fixture(scope="module")
def stitched(make: Make, find: Find, strings: Change) -> FormResult:
    return find(make(2, strings, STITCH))


def check_tie(result: FormResult, *, share: float = 1.0) -> None:
    """The forces of the messenger on both sides and of the stitch wire at both ties, 51 m and 69 m.

    0.05 N is what a slope read from the profile is good for.
    """
    w = taut_weight("messenger", 12e3)
    assert result.ties.host == ("messenger wire",) * 2
    for at, force in zip(result.ties.chainage, result.ties.force, strict=True):
        before = force_in(result, "messenger wire", at - 4.25, at, w)
        behind = force_in(result, "messenger wire", at + 4.25, at, w)
        np.testing.assert_allclose(behind - before + share * force[[0, 2]], 0.0, atol=0.05)


def test_three_forces_are_in_balance_at_a_tie(stitched: FormResult) -> None:
    np.testing.assert_allclose(stitched.ties.chainage, [51.0, 69.0], atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(stitched.ties.force, axis=1), 2.5e3, rtol=1e-6)
    check_tie(stitched)
    with pytest.raises(AssertionError):
        check_tie(stitched, share=1.0002)


def test_the_stitch_wire_is_a_string_with_two_droppers(stitched: FormResult, hung: Hung) -> None:
    droppers = stitched.droppers
    own = np.array([name.startswith("stitch") for name in droppers.upper_wire])
    np.testing.assert_allclose(droppers.x[own], [55.0, 65.0])
    tie = float(np.interp(51.0, *_shape(stitched, "messenger wire")))
    x, load = np.array([51.0, 55.0, 65.0, 69.0]), np.zeros(4)
    load[1:3] = -droppers.on_messenger[own, 2]
    H = float(stitched.ties.force[0, 0])
    w = RHO["dropper"] * GRAVITY / float(stretch(2.5e3, 119e9 * 10e-6))
    z, force = hung(x, w, H, {0: tie, 3: tie}, load)
    np.testing.assert_allclose(droppers.position_top[own, 2], z[1:3], rtol=0.0, atol=20e-6)
    np.testing.assert_allclose(stitched.ties.force[:, 2], -force[[0, 3]], atol=0.02)
    assert np.abs(hung(x, w, 1.001 * H, {0: tie, 3: tie}, load)[0][1] - z[1]) > 1e-4


def _shape(result: FormResult, wire: str) -> tuple[np.ndarray, np.ndarray]:
    profile = result.wire(wire).profile
    return profile.x, profile.z


def check_carried(result: FormResult, other: FormResult) -> None:
    np.testing.assert_allclose(result.droppers.on_contact, other.droppers.on_contact, atol=1e-6)


def test_what_is_above_does_not_change_what_the_contact_wire_weighs(
    make: Make, find: Find, strings: Change, stitched: FormResult
) -> None:
    check_carried(stitched, find(make(2, strings)))
    with pytest.raises(AssertionError):
        check_carried(stitched, find(make(2, strings, {"spans.0.pre_sag": 1e-4})))


# --- auxiliary messenger --------------------------------------------------------------------------------

COMPOUND: Change = {
    "auxiliary_messenger": {"conductor": "messenger", "tension": {"force": 9e3}, "tail": 3.0},
    "supports.*.auxiliary_messenger": {"height": 6.2},
    "supports.*.messenger_wire.height": 7.4,
    "spans.*.auxiliary": {"droppers": {"positions": [10.0, 24.0, 36.0, 50.0]}, "height": 6.15},
}


def compound(hung: Hung, aux_height: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return forces on the lower wire and lengths of the lower and the upper droppers of a span.

    Three strings one after the other; a dropper weighs on its upper wire with all of its length.
    """
    low, high = np.array([5.0, 17.5, 30.0, 42.5, 55.0]), np.array([10.0, 24.0, 36.0, 50.0])
    per_length = RHO["dropper"] * GRAVITY
    forces, lengths = [np.zeros(0)] * 2, [np.ones(low.size), np.ones(high.size)]
    for _ in range(5):
        x, held = _nodes(low)
        w = taut_weight("contact", 15e3)
        _, R = hung(x, w, 15e3, dict.fromkeys(range(x.size), 5.3), np.zeros(x.size))
        forces[0] = R[held]
        x, held = _nodes(low, high)
        load = np.zeros(x.size)
        load[np.isin(x, low)] = forces[0] + per_length * lengths[0]
        fixed = {i: aux_height for i in np.flatnonzero(np.isin(x, high)).tolist()}
        z, R = _sagged(hung, x, 9e3, fixed | {0: 6.2, x.size - 1: 6.2}, load)
        lengths[0] = z[np.isin(x, low)] - 5.3
        forces[1] = R[np.isin(x, high)]
        x, held = _nodes(high)
        load = np.zeros(x.size)
        load[held] = forces[1] + per_length * lengths[1]
        z, _ = _sagged(hung, x, 12e3, {0: 7.4, x.size - 1: 7.4}, load)
        lengths[1] = z[held] - aux_height
    return forces[0], forces[1], lengths[0], lengths[1]


def _nodes(*places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return both ends of the span and all places between, ascending, and which are such places."""
    x = np.sort(np.concatenate(([0.0, 60.0], *places)))
    return x, (x > 0.0) & (x < 60.0)


def _sagged(
    hung: Hung, x: np.ndarray, T: float, held: dict[int, float], load: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return heights and holding forces of a messenger whose tension at supports is that of its tail.

    An inclined bay weighs more per length in plan.
    """
    w = np.full(x.size - 1, taut_weight("messenger", T))
    z, R = hung(x, w, T, held, load)
    for _ in range(5):
        H = float(np.sqrt(T**2 - R[-1] ** 2))
        w = taut_weight("messenger", T) * np.hypot(1.0, np.diff(z) / np.diff(x))
        z, R = hung(x, w, H, held, load)
    return z, R


def check_compound(result: FormResult, expected: tuple[np.ndarray, ...]) -> None:
    droppers = result.droppers
    upper = np.array(droppers.upper_wire) == "messenger wire"
    for span in (1, 2):
        low, high = (own & (droppers.span == span) for own in (~upper, upper))
        for own, force, length in ((low, expected[0], expected[2]), (high, expected[1], expected[3])):
            np.testing.assert_allclose(droppers.on_contact[own, 2], force, rtol=0.0, atol=0.01)
            np.testing.assert_allclose(droppers.length[own], length, rtol=0.0, atol=20e-6)


def test_a_compound_line_is_three_strings_one_below_the_other(
    make: Make, find: Find, strings: Change, hung: Hung
) -> None:
    """What is left are rounded kinks, which lift both upper wires by some 10 um, see `test_heights`."""
    result = find(make(2, strings, COMPOUND, FINER))
    check_compound(result, compound(hung, 6.15))
    with pytest.raises(AssertionError):
        check_compound(result, compound(hung, 6.1501))


# --- two contact wires ----------------------------------------------------------------------------------


def two(droppers: str) -> Change:
    return {"second_contact_wire": {"spacing": 0.04, "droppers": droppers}}


def check_alone(both: FormResult, alone: FormResult, wire: str) -> None:
    """Each wire weighs what it would weigh alone; its 20 mm to the side incline a dropper by 2e-2.

    Its pull to the side is 2 N at most; of heights it changes nothing.
    """
    own = np.array(both.droppers.lower_wire) == wire
    np.testing.assert_allclose(both.droppers.x[own], alone.droppers.x)
    np.testing.assert_allclose(
        both.droppers.on_contact[own, 2], alone.droppers.on_contact[:, 2], rtol=0.0, atol=1e-3
    )


def test_each_of_two_contact_wires_hangs_as_if_alone(make: Make, find: Find, strings: Change) -> None:
    odd, even = ({"spans.*.droppers.positions": x} for x in ([5.0, 30.0, 55.0], [17.5, 42.5]))
    result = find(make(2, strings, two("alternate")))
    check_alone(result, find(make(2, strings, odd)), "contact wire")
    check_alone(result, find(make(2, strings, even)), "second contact wire")
    with pytest.raises(AssertionError):
        check_alone(result, find(make(2, strings, odd)), "second contact wire")
    every = find(make(2, strings, two("both")))
    for wire in ("contact wire", "second contact wire"):
        check_alone(every, find(make(2, strings)), wire)
    tables = result.supports
    np.testing.assert_allclose(tables.stagger[np.array(tables.wire) == "contact wire"], 0.02)
    np.testing.assert_allclose(tables.stagger[np.array(tables.wire) == "second contact wire"], -0.02)


# --- mid-point anchor -----------------------------------------------------------------------------------

MID_POINT: Change = {
    "supports.1.name": "middle",
    "mid_point": {
        "support": "middle",
        "conductor": "messenger",
        "tension": 2e3,
        "reach": 14.0,
        "clearance": 1.0,
    },
}


def check_anchor(result: FormResult, weight: float) -> None:
    ties = result.ties
    assert ties.host == ("messenger wire", "contact wire", "contact wire", "messenger wire")
    np.testing.assert_allclose(ties.chainage, [46.0, 59.0, 61.0, 74.0], atol=1e-9)
    for number in (0, 1):
        first, second = ties.force[2 * number : 2 * number + 2]
        anchor = result.wire(f"mid-point anchor {number + 1}")
        np.testing.assert_allclose(
            first + second, [0.0, 0.0, -weight * anchor.unstressed_length], rtol=0.0, atol=1e-6
        )
        assert np.linalg.norm(second) == pytest.approx(2e3, rel=1e-6)
    w = taut_weight("contact", 15e3)
    before = force_in(result, "contact wire", 57.0, 59.0, w)
    behind = force_in(result, "contact wire", 59.5, 59.0, w)
    np.testing.assert_allclose(behind - before + ties.force[1, [0, 2]], 0.0, atol=0.05)


def test_a_mid_point_anchor_is_in_balance_with_its_wires(make: Make, find: Find, strings: Change) -> None:
    result = find(make(2, strings, MID_POINT))
    weight = RHO["messenger"] * GRAVITY
    check_anchor(result, weight)
    with pytest.raises(AssertionError):
        check_anchor(result, 1.00001 * weight)


# --- wear, devices, pulls, friction, anchors ------------------------------------------------------------


def check_worn(result: FormResult, wear: float) -> None:
    left = 1.0 - wear
    carried = 12.5 * taut_weight("contact", 15e3, left)
    np.testing.assert_allclose(result.droppers.on_contact[[1, 2, 3], 2], carried, rtol=0.0, atol=1e-3)
    wire = result.wire("contact wire")
    stretched = float(stretch(15e3, left * EA["contact"]))
    assert wire.stretched_length / wire.unstressed_length == pytest.approx(stretched, abs=1e-7)


def test_a_worn_wire_weighs_less_and_stretches_more(make: Make, find: Find, strings: Change) -> None:
    result = find(make(2, strings, {"contact_wire.wear": 0.2}))
    check_worn(result, 0.2)
    with pytest.raises(AssertionError):
        check_worn(result, 0.2001)


def check_same(a: FormResult, b: FormResult) -> None:
    np.testing.assert_allclose(a.droppers.length, b.droppers.length, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(a.droppers.force_bottom, b.droppers.force_bottom, rtol=0.0, atol=1e-4)


def test_a_device_with_losses_pulls_as_much_as_gets_through(make: Make, find: Find) -> None:
    device = {"messenger_wire.tension.device": {"kind": "weight", "efficiency": 0.97}}
    lossy = find(make(2, device))
    assert lossy.wire("messenger wire").tension == pytest.approx(0.97 * 12e3, abs=1e-6)
    check_same(lossy, find(make(2, {"messenger_wire.tension.force": 0.97 * 12e3})))
    with pytest.raises(AssertionError):
        check_same(lossy, find(make(2)))


@pytest.mark.parametrize("pulled", ["start", "end"])
def test_pulled_at_one_end_the_form_is_the_same(make: Make, find: Find, pulled: str) -> None:
    """Without friction it does not matter where the length comes from.

    Nodes stand elsewhere, by fractions of a millimetre.
    """
    change = {"contact_wire.tension.pulled": pulled, "messenger_wire.tension.pulled": pulled}
    check_same(find(make(2, change)), find(make(2)))


def losses(result: FormResult, friction: float) -> tuple[float, np.ndarray]:
    """Return by how much the messenger's tension grows from its start to its end, and f |F| at supports."""
    supports = result.supports
    own = np.array(supports.wire) == "messenger wire"
    force = np.column_stack((supports.force_x, supports.force_y, supports.force_z))[own]
    start, end = np.linalg.norm(result.wire("messenger wire").end_force, axis=1)
    return float(end - start), friction * np.linalg.norm(force, axis=1)


def test_friction_takes_tension_from_the_pulled_end_on(make: Make, find: Find, strings: Change) -> None:
    """Without friction nothing is lost."""
    friction = {"supports.*.messenger_wire.friction": 0.05} | FINER
    for pulled, sense in (("end", 1.0), ("start", -1.0)):
        at = {"messenger_wire.tension.pulled": pulled, "messenger_wire.tension.at": pulled}
        grown, lost = losses(find(make(3, strings, friction, at)), 0.05)
        assert lost.min() > 15.0
        assert grown == pytest.approx(sense * lost.sum(), abs=0.05)
        assert grown != pytest.approx(sense * lost[1:].sum(), abs=0.05)
    grown, lost = losses(find(make(3, strings, FINER)), 0.0)
    assert grown == pytest.approx(0.0, abs=0.05)


def test_between_two_pulled_ends_friction_takes_from_both(make: Make, find: Find, strings: Change) -> None:
    """From both ends towards the middle: what is lost up to there is gained again."""
    friction = {"supports.*.messenger_wire.friction": 0.05} | FINER
    result = find(make(4, strings, friction))
    grown, lost = losses(result, 0.05)
    assert grown == pytest.approx(0.0, abs=0.05)
    shape = result.wire("messenger wire").profile
    slope = np.interp(90.0, shape.x, np.gradient(shape.z, shape.x))
    H = float(np.interp(90.0, shape.x, shape.horizontal))
    tail = find(make(4, strings, FINER)).wire("messenger wire").profile
    free = float(np.interp(90.0, tail.x, tail.horizontal))
    assert abs(slope) < 0.05
    assert free - H == pytest.approx(lost[:2].sum(), rel=5e-3)


def test_wires_end_at_their_anchors(make: Make, find: Find) -> None:
    """Device and wire meet there but for the micrometre that Newton's method pulls beyond the guess.

    The wire leaves its last support along the chord of its tail, but for its own weight and stiffness.
    """
    anchor = {"distance": 8.0, "height": 4.9, "stagger": 0.6}
    result = find(make(2, {"contact_wire.anchor_end": anchor}))
    shape, force = result.wire("contact wire").profile, result.wire("contact wire").end_force[1]
    end = np.array([shape.x[-1], shape.y[-1], shape.z[-1]])
    np.testing.assert_allclose(end, [128.0, 0.6, 4.9], rtol=0.0, atol=2e-6)
    tail = np.array([8.0, 0.6, -0.4])
    expected = -15e3 * tail / np.linalg.norm(tail) - [0.0, 0.0, 0.5 * 8.0 * taut_weight("contact", 15e3)]
    np.testing.assert_allclose(force, expected, rtol=0.0, atol=10.0)
    level = find(make(2)).wire("contact wire").end_force[1]
    assert np.abs(level - expected).max() > 500.0
