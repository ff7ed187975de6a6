"""Droppers that would have to push: refused by name, or slack where the line file allows it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.audit import audit_result
from catenaria.errors import InfeasibleError
from catenaria.formfinding.spatial.direct import find_directly
from catenaria.formfinding.spatial.rebuild import rebuild_in_space
from catenaria.line import Line, load_line
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


def test_slack_droppers_carry_nothing_and_the_wire_is_higher_there(found: FormResult) -> None:
    droppers = found.droppers
    assert set(droppers.number[droppers.slack].tolist()) == {3, 5}
    weight = 0.5 * 9.8 * 8900 * 10e-6 * droppers.length[droppers.slack]
    np.testing.assert_allclose(droppers.force_bottom[droppers.slack], -weight, rtol=1e-6)
    assert np.all(droppers.height_error[droppers.slack] > 1e-3)
    np.testing.assert_allclose(droppers.height_error[~droppers.slack], 0.0, atol=1e-9)
    assert np.all(droppers.force_bottom[~droppers.slack] > 0.0)


def test_the_wire_runs_past_slack_droppers_as_if_they_were_not_there(found: FormResult) -> None:
    """A string between the neighbours, under its own weight: z'' = w/T; and under another tension it does not."""
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


def test_changes_nothing_where_all_droppers_pull() -> None:
    level = (0.0,) * 7
    allowed, refused = (find_directly(line(slack, level), None) for slack in ("allowed", "refused"))
    np.testing.assert_allclose(allowed.droppers.length, refused.droppers.length, rtol=0.0, atol=1e-9)
    assert not allowed.droppers.slack.any()
