"""A wire whose droppers are forces has the same equilibrium as one with dropper cables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.guess import guess_equilibrium
from catenaria.discretise.wire_alone import build_wire_alone
from catenaria.discretise.wire_model import build_wire_model
from catenaria.discretise.wire_setup import WireSetup
from catenaria.formfinding.static_problem import find_rest, statics
from catenaria.line import Line
from catenaria.mechanics.loads.gravity import Ramp

FloatArray = NDArray[np.float64]


@pytest.fixture(params=["contact", "messenger"])
def setup(request: pytest.FixtureRequest, line: Line) -> WireSetup:
    if request.param == "contact":
        return contact_wire_setup(line)
    force, height = 80.0 + np.arange(21.0), -0.001 * np.arange(21.0)
    return messenger_wire_setup(line, force, height)


def alone(setup: WireSetup) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return heights at the droppers, forces of the wire on them, and unknowns of the wire's nodes."""
    model = build_wire_alone(setup)
    z = model.guess()
    z = find_rest(model.system.relocate(z) or model.system, z).y
    clamps = model.hung.wire.evaluate(z, z[model.hung.clamp_s]).r
    return clamps[:, 2], z[model.clamp_force], z[model.hung.wire.nodes]


def with_cables(setup: WireSetup) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the same of the model with dropper cables."""
    model = build_wire_model(replace(setup, gravity_ramp=Ramp(0.0)))
    z = guess_equilibrium(model)
    z = find_rest(statics(model.system, z), z).y
    return z[model.droppers.inner[:, 2]], z[model.droppers.clamp_force[:, 2]], z[model.wire.nodes]


def check_equal(setup: WireSetup, other: WireSetup) -> None:
    for ours, theirs, tolerance in zip(alone(setup), with_cables(other), (1e-9, 1e-6, 1e-9), strict=True):
        np.testing.assert_allclose(ours, theirs, atol=tolerance)


def test_forces_in_place_of_cables_change_nothing(setup: WireSetup) -> None:
    check_equal(setup, setup)


@pytest.mark.parametrize("change", [{"clamps_mass": 0.1}, {"target": 0.001}])
def test_another_weight_or_target_is_noticed(line: Line, change: dict[str, Any]) -> None:
    setup = messenger_wire_setup(line, np.full(21, 80.0), np.zeros(21))
    changed = {name: getattr(setup.droppers, name) + value for name, value in change.items()}
    with pytest.raises(AssertionError):
        check_equal(setup, replace(setup, droppers=replace(setup.droppers, **changed)))


def test_length_of_the_cables_does_not_matter(setup: WireSetup) -> None:
    check_equal(setup, replace(setup, droppers=replace(setup.droppers, length=0.7)))


def test_guess_is_near(line: Line) -> None:
    model = build_wire_alone(contact_wire_setup(line))
    z = model.guess()
    root = find_rest(model.system.relocate(z) or model.system, z)
    assert np.abs(root.y - z)[model.hung.wire.nodes].max() < 1.5e-3
    assert root.corrections.size <= 3


def test_line_change_is_seen(variant: Callable[..., Line]) -> None:
    """A heavier contact wire pulls more at the droppers."""
    light = alone(contact_wire_setup(variant({})))[1]
    heavy = alone(contact_wire_setup(variant({"gravity": 10.8})))[1]
    assert np.all(heavy < light)
