"""A line in space from its file to tables and figures, and back from the folder; methods side by side."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.line import Line, load_line
from catenaria.results import FormResult, load_result, save_result
from catenaria.workflow import solve, write
from catenaria.workflow.compare import compare

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


@pytest.fixture(scope="module")
def line() -> Line:
    """Two spans with stagger, steady arms and a stitch wire."""
    paper: dict[str, Any] = load_line(EXAMPLE).model_dump(mode="json", exclude_none=True)
    supports = [
        {
            "stagger": 0.2 * (-1) ** i,
            "contact_wire": {"height": 5.3, "kind": "steady arm", "arm": {"length": 1.2, "mass": 1.0}},
            "messenger_wire": {"encumbrance": 1.6},
        }
        for i in range(3)
    ]
    wires = {name: {**paper[name], "tail": 20.0} for name in ("contact_wire", "messenger_wire")}
    span = {"length": 55.0, "droppers": {"positions": [3.5, 14, 23, 32, 41, 51.5]}}
    stitch = {"conductor": "dropper", "tension": 2_000.0, "length": 16.0}
    kept = {name: paper[name] for name in ("format", "conductors", "dropper", "solver")}
    described = {**kept, **wires, "supports": supports, "spans": [span] * 2, "stitch_wire": stitch}
    return Line.model_validate(described)


@pytest.fixture(scope="module")
def result(line: Line) -> FormResult:
    return solve(line)


def test_all_tables_and_figures_of_a_line_in_space(result: FormResult, tmp_path: Path) -> None:
    names = {str(file.relative_to(tmp_path / "run")) for file in write(result, tmp_path / "run")}
    assert {"droppers.csv", "wires.csv", "supports.csv", "arms.csv", "ties.csv"} <= names
    assert {"figures/profile.png", "figures/plan.png", "figures/contact_wire.png"} <= names
    assert "cantilevers.csv" not in names
    with (tmp_path / "run" / "arms.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["support"] for row in rows] == ["S1", "S2", "S3"]
    assert float(rows[1]["radial_N"]) == pytest.approx(result.arms.radial[1], abs=1e-3)


def test_a_line_in_space_comes_back_from_its_folder(result: FormResult, tmp_path: Path) -> None:
    save_result(result, tmp_path)
    back = load_result(tmp_path)
    assert back.spatial
    np.testing.assert_array_equal(back.arms.hinge, result.arms.hinge)
    np.testing.assert_array_equal(back.ties.force, result.ties.force)
    np.testing.assert_array_equal(back.droppers.inclination, result.droppers.inclination)
    assert back.wires[2].role == "stitch wire"


def test_a_result_of_an_older_version_is_refused_in_words(result: FormResult, tmp_path: Path) -> None:
    file = save_result(result, tmp_path)
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace('"version": 2', '"version": 1', 1), encoding="utf-8")
    said = r"older catenaria: its format version is 1, this one reads 2\. Solve the line again"
    with pytest.raises(InconsistentInputError, match=said):
        load_result(tmp_path)


def test_methods_are_compared_in_space(line: Line) -> None:
    direct, dynamic, strings = compare(line, ["dynamic", "separated"])
    assert direct.differences is not None
    assert direct.differences.largest_height == 0.0
    assert dynamic.differences is not None
    assert dynamic.differences.wire == ("contact wire", "messenger wire", "stitch wire S2")
    assert 0.0 < dynamic.differences.largest_length < 5e-3  # within the dead bands of tensions
    assert dynamic.differences.largest_lateral < 5e-3
    assert strings.refused
    assert "a stagger other than 0" in strings.failure
