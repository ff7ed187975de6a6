"""Droppers that would have to push: refused by name, or slack where the line file allows it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.audit import audit_result
from catenaria.errors import InfeasibleError
from catenaria.formfinding.spatial.direct import find_directly
from catenaria.formfinding.spatial.dynamic import find_by_motion
from catenaria.formfinding.spatial.rebuild import rebuild_in_space
from catenaria.line import Line, load_line
from catenaria.results.film import Film
from catenaria.results.form import FormResult

EXAMPLE = Path(__file__).parents[3] / "examples" / "yang2017_three_span.yaml"
HIGH = (0.0, -0.03, -0.05, 0.0, -0.05, -0.03, 0.0)  # m: the wire cannot get down beside its middle dropper


def line(slack: str, heights: tuple[float, ...] = HIGH) -> Line:
    data: dict[str, Any] = load_line(EXAMPLE).model_dump()
    data["dropper"] |= {"slack": slack, "model": "bar"}
    data["conductors"]["contact"]["bending_stiffness"] = 0.1  # next to a string
    data["spans"] = [span | {"contact_wire_height": heights} for span in data["spans"]]
    return Line.model_validate(data)


@pytest.fixture(scope="module")
def found() -> FormResult:
    return find_directly(line("allowed"), None)


def test_is_refused_by_name_where_it_is_not_allowed() -> None:
    with pytest.raises(InfeasibleError, match=r"dropper 3 in span 1 \(-.* N\)"):
        find_directly(line("refused"), None)


@pytest.mark.parametrize(("bridged", "told"), [(2.0, "; and 13 more. The clamps"), (0.0, "")])
def test_not_all_of_many_droppers_are_named(bridged: float, told: str) -> None:
    data = line("refused", (0.0,) * 7).model_dump()
    data["dropper"]["clamp_height_top"] = bridged
    if not told:
        assert find_directly(Line.model_validate(data), None).droppers.x.size == 8 + 13
        return
    with pytest.raises(InfeasibleError) as caught:
        find_directly(Line.model_validate(data), None)
    assert told in str(caught.value)
    assert str(caught.value).count("dropper ") == 8


def test_slack_droppers_carry_nothing_and_the_wire_is_higher_there(found: FormResult) -> None:
    droppers = found.droppers
    assert set(droppers.number[droppers.slack].tolist()) == {3, 5}
    weight = 0.5 * 9.8 * 8900 * 10e-6 * droppers.length[droppers.slack]
    np.testing.assert_allclose(droppers.force_bottom[droppers.slack], -weight, rtol=1e-6)
    assert np.all(droppers.height_error[droppers.slack] > 1e-3)
    np.testing.assert_allclose(droppers.height_error[~droppers.slack], 0.0, atol=1e-9)
    assert np.all(droppers.force_bottom[~droppers.slack] > 0.0)


def test_the_wire_runs_past_slack_droppers_as_if_they_were_not_there(found: FormResult) -> None:
    """A string between the neighbours, under its own weight: z'' = w/T; under another tension it is not."""
    x, z = found.droppers.x[1:4], found.droppers.height[1:4]
    w = 7710 * 120e-6 * 9.8
    half = 0.5 * 9.8 * 8900 * 10e-6 * float(found.droppers.length[2])
    a, b = x[1] - x[0], x[2] - x[1]
    chord = z[0] + (z[2] - z[0]) * a / (a + b)

    def expected(tension: float) -> float:
        return chord - (0.5 * w * a * b + half * a * b / (a + b)) / tension

    assert z[1] == pytest.approx(expected(15e3), abs=2e-4)
    assert z[1] != pytest.approx(expected(14e3), abs=2e-4)


def test_passes_its_audit_and_comes_back(found: FormResult) -> None:
    assert audit_result(found).passed
    assert rebuild_in_space(line("allowed"), found).passed


@pytest.fixture(scope="module")
def filmed() -> tuple[FormResult, list[Film]]:
    films: list[Film] = []
    data = line("allowed").model_dump()
    dynamic = data["solver"]["dynamic"]
    for control in ("contact_tension", "messenger_tension"):
        dynamic[control] |= {"dead_band": 0.1, "saturation": 5.0}
    dynamic["height"] |= {"velocity": 2e-3, "dead_band": 1e-6}
    return find_by_motion(Line.model_validate(data), None, None, films.append, 5), films


@pytest.fixture(scope="module")
def moved(filmed: tuple[FormResult, list[Film]]) -> FormResult:
    return filmed[0]


def test_motion_lets_the_same_droppers_hang_slack(found: FormResult, moved: FormResult) -> None:
    """It rests, moves on without those that push, and rests again."""
    assert [history.step for history in moved.histories] == ["line", "line with 6 slack droppers"]
    assert len(moved.counters) == 2
    np.testing.assert_array_equal(moved.droppers.slack, found.droppers.slack)
    np.testing.assert_allclose(moved.droppers.height, found.droppers.height, rtol=0.0, atol=1e-5)
    np.testing.assert_allclose(moved.droppers.force_bottom, found.droppers.force_bottom, rtol=0.0, atol=0.1)
    assert audit_result(moved).findings == ()


def test_each_motion_is_filmed(filmed: tuple[FormResult, list[Film]]) -> None:
    """The second one begins where the first one came to rest, under the whole gravity, and lifts the wire."""
    result, (first, last) = filmed
    assert [first.step, last.step] == [history.step for history in result.histories]
    np.testing.assert_allclose(last.wires.height[0], first.wires.height[-1], rtol=0.0, atol=1e-12)
    assert first.gravity[0] == 0.0
    assert np.all(last.gravity == 1.0)
    assert last.error.shape[1] == first.error.shape[1] - 6 == len(last.control_quantity)
    slack, own = result.droppers.slack, slice(0, None, 2)
    risen = last.droppers.height[-1, own] - last.droppers.height[0, own]
    assert risen[slack].min() > 1e-3
    assert np.abs(risen[~slack]).max() < 1e-4


def test_the_first_rest_of_the_motion_had_droppers_that_push(moved: FormResult) -> None:
    """Negative control: the slack ones had been held at their wanted heights, and are not in the end."""
    first, last = moved.histories
    assert len(first.control_name) == len(last.control_name) + 6
    assert np.abs(first.error[-1, 2:]).max() < 1e-5
    assert moved.droppers.height_error[moved.droppers.slack].min() > 1e-3


def test_changes_nothing_where_all_droppers_pull() -> None:
    level = (0.0,) * 7
    allowed, refused = (find_directly(line(slack, level), None) for slack in ("allowed", "refused"))
    np.testing.assert_allclose(allowed.droppers.length, refused.droppers.length, rtol=0.0, atol=1e-9)
    assert not allowed.droppers.slack.any()
