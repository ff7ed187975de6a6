"""From the line file to the numbers of each step: which value goes where."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup, section
from catenaria.discretise.wire_setup import WireSetup
from catenaria.line import Line

Vary = Callable[[dict[str, Any]], Line]

DISTINCT: dict[str, Any] = {
    "gravity": 9.81,
    "start_chainage": 100.0,
    "contact_wire.tension.force": 20e3,
    "contact_wire.tension.at": "start",
    "contact_wire.tail": 0.7,
    "messenger_wire.tension.measure": "strain",
    "messenger_wire.tail": 0.9,
    "dropper.clamp_mass_top": 0.2,
    "dropper.clamp_mass_bottom": 0.15,
    "dropper.elements": 3,
    "dropper.guessed_length": 1.1,
    "solver.mesh.refine": 2,
    "solver.mesh.gauss_points": 4,
    "solver.dynamic.damping.mass": 0.03,
    "solver.dynamic.damping.stiffness": 0.004,
}


@pytest.fixture
def described(variant: Vary) -> Line:
    """A line in which no two values that could be taken for one another are equal."""
    return variant(DISTINCT)


@pytest.fixture
def setups(described: Line) -> tuple[WireSetup, WireSetup]:
    force, height = np.linspace(50.0, 90.0, 21), np.linspace(0.0, 0.02, 21)
    return contact_wire_setup(described), messenger_wire_setup(described, force, height)


def test_wires_and_their_supports(setups: tuple[WireSetup, WireSetup]) -> None:
    contact, messenger = setups
    assert (contact.name, messenger.name) == ("contact wire", "messenger wire")
    np.testing.assert_allclose(contact.support_x, [100.0, 295.0])
    np.testing.assert_allclose(messenger.support_x, [100.0, 165.0, 230.0, 295.0])
    assert (contact.height, messenger.height) == (0.0, 1.5)
    assert (contact.tail, messenger.tail) == (0.7, 0.9)
    assert (contact.g, messenger.g) == (9.81, 9.81)


def test_sections_are_products(setups: tuple[WireSetup, WireSetup], described: Line) -> None:
    contact, messenger = setups
    assert pytest.approx(130e9 * 120e-6) == contact.section.EA
    assert (contact.section.EJ, messenger.section.EJ) == (400.0, 311.0)
    assert messenger.section.rhoA == pytest.approx(4020.0 * 153e-6)
    assert contact.droppers.section == messenger.droppers.section == section(described.conductors["dropper"])
    assert pytest.approx(119e9 * 10e-6) == contact.droppers.section.EA


def test_tensions_and_laws(setups: tuple[WireSetup, WireSetup]) -> None:
    contact, messenger = (setup.tension for setup in setups)
    assert (contact.force, contact.measure, contact.at_end) == (20e3, "reaction", False)
    assert (messenger.force, messenger.measure, messenger.at_end) == (15e3, "strain", True)
    assert (contact.law.v_s, contact.law.e0, contact.law.e1) == (0.2e-3, 5.0, 100.0)
    assert (messenger.law.v_s, messenger.law.e0, messenger.law.e1) == (0.4e-3, 20.0, 500.0)
    heights, forces = (setup.droppers.law for setup in setups)
    assert (heights.v_s, heights.e0, heights.e1) == pytest.approx((0.2e-3, 1e-5, 1e-3))
    assert (forces.v_s, forces.e0, forces.e1) == (1.0, 0.02, 20.0)


def test_lower_and_upper_droppers(setups: tuple[WireSetup, WireSetup]) -> None:
    lower, upper = (setup.droppers for setup in setups)
    assert (lower.up, upper.up) == (True, False)
    assert (lower.clamp_mass, upper.clamp_mass) == (0.15, 0.2)
    np.testing.assert_array_equal(lower.target, np.zeros(21))
    np.testing.assert_array_equal(upper.target, np.linspace(50.0, 90.0, 21))
    np.testing.assert_array_equal(upper.foot_height, np.linspace(0.0, 0.02, 21))
    for droppers in (lower, upper):
        assert droppers.x[[0, 6, 7, 20]] == pytest.approx([104.0, 161.0, 169.0, 291.0])
        assert (droppers.length, droppers.elements, droppers.guided) == (1.1, 3, True)


def test_mesh_ramps_and_damping(setups: tuple[WireSetup, WireSetup]) -> None:
    for setup in setups:
        assert (setup.grading.fine, setup.grading.largest, setup.grading.refine) == ((0.1, 0.3), 2.4, 2)
        assert setup.gauss_points == 4
        assert (setup.gravity_ramp.duration, setup.control_ramp.duration) == (5.0, 5.0)
        assert setup.damping == (0.03, 0.004)


def test_heights_go_to_their_droppers(variant: Vary) -> None:
    heights = (0.001, 0.002, 0.003)
    span = {"length": 65.0, "droppers": {"positions": (10, 30, 60)}, "contact_wire_height": heights}
    level = {"length": 65.0, "droppers": {"first": 20, "spacing": 20, "count": 2}, "contact_wire_height": 0}
    setup = contact_wire_setup(variant({"spans": (span, level, span)}))
    np.testing.assert_array_equal(setup.droppers.target, [*heights, 0.0, 0.0, *heights])
    np.testing.assert_allclose(setup.droppers.x, [10, 30, 60, 85, 105, 140, 160, 190])


def test_the_contact_wire_is_held_where_the_line_says(variant: Vary) -> None:
    held = {"contact_wire": {"height": 5.3}, "messenger_wire": {"encumbrance": 1.4}}
    free = {"messenger_wire": {"height": 6.7}}
    span = variant({}).model_dump()["spans"][0] | {"contact_wire_height": 5.3}
    line = variant({"supports": (held, free, held, held), "spans": (span,) * 3})
    setup = contact_wire_setup(line)
    np.testing.assert_allclose(setup.support_x, [0.0, 130.0, 195.0])
    assert setup.height == 5.3
    messenger = messenger_wire_setup(line, np.zeros(21), np.zeros(21))
    assert messenger.height == pytest.approx(6.7)
    assert messenger.support_x.size == 4


def test_frictionless_droppers(variant: Vary, line: Line) -> None:
    assert contact_wire_setup(line).droppers.guided
    assert not contact_wire_setup(variant({"dropper.joint": "frictionless"})).droppers.guided
