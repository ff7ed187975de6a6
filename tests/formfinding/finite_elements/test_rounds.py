"""What the methods cost, what their searches are like, and how they fail."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements import (
    adjusted_lengths,
    least_force_error,
    prescribed_forces,
    trial_lengths,
    weighted_residual,
)
from catenaria.formfinding.finite_elements.found import Found
from catenaria.formfinding.finite_elements.held_feet import held_feet_forces
from catenaria.formfinding.finite_elements.least_squares import least_squares
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.registry import ELEMENT_METHODS
from catenaria.formfinding.finite_elements.rest import LineState, come_to_rest
from catenaria.formfinding.finite_elements.start import parabolic_start
from catenaria.formfinding.finite_elements.trials import Trials
from catenaria.line import Line

Vary = Callable[[dict[str, Any]], Line]

MOST_ITERATIONS = {
    "adjusted lengths": 4,
    "trial lengths": 20,
    "nonlinear displacement": 50,
    "geometry variation": 14,
    "least distance": 7,
    "least force error": 11,
    "weighted residual": 11,
    "constrained optimisation": 8,
}


@pytest.fixture(scope="module")
def rest(system: LineSystem) -> LineState:
    y, unstressed = parabolic_start(system)
    return come_to_rest(system, unstressed, y)


@pytest.fixture(scope="module")
def adjusted(line: Line) -> Found:
    return adjusted_lengths.adjust_lengths(line, None)


def test_iterations_are_bounded(line: Line, method: str) -> None:
    """A derivative that is wrong and still converges takes more."""
    assert ELEMENT_METHODS[method](None).find_form(line).counters[0].steps <= MOST_ITERATIONS[method]


def test_adjusting_is_newtons_method(rest: LineState) -> None:
    """The error goes down quadratically; without what one length does to other heights it does not."""
    errors = {"exact": 0.0, "diagonal": 0.0}
    for name in errors:
        slope = rest.height_by_parameter
        slope = slope if name == "exact" else np.diag(np.diag(slope))
        change = -np.linalg.solve(slope, rest.height - rest.system.target)
        after = come_to_rest(rest.system, rest.unstressed + change, rest.y)
        errors[name] = float(np.max(np.abs(after.height - rest.system.target)))
    assert errors["exact"] < 1e-8
    assert errors["diagonal"] > 1e-4


def test_trials_halve_the_error(rest: LineState) -> None:
    """Both wires are equally taut: a dropper that is longer lowers one by a half and lets the other rise."""
    before = rest.height - rest.system.target
    after = come_to_rest(rest.system, rest.unstressed + before, rest.y)
    ratio = np.max(np.abs(after.height - rest.system.target)) / np.max(np.abs(before))
    assert 0.2 < ratio < 0.55
    growth = np.linalg.eigvals(np.eye(21) + rest.height_by_parameter)
    assert np.max(np.abs(growth)) == pytest.approx(0.504, abs=0.01)


def test_condition_of_the_objectives(rest: LineState) -> None:
    assert np.linalg.cond(rest.height_by_parameter) == pytest.approx(3.1, abs=0.2)
    assert np.linalg.cond(rest.foot_force_by_length) == pytest.approx(101.0, abs=10.0)


def test_forces_of_held_feet_are_those_of_the_droppers(system: LineSystem, adjusted: Found) -> None:
    np.testing.assert_allclose(held_feet_forces(system), adjusted.foot_force, rtol=0, atol=1e-4)


def test_wrong_target_forces_give_wrong_heights(line: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    """The objective of [10] is as good as its targets: one percent is centimetres, and it is told."""
    wrong = staticmethod(lambda system: 1.01 * held_feet_forces(system))
    monkeypatch.setattr(least_force_error, "held_feet_forces", wrong)
    with pytest.raises(NotConvergedError, match="off a height"):
        least_force_error.minimise_force_error(line, None)


@pytest.mark.parametrize("weight", [1e-5, 1e-1])
def test_weights_do_not_matter(
    line: Line, adjusted: Found, monkeypatch: pytest.MonkeyPatch, weight: float
) -> None:
    monkeypatch.setattr(weighted_residual, "TENSION", weight)
    found = weighted_residual.minimise_weighted_residual(line, None)
    np.testing.assert_allclose(found.unstressed, adjusted.unstressed, rtol=0, atol=1e-7)


def test_an_optimiser_that_ends_elsewhere_is_told(rest: LineState) -> None:
    trials = Trials(rest, rest.unstressed)
    with pytest.raises(NotConvergedError, match=r"the search ended 0.0017.* m off a height"):
        trials.found(rest.unstressed, 3, "the search")


def test_states_are_computed_once(rest: LineState) -> None:
    trials = Trials(rest, rest.unstressed)
    longer = rest.unstressed + 1e-4
    assert trials.at(longer) is trials.at(longer.copy())
    assert trials.count == 2


def test_least_squares_of_a_line_through_points() -> None:
    x = np.array([0.0, 1.0, 2.0, 3.0])
    matrix = np.column_stack((np.ones(4), x))
    found, _ = least_squares(lambda p: matrix @ p - x**2, lambda p: matrix, np.zeros(2))
    np.testing.assert_allclose(found, [-1.0, 3.0], atol=1e-8)


@pytest.mark.parametrize(
    ("module", "limit", "search"),
    [
        (adjusted_lengths, "_ROUNDS", "adjusted lengths"),
        (trial_lengths, "_TRIALS", "trial lengths"),
        (prescribed_forces, "_ROUNDS", "nonlinear displacement"),
    ],
)
def test_a_search_that_does_not_end_is_told(
    line: Line, monkeypatch: pytest.MonkeyPatch, module: object, limit: str, search: str
) -> None:
    monkeypatch.setattr(module, limit, 1)
    with pytest.raises(NotConvergedError, match="Try: --"):
        ELEMENT_METHODS[search](None).find_form(line)


@pytest.mark.parametrize(
    ("search", "words"),
    [("geometry variation", "runs away"), ("adjusted lengths", "shorter than nothing")],
)
def test_a_wire_that_is_too_slack_is_told(vary: Vary, search: str, words: str) -> None:
    with pytest.raises(NotConvergedError, match=words):
        ELEMENT_METHODS[search](None).find_form(vary({"messenger_wire.tension.force": 3e3}))


def test_a_first_guess_that_is_far_off_is_told(system: LineSystem) -> None:
    y, unstressed = parabolic_start(system)
    with pytest.raises(NotConvergedError, match=r"no state of rest near the first guess.*--start"):
        come_to_rest(system, unstressed, y + 3.0 * np.random.default_rng(1).standard_normal(y.size))


def test_changes_that_are_too_large_are_halved(rest: LineState) -> None:
    change = np.zeros_like(rest.unstressed)
    change[2] = -1.2 * rest.unstressed[2]
    halved = adjusted_lengths._adjusted(rest, change)
    assert halved.unstressed[2] == pytest.approx(0.4 * rest.unstressed[2])
    with pytest.raises(NotConvergedError, match="dropper 3"):
        adjusted_lengths._adjusted(rest, 100.0 * change)


def test_another_tension_is_refused(line: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(prescribed_forces, "_STEEPEST", 1e-6)  # the devices' reaction is then cut down
    with pytest.raises(NotConvergedError, match=r"came to rest under .* N instead of 15000 N"):
        ELEMENT_METHODS["geometry variation"](None).find_form(line)
