"""The built line: at rest where it was found, with devices that follow loads by their own laws."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.found import found_model
from catenaria.discretise.spatial.loaded import (
    Devices,
    line_load,
    material_at,
    point_load,
    warmed,
    with_dropper_lengths,
    with_moved_supports,
    without_droppers,
)
from catenaria.errors import InconsistentInputError, UnsupportedError
from catenaria.formfinding.direct import Direct
from catenaria.line import Line, load_line
from catenaria.loading.built_line import BuiltLine

FloatArray = NDArray[np.float64]
EXAMPLES = Path(__file__).parents[2] / "examples"
ALPHA = 17e-6


def shortened(name: str) -> Line:
    """An example cut down to its first three spans."""
    data = load_line(EXAMPLES / f"{name}.yaml").model_dump()
    data["spans"], data["supports"] = data["spans"][:3], data["supports"][:4]
    return Line.model_validate(data)


@pytest.fixture(scope="module", params=["yang2017_three_span", "stitched_re250", "curve_800m"])
def built(request: pytest.FixtureRequest) -> BuiltLine:
    line = shortened(request.param)
    return BuiltLine.of(line, Direct().find_form(line))


@pytest.fixture(scope="module")
def paper() -> BuiltLine:
    line = load_line(EXAMPLES / "yang2017_three_span.yaml")
    return BuiltLine.of(line, Direct().find_form(line))


def test_is_at_rest_where_it_was_found(built: BuiltLine) -> None:
    """In plane and in space, without any step of the iteration that is worth the name."""
    droppers = built.result.droppers
    assert built.at_rest.iterations <= 1
    np.testing.assert_allclose(built.at_rest.height, droppers.height, rtol=0.0, atol=1e-9)
    longer = built.under(model=with_dropper_lengths(built.model, droppers.unstressed_length + 1e-5))
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(longer.height, droppers.height, rtol=0.0, atol=1e-9)


def test_kept_factors_lead_to_the_same_rest(built: BuiltLine) -> None:
    rng = np.random.default_rng(7)
    length = built.result.droppers.unstressed_length
    changed = with_dropper_lengths(built.model, length + rng.normal(0.0, 2e-3, length.size))
    quick, anew = built.under(model=changed, factors=built.factors), built.under(model=changed)
    np.testing.assert_allclose(quick.height, anew.height, rtol=0.0, atol=1e-9)
    assert np.abs(quick.height - built.at_rest.height).max() > 1e-3


def test_small_loads_superpose(built: BuiltLine) -> None:
    model = built.model
    middle = np.array([0.5 * (built.line.support_x[1] + built.line.support_x[2])])
    push = point_load(model, 0, material_at(model, 0, built.line.alignment, middle), np.array([[0, 0, 0.1]]))[
        0
    ]
    wind = line_load(model, [np.tile([0.0, 1e-3, 0.0], (chain.L.size, 1)) for chain in model.wires])
    moved = [built.under(load).z - built.at_rest.z for load in (push, wind, push + wind)]
    at = model.wires[0].nodes[:, :3]
    np.testing.assert_allclose((moved[0] + moved[1])[at], moved[2][at], rtol=0.0, atol=1e-7)
    assert np.abs(moved[2][at]).max() > 1e-5


def test_weights_keep_the_tension_and_travel_as_the_wire_grows_longer(paper: BuiltLine) -> None:
    warm = paper.under(model=warmed(paper.model, 20.0, (ALPHA, ALPHA), ALPHA))
    cold = paper.at_rest
    tension = [np.linalg.norm(state.end_force[:, 1], axis=1) for state in (cold, warm)]
    np.testing.assert_allclose(tension[1], tension[0], rtol=1e-9)
    length = np.array([chain.knots[-1] for chain in paper.model.wires])
    grown = 0.5 * length * ALPHA * 20.0  # each end moves out by half
    np.testing.assert_allclose(warm.travel - cold.travel, grown, rtol=5e-3)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(warm.travel - cold.travel, 1.02 * grown, rtol=5e-3)


def test_fixed_ends_lose_tension_when_the_wire_grows_longer(paper: BuiltLine) -> None:
    """A nearly straight wire between fixed points: dT = -EA alpha dT, less what its sag gives."""
    fixed = replace(paper, devices=Devices((False, True), np.zeros(2)))
    warm = fixed.under(model=warmed(paper.model, 1.0, (ALPHA, 0.0), 0.0))
    np.testing.assert_allclose(warm.travel[0], paper.at_rest.travel[0], rtol=0.0, atol=1e-12)
    lost = np.linalg.norm(warm.end_force[0, 1]) - np.linalg.norm(paper.at_rest.end_force[0, 1])
    assert lost == pytest.approx(-130e9 * 120e-6 * ALPHA, rel=0.01)


def test_springs_give_way(paper: BuiltLine) -> None:
    """Between weights and fixed ends: T = T0 - k (p - p0)."""
    stiffness = 50e3
    sprung = replace(paper, devices=Devices((True, True), np.array([stiffness, 0.0])))
    warm = sprung.under(model=warmed(paper.model, 20.0, (ALPHA, ALPHA), ALPHA))
    before, after = (np.linalg.norm(state.end_force[0, 1]) for state in (paper.at_rest, warm))
    travel = warm.travel[0] - paper.at_rest.travel[0]
    assert travel > 0.01
    assert after - before == pytest.approx(-stiffness * travel, rel=1e-9)


def test_a_missing_dropper_lets_the_wire_hang_between_its_neighbours(paper: BuiltLine) -> None:
    missing = np.arange(21) == 10
    loaded = paper.under(model=without_droppers(paper.model, missing))
    sunk = loaded.height - paper.at_rest.height
    assert loaded.dropper_pull[10] == pytest.approx(0.0, abs=1e-9)
    assert int(np.argmin(sunk)) == 10
    carried, before = loaded.dropper_pull, paper.at_rest.dropper_pull
    assert carried[9] - before[9] + carried[11] - before[11] == pytest.approx(before[10], rel=0.1)


def test_a_pushed_string_rises_as_the_closed_form_says(paper: BuiltLine) -> None:
    """A contact wire without droppers, F a b/(T L) less what its bending stiffness takes away."""
    alone = without_droppers(paper.model, np.ones(21, dtype=np.bool_))
    free, at = paper.under(model=alone), np.array([65.0])
    s = material_at(paper.model, 0, paper.line.alignment, at)
    push = point_load(alone, 0, s, np.array([[0.0, 0.0, 1.0]]))[0]
    rise = (paper.under(push, model=alone).points(0, s) - free.points(0, s))[0, 2]
    T, L = 15e3, 195.0
    assert rise == pytest.approx(65.0 * 130.0 / (T * L), rel=0.01)


def test_a_moved_support_takes_the_wire_along(built: BuiltLine) -> None:
    holds, messenger = built.model.layout.holds, 1
    at = np.flatnonzero(holds.wire == messenger)[1]
    shift = np.zeros((built.model.hold_s.size, 3))
    shift[at] = [0.0, 0.0, 0.01]
    moved = built.under(model=with_moved_supports(built.model, shift))
    s = built.model.unknowns.start[built.model.hold_s[[at]]]
    rise = moved.points(messenger, s) - built.at_rest.points(messenger, s)
    assert rise[0, 2] == pytest.approx(0.01, rel=0.05)


def test_a_place_beyond_the_wire_is_refused(built: BuiltLine) -> None:
    with pytest.raises(InconsistentInputError, match="contact wire reaches from"):
        material_at(built.model, 0, built.line.alignment, np.array([1e4]))


def test_results_without_nodes_are_refused(paper: BuiltLine) -> None:
    with pytest.raises(UnsupportedError, match="no nodes to start from"):
        found_model(paper.line, replace(paper.result, physics="string"))
