"""The rebuilt line comes to the same rest without matrices, from a disturbed start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.line_model import LineModel
from catenaria.formfinding.coupled import guess_line
from catenaria.formfinding.rebuild import rebuild
from catenaria.formfinding.relaxed_rebuild import BuiltLine, rest_by_relaxation
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.solvers.relaxation_values import RelaxationOptions
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]

SPAN = {"length": 20.0, "droppers": {"positions": (6.0, 14.0)}, "contact_wire_height": 0.0}
HELD = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}}
FREE = {"messenger_wire": {"height": 1.5}}


@pytest.fixture(scope="session")
def short(variant: Callable[[Any], Line]) -> Line:
    """Two spans of 20 m, far along the track."""
    supports = (HELD, FREE, HELD)
    return variant({"spans": (SPAN, SPAN), "supports": supports, "start_chainage": 12_000.0})


@pytest.fixture(scope="session")
def found(short: Line) -> FormResult:
    return solve(short, rebuild="none")


def check_comes_back(line: Line, result: FormResult) -> None:
    """Within 0.01 mm and 0.1 N, the demand, and where Newton's method ends: supports give way by 1 um."""
    relaxed, static = rebuild(line, result, "relaxation"), rebuild(line, result, "static")
    assert relaxed.findings() == ()
    np.testing.assert_allclose(relaxed.height.value, static.height.value, atol=2e-6)
    np.testing.assert_allclose(relaxed.messenger_height.value, static.messenger_height.value, atol=2e-6)
    # 12 km along the track, forces of 3 mN a node are round-off, and add up along a wire
    np.testing.assert_allclose(relaxed.force.value, static.force.value, atol=0.03)
    np.testing.assert_allclose(relaxed.tension.value, static.tension.value, atol=0.03)


def test_it_comes_back(short: Line, found: FormResult) -> None:
    check_comes_back(short, found)


@pytest.mark.slow
def test_the_papers_line_comes_back(line: Line) -> None:
    check_comes_back(line, solve(line, rebuild="none"))


def test_a_dropper_that_is_too_long_does_not_come_back(short: Line, found: FormResult) -> None:
    longer = found.droppers.unstressed_length + 1e-3 * (np.arange(4) == 2)
    wrong = replace(found, droppers=replace(found.droppers, unstressed_length=longer))
    with pytest.raises(AssertionError):
        check_comes_back(short, wrong)


def test_the_start_is_centimetres_away(
    short: Line, found: FormResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is handed to the relaxation is not the equilibrium, in height nor to the side."""
    starts: list[tuple[BuiltLine, FloatArray]] = []

    def take_note(problem: BuiltLine, y: FloatArray, options: RelaxationOptions) -> None:
        starts.append((problem, y))
        raise KeyboardInterrupt

    monkeypatch.setattr("catenaria.formfinding.relaxed_rebuild.relax", take_note)
    with pytest.raises(KeyboardInterrupt):
        rebuild(short, found, "relaxation")
    (built, y), z = starts[0], found.stages[1].position
    nodes = built.unknowns(y)[built.model.messenger.wire.nodes[:, :3]]
    off = np.abs(nodes - z[: nodes.shape[0]]).max(axis=0)  # nodes of droppers follow
    assert off[1] > 0.01
    assert off[2] > 0.01
    force = np.abs(built.residual(y))
    assert force.max() > 1e3


@pytest.fixture
def guess(short: Line) -> tuple[LineModel, FloatArray]:
    return guess_line(short)


def test_forces_are_a_gradient_with_the_stiffness_bounded_by_row_sums(
    guess: tuple[LineModel, FloatArray],
) -> None:
    """Differences of the forces give a symmetric matrix whose row sums stay below the bound."""
    model, z = guess
    built = BuiltLine(model, z)
    y, h = z[built.free], 1e-7
    columns = np.random.default_rng(3).choice(y.size, 60, replace=False)
    step = h * np.eye(y.size)[columns]
    K = np.array([(built.residual(y + e) - built.residual(y - e)) / (2.0 * h) for e in step]).T
    among = K[columns]
    np.testing.assert_allclose(among, among.T, atol=1e-6 * np.abs(K).max())
    bound = built.stiffness_bound(y)
    assert np.all(np.abs(K).sum(axis=1) <= bound * (1.0 + 1e-6) + 1e-6 * np.abs(K).max())


def test_ends_are_where_they_were_pulled(short: Line, guess: tuple[LineModel, FloatArray]) -> None:
    model, z = guess
    z[model.contact.pull] += 1e-3
    at_rest, iterations = rest_by_relaxation(model, z)
    laid_out, ends = model.unknowns.start, model.contact.wire.nodes[[0, -1], 0]
    np.testing.assert_allclose(at_rest[ends] - laid_out[ends], [-1.0, 1.0] * z[model.contact.pull], atol=1e-9)
    assert iterations < 10_000
