"""The system of one step: its starting configuration, its unknowns and their numbering."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from operator import attrgetter
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup
from catenaria.discretise.guess import guess_equilibrium
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.formfinding.static_problem import find_rest, statics
from catenaria.line import Line
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.unknowns import Kind

FloatArray = NDArray[np.float64]
Vary = Callable[[dict[str, Any]], Line]


@pytest.fixture(params=["contact", "messenger"])
def model(request: pytest.FixtureRequest) -> WireModel:
    return request.getfixturevalue(request.param)


def residual(model: WireModel, z: FloatArray, t: float = 0.0) -> FloatArray:
    return model.system.residual(State.at_rest(z, t))


def constraints(model: WireModel) -> NDArray[np.bool_]:
    """Return which equations are constraints: those of multipliers, and where a guided clamp stands."""
    return model.system.unknowns.where(Kind.MULTIPLIER, Kind.SLIDING)


def test_the_start_is_at_rest(model: WireModel) -> None:
    """Straight, free of strain and without gravity: constraints are met and nothing pulls."""
    f, constraint = residual(model, model.system.unknowns.start), constraints(model)
    assert np.abs(f[constraint]).max() < 1e-12  # m
    assert np.abs(f[~constraint]).max() < 1e-4  # N: EA times the rounding of positions


@pytest.mark.parametrize("what", ["support_s", "clamp_s", "pull", "droppers.travel"])
def test_another_start_is_not(model: WireModel, what: str) -> None:
    """A joint that stands elsewhere on the wire, or an end that was moved, leaves its constraint open."""
    z = model.system.unknowns.start.copy()
    z[attrgetter(what)(model)[-1]] += 1e-4
    assert np.abs(residual(model, z)[constraints(model)]).max() == pytest.approx(1e-4, rel=1e-3)


def test_every_unknown_is_named_once(model: WireModel) -> None:
    chains = (model.wire, *model.droppers.chains)
    named = [chain.nodes.ravel() for chain in chains]
    named += [model.support_s, model.clamp_s, model.pull, model.droppers.travel, model.multipliers]
    np.testing.assert_array_equal(np.sort(np.concatenate(named)), np.arange(model.system.size))
    kind = model.system.unknowns.kind
    for where, wanted in (
        (model.wire.nodes[:, :3], Kind.POSITION),
        (model.wire.nodes[:, 3:], Kind.SLOPE),
        (model.support_s, Kind.SLIDING),
        (model.clamp_s, Kind.SLIDING),
        (model.pull, Kind.PARAMETER),
        (model.droppers.travel, Kind.PARAMETER),
        (model.multipliers, Kind.MULTIPLIER),
    ):
        assert (kind[where] == wanted).all()


def test_counts_of_unknowns(contact: WireModel, messenger: WireModel) -> None:
    """21 droppers of 3 nodes; 2 or 4 supports; 3 multipliers for each joint and each end."""
    for model, supports in ((contact, 2), (messenger, 4)):
        count = {kind: int(np.count_nonzero(model.system.unknowns.where(kind))) for kind in Kind}
        nodes = model.wire.knots.size + 21 * 3
        assert count[Kind.POSITION] == count[Kind.SLOPE] == 3 * nodes
        assert count[Kind.SLIDING] == supports + 21
        assert count[Kind.PARAMETER] == 1 + 21
        assert count[Kind.MULTIPLIER] == 3 * (supports + 21 + 21 + 2)


def bands(model: WireModel) -> NDArray[np.int64]:
    """Return how far from the diagonal each entry is, without those of the pull, which moves both ends."""
    matrix = model.system.jacobian(State.at_rest(model.system.unknowns.start), 1.0, 1.0).tocoo()
    far = np.isin(matrix.row, model.pull) | np.isin(matrix.col, model.pull)
    return np.abs(matrix.row - matrix.col)[~far]


def test_numbering_along_the_line_has_a_narrow_band(model: WireModel) -> None:
    """What lies side by side is coupled, a dropper with its elements; what was added last is not far away."""
    assert bands(model).max() < 80
    unsorted = np.argsort(model.system.unknowns.kind, kind="stable")
    matrix = model.system.jacobian(State.at_rest(model.system.unknowns.start), 1.0, 1.0).tocoo()
    place = np.argsort(unsorted)
    assert np.abs(place[matrix.row] - place[matrix.col]).max() > 10 * 80


def test_the_band_does_not_grow_with_the_line(variant: Vary) -> None:
    span = variant({}).model_dump()["spans"][0]
    end = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}}
    middle = {"messenger_wire": {"height": 1.5}}
    lines = [variant({"spans": (span,) * n, "supports": (end, *[middle] * (n - 1), end)}) for n in (2, 10)]
    short, long = (build_wire_model(contact_wire_setup(line)) for line in lines)
    assert long.system.size > 4 * short.system.size
    assert bands(long).max() == bands(short).max()


def test_positions_ascend_with_their_numbers(model: WireModel) -> None:
    z, nodes = model.system.unknowns.start, model.wire.nodes
    assert (np.diff(nodes[:, 0]) > 0).all()
    assert (np.diff(z[nodes[:, 0]]) > 0.0).all()


def test_the_wire_is_laid_out_level_with_its_tails(model: WireModel) -> None:
    z, wire = model.system.unknowns.start, model.wire
    position = z[wire.nodes[:, :3]]
    np.testing.assert_allclose(position[[0, -1], 0], [-0.5, 195.5])
    np.testing.assert_allclose(position[:, 0], wire.knots - 0.5, atol=1e-12)
    np.testing.assert_array_equal(position[:, 1], 0.0)
    np.testing.assert_array_equal(position[:, 2], model.setup.height)
    np.testing.assert_array_equal(z[wire.nodes[:, 3:]], np.tile([1.0, 0.0, 0.0], (wire.knots.size, 1)))


def test_cables_stand_up_from_the_contact_wire_and_hang_from_the_messenger(
    contact: WireModel, messenger: WireModel
) -> None:
    for model, upwards in ((contact, 1.0), (messenger, -1.0)):
        z = model.system.unknowns.start
        for cable, x in zip(model.droppers.chains, model.setup.droppers.x, strict=True):
            np.testing.assert_allclose(z[cable.nodes[:, 0]], x)
            np.testing.assert_allclose(z[cable.nodes[:, 2]], model.setup.height + upwards * cable.knots)
            assert cable.knots[-1] == 1.5


def test_joints_will_stand_at_nodes_when_the_wire_is_tensioned(model: WireModel) -> None:
    """In the solved equilibrium the wire has a node within 1 mm of every support and clamp."""
    model = build_wire_model(replace(model.setup, gravity_ramp=Ramp(0.0)))
    guess = guess_equilibrium(model)
    z = find_rest(statics(model.system, guess), guess).y
    nodes = z[model.wire.nodes[:, 0]]
    for x in (*model.setup.support_x, *model.setup.droppers.x):
        assert np.abs(nodes - x).min() < 1e-3
    laid = model.wire.knots - 0.5
    assert max(np.abs(laid - x).min() for x in model.setup.droppers.x) > 5e-3


def total_weight(model: WireModel) -> float:
    """Sum the vertical weight over all nodes [N]."""
    gravity = next(part for part in model.system.contributions if isinstance(part, Gravity))
    up = np.concatenate([chain.nodes[:, 2] for chain in (model.wire, *model.droppers.chains)])
    return -float(gravity.g * gravity.weight[up].sum())


@pytest.mark.parametrize("clamp", [0.0, 0.15])
def test_everything_weighs_what_it_weighs(variant: Vary, clamp: float) -> None:
    model = build_wire_model(contact_wire_setup(variant({"dropper.clamp_mass_bottom": clamp})))
    weight = 9.8 * (196.0 * 7710.0 * 120e-6 + 21 * (1.5 * 8900.0 * 10e-6 + clamp))
    assert total_weight(model) == pytest.approx(weight, rel=1e-9)
    assert total_weight(model) != pytest.approx(weight + 21 * 0.1, rel=1e-9)


def test_gravity_and_controls_come_in_with_their_ramps(contact: WireModel) -> None:
    """At t = 0 nothing happens, at the end of the ramp everything weighs and every control runs."""
    z = contact.system.unknowns.start
    moved = np.concatenate((contact.pull, contact.droppers.travel))
    late = residual(contact, z, t=5.0)
    heavy = build_wire_model(replace(contact.setup, gravity_ramp=Ramp(0.0)))
    uncontrolled = residual(heavy, z)
    assert np.abs(uncontrolled).max() > 1.0
    assert uncontrolled[contact.pull] == 0.0
    assert late[contact.pull] == pytest.approx(-0.2e-3)  # the law's speed, far from the target
    others = np.setdiff1d(np.arange(z.size), moved)
    np.testing.assert_allclose(late[others], uncontrolled[others], atol=1e-12)


def test_renumbering_reaches_every_field(contact: WireModel) -> None:
    """No index array of the model was left with the numbers of its building."""
    arrays = [getattr(part, item.name) for part in (contact, contact.droppers) for item in fields(part)]
    arrays = [array for array in arrays if isinstance(array, np.ndarray)]
    together = np.concatenate([array.ravel() for array in arrays])
    assert len(arrays) == 8
    assert np.unique(together).size == together.size
    assert not set(together) & set(contact.wire.nodes.ravel())
