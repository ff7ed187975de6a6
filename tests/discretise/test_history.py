"""The course of a motion: errors of the controls, parameters, tensions and energies of given states."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.guess import guess_equilibrium
from catenaria.discretise.history import control_errors, control_names, control_units, history
from catenaria.discretise.wire_model import WireModel
from catenaria.formfinding.controlled_motion import tolerances
from catenaria.formfinding.motion_problem import MotionProblem
from catenaria.results import History
from catenaria.solvers.outcome import NO_WORK, Solution, Status

FloatArray = NDArray[np.float64]

NAMES = ("first", "last")
STRETCH = 1.001


def states(model: WireModel) -> tuple[FloatArray, FloatArray]:
    """Return unknowns and rates: laid out at rest, stretched and flying, near equilibrium."""
    start = model.system.unknowns.start
    stretched, flying = start.copy(), np.zeros_like(start)
    stretched[model.wire.nodes[:, 0]] *= STRETCH
    stretched[model.wire.nodes[:, 3]] *= STRETCH
    stretched[model.end_force] = [[3.0, 0.0, 4.0], [-5.0, 0.0, 12.0]]
    for chain in (model.wire, *model.droppers.chains):
        flying[chain.nodes[:, 2]] = 0.7
    flying[model.pull] = 0.01
    return np.array([start, stretched, guess_equilibrium(model)]), np.array([0 * start, flying, 0 * start])


def recorded(model: WireModel) -> tuple[History, Solution]:
    y, yd = states(model)
    problem = MotionProblem(model.system, tolerances(model, 1e-4))
    t, h, order = np.array([0.0, 2.5, 6.0]), np.array([0.0, 2.5, 3.5]), np.array([0, 1, 2])
    solution = Solution(t, y, yd, h, order, NO_WORK, Status.END_REACHED, "the end", problem)
    names = NAMES if model.setup.droppers.up else tuple("abcd")
    return history(model, solution, names), solution


@pytest.fixture(params=["contact", "messenger"])
def model(request: pytest.FixtureRequest) -> WireModel:
    return request.getfixturevalue(request.param)


def test_times_and_names(model: WireModel) -> None:
    course, solution = recorded(model)
    np.testing.assert_array_equal(course.time, solution.t)
    np.testing.assert_array_equal(course.step_size, solution.h)
    np.testing.assert_array_equal(course.order, solution.order)
    assert course.step == model.setup.name
    assert course.control_name == control_names(model)
    assert course.control_unit == control_units(model)
    assert len(course.control_name) == len(course.control_unit) == course.error.shape[1] == 22
    assert course.joint_tension.shape == (3, model.support_s.size)


def test_names_and_units_say_what_is_controlled(contact: WireModel, messenger: WireModel) -> None:
    assert control_names(contact)[:2] == ("contact wire tension", "height at dropper 1")
    assert control_names(messenger)[-1] == "force of dropper 21"
    assert set(control_units(messenger)) == {"N"}
    assert control_units(contact) == ("N",) + ("m",) * 21


def test_errors_are_those_of_the_controls(model: WireModel) -> None:
    course, solution = recorded(model)
    for row, t, z in zip(course.error, solution.t, solution.y, strict=True):
        system = model.system.relocate(z) or model.system
        expected = np.concatenate([control.error(t, z) for control in model.controls(system)])
        np.testing.assert_array_equal(row, expected)
        np.testing.assert_array_equal(control_errors(model.controls(model.system), t, z), expected)


def test_errors_of_known_states(contact: WireModel, messenger: WireModel) -> None:
    """Laid out, the wire lacks all its tension and has its heights; stretched, it reacts with 13 N."""
    course, _ = recorded(contact)
    np.testing.assert_allclose(course.error[0], [-15e3, *np.zeros(21)], atol=1e-12)
    assert course.error[1, 0] == pytest.approx(13.0 - 15e3)
    np.testing.assert_allclose(course.error[2], 0.0, atol=1e-6)
    course, _ = recorded(messenger)
    np.testing.assert_allclose(course.error[0], [-15e3, *np.zeros(21)], atol=1e-12)
    np.testing.assert_allclose(course.error[2, 1:], 0.0, atol=4.0)  # the guess leaves out G
    assert np.abs(course.error[1, 1:]).min() > 20.0  # half of T_cd is wanted at half of the ramp


def test_tensions_of_known_states(model: WireModel) -> None:
    course, _ = recorded(model)
    np.testing.assert_allclose(course.reaction[:2], [[0.0, 0.0], [5.0, 13.0]], atol=1e-12)
    N = 0.5 * model.wire.section.EA * (STRETCH**2 - 1.0)
    np.testing.assert_allclose(course.joint_tension[0], 0.0, atol=1e-4)
    np.testing.assert_allclose(course.joint_tension[1], N, rtol=1e-9)


def test_parameters_and_velocities(model: WireModel) -> None:
    course, solution = recorded(model)
    np.testing.assert_array_equal(course.parameter[0], 0.0)
    np.testing.assert_array_equal(course.velocity[1], [0.01, *np.zeros(21)])
    assert course.parameter[2, 0] == solution.y[2, model.pull[0]] > 0.05
    np.testing.assert_array_equal(course.parameter[2, 1:], solution.y[2, model.droppers.travel])


def check_energies(course: History, model: WireModel) -> None:
    """Check (7) and (8) in closed form: m v^2/2 of everything, EA eps^2 L/2 of the stretched wire."""
    wire, droppers = model.wire, model.setup.droppers
    mass = 196.0 * wire.section.rhoA + 21 * 1.5 * droppers.section.rhoA
    np.testing.assert_allclose(course.kinetic, [0.0, 0.5 * mass * 0.7**2, 0.0], rtol=1e-9)
    eps = 0.5 * (STRETCH**2 - 1.0)
    np.testing.assert_allclose(
        course.axial[:2], [0.0, 0.5 * wire.section.EA * eps**2 * 196.0], rtol=1e-9, atol=1e-9
    )
    np.testing.assert_allclose(course.bending[:2], 0.0, atol=1e-9)
    assert course.bending[2] > 0.01


def test_energies_of_known_states(model: WireModel) -> None:
    course, _ = recorded(model)
    check_energies(course, model)
    for name in ("kinetic", "axial", "bending"):
        with pytest.raises(AssertionError):
            check_energies(replace(course, **{name: 0.99 * getattr(course, name) + 0.001}), model)
