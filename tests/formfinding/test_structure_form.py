"""Forms of free structures against closed forms of beams, strings and pendulums."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest

from catenaria.errors import NotConvergedError, SingularError, UnsupportedError
from catenaria.formfinding.structure_form import find_structure
from catenaria.results.structure import StructureForm
from catenaria.structure import Structure

G = 9.8
GROUND = {"type": "spherical"}


def at(cable: str, point: str | float) -> dict[str, Any]:
    return {"cable": cable, "point": point}


def solve(description: dict[str, Any], method: Any = "direct") -> StructureForm:
    return find_structure(Structure.model_validate({"format": 1, "gravity": G, **description}), method)


def rod(support: str, EJ: float = 1e4) -> dict[str, Any]:
    """Return a level rod of 2 m and 1 kg/m, held at its start."""
    return {
        "sections": {"steel": {"EA": 1e7, "EJ": EJ, "rhoA": 1.0}},
        "cables": {"rod": {"section": "steel", "points": [[0, 0, 0], [2, 0, 0]], "elements": 8}},
        "joints": {"wall": {"type": support, "on": at("rod", "start")}},
    }


def test_cantilever() -> None:
    """A rod fixed to the ground sinks by w L^4/(8 EJ) at its end, and the ground bears its weight."""
    form = solve(rod("fixed"))
    tip = form.cable("rod").position[-1]
    np.testing.assert_allclose(tip[2], -G * 2.0**4 / 8e4, rtol=1e-5)
    np.testing.assert_allclose(form.force("wall"), [0.0, 0.0, -2.0 * G], atol=1e-6)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(
            solve(rod("fixed", EJ=1.01e4)).cable("rod").position[-1][2], tip[2], rtol=1e-5
        )


def test_a_hinged_rod_swings_down() -> None:
    """A rod that is only hinged has no stiffness at the start, and is found hanging."""
    form = solve(rod("spherical"))
    np.testing.assert_allclose(form.cable("rod").position[-1], [0.0, 0.0, -2.0], atol=1e-5)
    assert "steps from standstill" in form.stop_reason


def test_a_damped_pendulum_comes_to_rest_below() -> None:
    """Speeds vanish at every turning point; the run goes on until nothing is accelerated either."""
    form = solve(rod("spherical") | {"solver": {"damping": {"mass": 1.0}}}, "dynamic")
    (course,) = form.histories
    swinging = course.kinetic[course.time > 5.0][:-1]
    assert np.sum((swinging[1:-1] < swinging[:-2]) & (swinging[1:-1] < swinging[2:])) > 5  # turning points
    np.testing.assert_allclose(form.cable("rod").position[-1], [0.0, 0.0, -2.0], atol=1e-3)


@pytest.mark.parametrize(("joint", "same"), [("fixed", True), ("spherical", False)])
def test_two_rods_joined_are_one(joint: str, same: bool) -> None:
    """The fixed joint (16) makes one rod of two; a hinge does not."""
    whole = rod("fixed")
    parts = copy.deepcopy(whole)
    parts["cables"] = {
        "near": {"section": "steel", "points": [[0, 0, 0], [1, 0, 0]], "elements": 4},
        "far": {"section": "steel", "points": [[1, 0, 0], [2, 0, 0]], "elements": 4},
    }
    parts["joints"] = {
        "wall": {"type": "fixed", "on": at("near", "start")},
        "middle": {"type": joint, "on": at("near", "end"), "to": at("far", "start")},
    }
    tips = solve(whole).cable("rod").position[-1], solve(parts).cable("far").position[-1]
    assert bool(np.allclose(*tips, atol=1e-9)) == same


def string(**changes: Any) -> dict[str, Any]:
    """Return a weightless cable of 10 m, hinged at one end and pulled at the other."""
    cable = {"section": "wire", "points": [[0, 0, 0], [10, 0, 0]], "elements": 10, "weight": False}
    return {
        "sections": {"wire": {"EA": 1e6, "EJ": 1e-3, "rhoA": 1.0}},
        "cables": {"main": cable},
        "joints": {"left": GROUND | {"on": at("main", "start")}, "right": GROUND | {"on": at("main", "end")}},
        "tensions": {"T": {"joint": "right", "force": 1000.0, "move": {"right": [2, 0, 0]}}},
        **changes,
    }


def test_point_mass_on_a_string() -> None:
    """Vertical reactions m g/2, and the kink follows from them: sag = m g L/(4 H)."""
    description = string(masses={"m": {"on": at("main", 5.0), "mass": 4.0}})
    nodes = [2.0, 4.0, 4.8, 4.96, 5.0, 5.04, 5.2, 6.0, 8.0]
    description["cables"]["main"] |= {"elements": None, "nodes": nodes}
    form = solve(description)
    left, right = form.force("left"), form.force("right")
    np.testing.assert_allclose([left[2], right[2]], -2.0 * G, rtol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(right), 1000.0, rtol=1e-9)
    width = 10.0 + form.parameter("T")
    sag = -form.cable("main").position[5, 2]
    np.testing.assert_allclose(sag, 4.0 * G * width / (4.0 * left[0]), rtol=2e-3)


def test_both_ends_may_move() -> None:
    """Ends that move apart travel half as far each as one end alone; directions need not be unit vectors."""
    one = solve(string())
    move = {"left": [-1, 0, 0], "right": [1, 0, 0]}
    both = solve(string(tensions={"T": {"joint": "right", "force": 1000.0, "move": move}}))
    np.testing.assert_allclose(both.parameter("T"), 0.5 * one.parameter("T"), rtol=1e-9)
    np.testing.assert_allclose(one.parameter("T"), 10.0 * 1e-3, rtol=3e-3)
    np.testing.assert_allclose(both.position("left")[0], -both.parameter("T"), rtol=1e-12)


def test_slack_cable() -> None:
    """A cable that is longer than the distance of its ends hangs; stiff enough, as a chain."""
    description = string(tensions={})
    description["sections"]["wire"]["EA"] = 1e8
    description["cables"]["main"] |= {"unstressed_length": 11.0, "elements": 40, "weight": True}
    form = solve(description)
    half = 0.5 * 11.0 * G  # H = w a, V = w L/2, and sinh(u)/u = 11/10 with u = 10/(2 a)
    np.testing.assert_allclose(form.force("right")[2], -half, rtol=1e-6)
    a = -form.force("right")[0] / G
    np.testing.assert_allclose(2.0 * a * np.sinh(5.0 / a), 11.0, rtol=1e-5)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(2.0 * a * np.sinh(5.0 / a), 11.01, rtol=1e-5)


def hung(measure: str, joint: str) -> dict[str, Any]:
    """Return a cable that slides through a ring, with a hanger that holds its middle at a height."""
    description = string()
    description["cables"]["main"] |= {"points": [[0, 0, 0], [10.5, 0, 0]], "elements": 21, "weight": True}
    description["cables"]["hanger"] = {
        "section": "wire",
        "points": [[5, 0, 0], [5, 0, 1]],
        "elements": 2,
    }
    description["joints"] |= {
        "ring": {"type": "sliding", "on": at("main", 10.0)},
        "clamp": {"type": "guided", "on": at("main", 5.0), "to": at("hanger", "start")},
        "top": GROUND | {"on": at("hanger", "end")},
    }
    tension = {"joint": joint, "force": 1000.0, "measure": measure, "move": {"right": [1, 0, 0]}}
    description["tensions"] = {"T": tension}
    description["heights"] = {"h": {"joint": "clamp", "height": 0.02, "move": {"top": [0, 0, 1]}}}
    return description


def check_hung(form: StructureForm) -> None:
    """Force of the hanger: half of the weight of the cable on both sides, and 0.02 m of kink over 5 m."""
    np.testing.assert_allclose(form.position("clamp"), [5.0, 0.0, 0.02], atol=2e-5)
    np.testing.assert_allclose(-form.force("clamp")[2], 5.0 * G + 2.0 * 1000.0 * 0.02 / 5.0, rtol=1e-2)


def test_tension_and_height() -> None:
    form = solve(hung("reaction", "right"))
    check_hung(form)
    np.testing.assert_allclose(np.linalg.norm(form.force("right")), 1000.0, rtol=1e-9)
    with pytest.raises(AssertionError):
        check_hung(solve(hung("reaction", "right") | {"heights": {}}))


def test_strain_measure() -> None:
    form = solve(hung("strain", "ring"))
    place = form.joints.name.index("ring")
    np.testing.assert_allclose(form.joints.strain_tension[place], 1000.0, rtol=1e-9)
    assert abs(np.linalg.norm(form.force("right")) - 1000.0) > 0.1


def test_both_methods_agree() -> None:
    """The dynamic method ends within its dead bands of the direct one, and tells how it got there."""
    direct, dynamic = (solve(hung("reaction", "right"), method) for method in ("direct", "dynamic"))
    check_hung(dynamic)
    bands = dynamic.controls.dead_band
    assert np.all(np.abs(dynamic.controls.error) <= 1.11 * bands)
    np.testing.assert_allclose(dynamic.controls.parameter, direct.controls.parameter, atol=2e-4)
    (course,) = dynamic.histories
    assert course.value.shape == (course.time.size, 2)
    assert course.joint_force.shape == (course.time.size, 5, 3)
    np.testing.assert_array_equal(course.joint_position[-1], dynamic.joints.position)
    np.testing.assert_allclose(course.value[-1], dynamic.controls.value, rtol=1e-12)
    assert course.axial[0] < 1e-12 < course.axial[-1]
    assert not direct.histories


def test_the_listener_hears_every_step() -> None:
    heard: list[Any] = []
    structure = Structure.model_validate({"format": 1, "gravity": G, **hung("reaction", "right")})
    form = find_structure(structure, "dynamic", heard.append)
    assert [progress.step for progress in heard] == list(range(1, form.counters.steps + 1))
    assert {progress.worst_control for progress in heard} <= {"T", "h"}


def test_two_tensions_on_a_sliding_cable() -> None:
    """Square, and singular: the cable can slide."""
    description = hung("reaction", "right")
    description["cables"]["main"]["points"] = [[-0.5, 0, 0], [10.5, 0, 0]]
    description["joints"]["clamp"]["on"] = at("main", 5.5)
    description["joints"]["ring"]["on"] = at("main", 10.5)
    description["joints"]["first ring"] = {"type": "sliding", "on": at("main", 0.5)}
    assert solve(description).parameter("T") > 0.0
    description["tensions"]["T0"] = {"joint": "left", "force": 1000.0, "move": {"left": [-1, 0, 0]}}
    with pytest.raises(SingularError, match="T0"):
        solve(description)


def test_a_parameter_that_nothing_needs() -> None:
    """The height of a joint cannot be met by moving something that does not hold it."""
    description = hung("reaction", "right")
    description["cables"]["idle"] = {"section": "wire", "points": [[0, 5, 0], [0, 5, 1]], "elements": 2}
    description["joints"]["idle top"] = GROUND | {"on": at("idle", "end")}
    description["heights"]["h"]["move"] = {"idle top": [0, 0, 1]}
    with pytest.raises((SingularError, NotConvergedError)):
        solve(description)


def test_a_height_beyond_reach() -> None:
    """A cable of 10.5 m that is lifted by 3 m slides out of its ring, and the error says so."""
    description = hung("reaction", "right")
    description["heights"]["h"]["height"] = 0.5
    np.testing.assert_allclose(solve(description).position("clamp")[2], 0.5, rtol=1e-9)
    description["heights"]["h"]["height"] = 3.0
    with pytest.raises(NotConvergedError, match=r"no way from the start.*slid out of a joint"):
        solve(description)


def test_no_such_method() -> None:
    with pytest.raises(UnsupportedError, match="direct, dynamic"):
        solve(string(), "magic")
