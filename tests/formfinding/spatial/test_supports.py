"""Supports that give way, swing or clamp, and masses on wires: against springs, beams and strings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.formfinding.spatial.rebuild import rebuild_in_space
from catenaria.line import Line
from catenaria.results import FormResult

Change = dict[str, Any]
Make = Callable[..., Line]
Find = Callable[[Line], FormResult]
Hung = Callable[..., tuple[np.ndarray, np.ndarray]]

GRAVITY = 9.80665
MIDDLE = "supports.1.messenger_wire"


def held(result: FormResult, wire: str = "messenger wire") -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return staggers, heights and forces (lateral, up) of a wire at its supports."""
    table = result.supports
    own = np.array(table.wire) == wire
    force = np.column_stack((table.force_lateral, table.force_z))
    return table.stagger[own], table.height[own], force[own]


def check_spring(result: FormResult, vertical: float, lateral: float) -> None:
    stagger, height, force = held(result)
    assert height[1] - 6.7 == pytest.approx(force[1, 1] / vertical, abs=1e-10)
    assert stagger[1] + 0.3 == pytest.approx(force[1, 0] / lateral, abs=1e-10)


def test_a_spring_gives_way_by_force_over_stiffness(make: Make, find: Find) -> None:
    spring = {"kind": "spring", "stiffness": 50e3, "lateral_stiffness": 20e3}
    stagger = {f"supports.{i}.stagger": b for i, b in enumerate((0.3, -0.3, 0.3))}
    change = {f"{MIDDLE}.{name}": value for name, value in spring.items()} | stagger
    result = find(make(2, change))
    assert held(result)[1][1] < 6.7 - 0.01
    assert held(result)[0][1] > -0.3 + 0.01
    check_spring(result, 50e3, 20e3)
    with pytest.raises(AssertionError):
        check_spring(result, 50.01e3, 20e3)
    rigid = find(make(2, change | {f"{MIDDLE}.lateral_stiffness": None}))
    assert held(rigid)[0][1] == pytest.approx(-0.3, abs=1e-12)


