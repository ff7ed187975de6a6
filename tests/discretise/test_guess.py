"""The first guess lies near the equilibrium, and nearer than the straight wire."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.guess import guess_equilibrium
from catenaria.discretise.restart import start_from
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.discretise.wire_setup import WireSetup
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
Pair = tuple[WireModel, FloatArray]

HEIGHTS = (0.0, -0.01, -0.016, -0.02, -0.016, -0.01, 0.0)
PARABOLA = {
    "length": 65.0,
    "droppers": {"positions": (4, 13.5, 23, 32.5, 42, 51.5, 61)},
    "contact_wire_height": HEIGHTS,
}
CHANGES: dict[str, dict[str, Any]] = {
    "example": {},
    "pre-sag": {"spans": (PARABOLA,) * 3},
    "elsewhere": {"start_chainage": 1000.0},
    "frictionless": {"dropper.joint": "frictionless"},
}


@pytest.fixture(params=CHANGES.values(), ids=list(CHANGES))
def pairs(request: pytest.FixtureRequest, variant: Callable[..., Line]) -> tuple[Pair, Pair]:
    """Models of both steps with their solutions."""
    line = variant(request.param)
    form: FormResult = solve(line)
    droppers = form.droppers
    setups = (
        contact_wire_setup(line),
        messenger_wire_setup(line, droppers.force_bottom, droppers.height),
    )
    models = [build_wire_model(setup) for setup in setups]
    solved = [
        start_from(m, stage).system.unknowns.start for m, stage in zip(models, form.stages, strict=True)
    ]
    return (models[0], solved[0]), (models[1], solved[1])


def check_near(model: WireModel, guess: FloatArray, solved: FloatArray) -> None:
    """What is neglected: layers in layers, and the slope's fourth power."""
    off = guess - solved
    assert np.abs(off[model.wire.nodes[:, 1:3]]).max() < 5e-4
    assert np.abs(off[model.wire.nodes[:, 3:]]).max() < 1.5e-3
    for along in (model.wire.nodes[:, 0], model.support_s, model.pull):
        assert np.abs(off[along]).max() < 1e-4
    assert np.abs(off[model.clamp_s]).max() < 4e-4
    assert np.abs(off[model.droppers.travel]).max() < 5e-4
    assert np.abs(off[model.droppers.clamp_force[:, 2]]).max() < 0.2
    assert np.abs(off[model.droppers.free_force[:, 2]]).max() < 3.0  # a cable's own weight is 1.3 N
    assert np.abs(off[model.support_force]).max() < 5.0
    assert np.abs(off[model.end_force]).max() < 8.0


def test_guess_is_near_the_solution(pairs: tuple[Pair, Pair]) -> None:
    for model, solved in pairs:
        check_near(model, guess_equilibrium(model), solved)


def described(model: WireModel, setup: WireSetup) -> WireModel:
    """Return the model with the numbers of another setup, on its own mesh."""
    return replace(model, setup=setup, tensioned=TensionedWire.of(setup))


def test_guess_of_another_tension_or_load_is_not_near(pairs: tuple[Pair, Pair]) -> None:
    for model, solved in pairs:
        setup = model.setup
        tension = replace(setup, tension=replace(setup.tension, force=1.2 * setup.tension.force))
        with pytest.raises(AssertionError):
            check_near(model, guess_equilibrium(described(model, tension)), solved)
        target = setup.droppers.target + (0.02 if setup.droppers.up else 5.0)
        other = replace(setup, droppers=replace(setup.droppers, target=target))
        with pytest.raises(AssertionError):
            check_near(model, guess_equilibrium(described(model, other)), solved)
        with pytest.raises(AssertionError):
            check_near(model, model.system.unknowns.start, solved)


def test_guess_leaves_the_model_as_it_is(contact: WireModel) -> None:
    before = contact.system.unknowns.start.copy()
    guess_equilibrium(contact)
    np.testing.assert_array_equal(contact.system.unknowns.start, before)


def check_weight(model: WireModel, weight: float) -> None:
    """The vertical forces of supports, droppers and ends carry the wire between the ends."""
    z = guess_equilibrium(model)
    held = (
        z[model.droppers.clamp_force[:, 2]].sum()
        + z[model.support_force[:, 2]].sum()
        + z[model.end_force[:, 2]].sum()
    )
    assert -held == pytest.approx(weight, rel=1e-3)


def test_guess_weighs_what_hangs(contact: WireModel) -> None:
    weight = contact.setup.section.rhoA * contact.setup.g * 196.2
    check_weight(contact, weight)
    with pytest.raises(AssertionError):
        check_weight(contact, 1.005 * weight)