def carried(result: FormResult, hung: Hung, sunk: float) -> float:
    """Return what a string carries to a middle support that has sunk [N], with the found dropper forces."""
    droppers, x = result.droppers, np.array([0.0, 60.0, 120.0])
    at = np.sort(np.concatenate((x, droppers.x)))
    load = np.zeros(at.size)
    load[np.searchsorted(at, droppers.x)] = -droppers.on_messenger[:, 2]
    fixed = dict(zip(np.searchsorted(at, x).tolist(), (6.7, 6.7 - sunk, 6.7), strict=True))
    H = float(np.interp(30.0, result.wires[-1].profile.x, result.wires[-1].profile.horizontal))
    w = 0.596 * GRAVITY / (1.0 + 12e3 / (113e9 * 65.8e-6))
    return float(hung(at, w, H, fixed, load)[1][at.size // 2])


def test_a_sunk_support_carries_what_a_string_there_does(
    make: Make, find: Find, strings: Change, hung: Hung
) -> None:
    """Slopes of 0.05 make the wire 1e-3 heavier per length in plan, 0.5 N of 700 N."""
    result = find(make(2, strings, {f"{MIDDLE}.kind": "spring", f"{MIDDLE}.stiffness": 20e3}))
    _, height, force = held(result)
    sunk = 6.7 - height[1]
    assert sunk > 0.03
    assert -force[1, 1] == pytest.approx(carried(result, hung, sunk), abs=0.5)
    assert -force[1, 1] != pytest.approx(carried(result, hung, sunk - 2e-3), abs=0.5)


CANTILEVER: Change = {
    "length": 2.0,
    "side": "left",
    "youngs_modulus": 200e9,
    "area": 1e-3,
    "mass_per_length": 7.85,
    "bending_stiffness": 2e5,
    "elements": 8,
}


def check_cantilever(result: FormResult, EJ: float) -> None:
    """Deflection by the wire's force F L^3/(3 EJ) and the beam's weight w L^4/(8 EJ).

    The tip moves 0.6 of the deflection squared over L, or 50 um, to the root: the wire pulls it back.
    """
    L, w = 2.0, 7.85 * GRAVITY
    _, height, force = held(result)
    F = -force[1, 1]
    expected = F * L**3 / (3.0 * EJ) + w * L**4 / (8.0 * EJ)
    assert 6.7 - height[1] == pytest.approx(expected, rel=1e-4)
    beams = result.cantilevers
    np.testing.assert_allclose(beams.root, [[60.0, L, 6.7]], rtol=0.0, atol=1e-9)
    assert beams.force[0, 2] == pytest.approx(-F - w * L, abs=1e-6)
    np.testing.assert_allclose(beams.force[0, :2], 0.0, atol=0.05)


def test_a_cantilever_bends_like_a_beam(make: Make, find: Find) -> None:
    result = find(make(2, {f"{MIDDLE}.kind": "cantilever", f"{MIDDLE}.cantilever": CANTILEVER}))
    check_cantilever(result, 2e5)
    with pytest.raises(AssertionError):
        check_cantilever(result, 2.001e5)


def test_a_pulled_cantilever_is_stiffer(make: Make, find: Find) -> None:
    """A tension S in the beam leaves 3 (u - tanh u)/u^3 of the deflection, u^2 = S L^2/EJ: 0.6 % here."""
    stagger = {f"supports.{i}.stagger": b for i, b in enumerate((0.3, -0.3, 0.3))}
    beam = CANTILEVER | {"mass_per_length": 5e-3}  # which is the least: 3e-5 of the load
    result = find(make(2, {f"{MIDDLE}.kind": "cantilever", f"{MIDDLE}.cantilever": beam}, stagger))
    _, height, force = held(result)
    side = -force[1, 0]  # the root is to the left: a pull to the right is tension
    assert abs(side) > 200.0
    u = np.sqrt(complex(side * 4.0 / 2e5))
    deflection = -force[1, 1] * 8.0 / (3.0 * 2e5) * float((3.0 * (u - np.tanh(u)) / u**3).real)
    assert 6.7 - height[1] == pytest.approx(deflection, rel=2e-4)
    assert 6.7 - height[1] != pytest.approx(-force[1, 1] * 8.0 / (3.0 * 2e5), rel=1e-3)


def differ(a: FormResult, b: FormResult) -> float:
    return float(np.abs(a.droppers.length - b.droppers.length).max())


def test_brackets_and_rollers_are_the_same_where_both_sides_are(make: Make, find: Find) -> None:
    """A bracket keeps the tension's component along the track, a roller the tension.

    The difference is that of the slopes on both sides. Between equal spans there is none, but that the tails
    of 3 m hang less than spans do: brackets only in the middle.
    """
    bracket = {f"{MIDDLE}.kind": "bracket"}
    assert differ(find(make(2, bracket)), find(make(2))) < 1e-6
    high = {f"{MIDDLE}.height": 7.2, "spans.1.length": 62.0}
    assert differ(find(make(2, bracket, high)), find(make(2, high))) > 1e-5


def test_clamps_are_found_like_rollers(make: Make, find: Find) -> None:
    clamped, rolling = (find(make(3, {"supports.1.messenger_wire.kind": k})) for k in ("clamped", "sliding"))
    assert differ(clamped, rolling) == 0.0
    assert clamped.supports.kind[5] == "clamped"


def shortened(line: Line, result: FormResult) -> float:
    """Return by how much the tension at the messenger's end changes if a dropper of span 1 is shorter [N]."""
    length = result.droppers.unstressed_length.copy()
    length[2] -= 0.02
    changed = replace(result, droppers=replace(result.droppers, unstressed_length=length))
    return float(rebuild_in_space(line, changed).tension.change[-1])


def test_a_clamp_keeps_tension_from_the_next_span(make: Make, find: Find) -> None:
    """What is left with a clamp comes through the contact wire."""
    change = {}
    for kind in ("clamped", "sliding"):
        line = make(2, {f"{MIDDLE}.kind": kind})
        change[kind] = shortened(line, find(line))
    assert abs(change["sliding"]) > 1.0
    assert abs(change["clamped"]) < 0.01 * abs(change["sliding"])


MASS = 6.0
WEIGHT = MASS * GRAVITY


def hung_on(wire: str, at: float) -> Change:
    return {"point_masses": [{"name": "insulator", "wire": wire, "chainage": at, "mass": MASS}]}


def check_lever(result: FormResult, without: FormResult, weight: float) -> None:
    """Droppers at 17.5 and 30 m carry the mass at 21.5 m between them."""
    more = result.droppers.on_contact[:, 2] - without.droppers.on_contact[:, 2]
    share = np.zeros(more.size)
    share[1:3] = 8.5 / 12.5, 4.0 / 12.5
    np.testing.assert_allclose(more, share * weight, rtol=0.0, atol=5e-3)


def test_droppers_carry_a_mass_by_the_law_of_the_lever(make: Make, find: Find, strings: Change) -> None:
    result, without = (find(make(2, strings, more)) for more in (hung_on("contact wire", 21.5), {}))
    assert result.masses.name == ("insulator",)
    check_lever(result, without, WEIGHT)
    with pytest.raises(AssertionError):
        check_lever(result, without, 1.001 * WEIGHT)


def test_a_mass_kinks_the_messenger(make: Make, find: Find, strings: Change) -> None:
    """The slope jumps by m g/H; between it and where it is read there is the weight of the wire."""
    result = find(make(2, strings, hung_on("messenger wire", 23.0)))
    shape = result.wire("messenger wire").profile
    before, behind = np.interp([21.0, 25.0], shape.x, np.gradient(shape.z, shape.x))
    H = float(np.interp(23.0, shape.x, shape.horizontal))
    w = 0.596 * GRAVITY / (1.0 + 12e3 / (113e9 * 65.8e-6))
    assert H * (behind - before) - 4.0 * w == pytest.approx(WEIGHT, abs=0.05)
    assert H * (behind - before) != pytest.approx(WEIGHT, abs=0.05)
