"""From a result and load cases to a study on disk."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.catenary.blow_off import BlownSpan
from catenaria.errors import InconsistentInputError, NotConvergedError, UnsupportedError
from catenaria.line.load_case import LoadCases
from catenaria.loading.built_line import BuiltLine
from catenaria.report.case_figures import deviates
from catenaria.results import FormResult, load_result, save_result
from catenaria.results.case import LoadStudy
from catenaria.workflow import solve, under_loads, write_loads

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
CASES: dict[str, Any] = {
    "cold": {"temperature": {"change": "-20 K"}},
    "hot": {"temperature": {"change": "40 K"}},
    "wind": {"wind": {"speed": "20 m/s"}},
    "push": {"push": [{"chainage": "97.5 m", "force": "200 N"}], "temperature": {"change": "10 K"}},
    "gap": {"broken_droppers": [{"span": 2, "number": 4}]},
}


@pytest.fixture(scope="module")
def result() -> FormResult:
    """Return the form of the paper's line."""
    return solve(EXAMPLE, rebuild="none")


@pytest.fixture(scope="module")
def study(result: FormResult) -> LoadStudy:
    """Return it under all cases."""
    return under_loads(result, LoadCases.model_validate({"format": 1, "cases": CASES}))


def rows(file: Path) -> list[dict[str, str]]:
    """Return the rows of a CSV file."""
    with file.open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_plane_results_are_loaded_in_space(result: FormResult, study: LoadStudy) -> None:
    np.testing.assert_allclose(study.before.droppers.height, result.droppers.height, atol=1e-6)
    wind = study.cases[2]
    assert np.abs(wind.state.wires[0].lateral).max() > 0.1
    assert np.abs(study.before.wires[0].lateral).max() < 1e-9


def test_a_study_comes_back_as_it_was(study: LoadStudy, tmp_path: Path) -> None:
    save_result(study, tmp_path)
    again = load_result(tmp_path, LoadStudy)
    assert [case.name for case in again.cases] == list(CASES)
    for case, other in zip(study.cases, again.cases, strict=True):
        np.testing.assert_array_equal(case.state.wires[1].height, other.state.wires[1].height)
        assert case.stated == other.stated
    with pytest.raises(InconsistentInputError, match="is not a catenaria form-finding result"):
        load_result(tmp_path)


def test_files(study: LoadStudy, tmp_path: Path) -> None:
    files = write_loads(study, tmp_path / "out")
    names = {file.relative_to(tmp_path / "out").as_posix() for file in files}
    assert {
        "cases.csv",
        "result.json",
        "result.npz",
        "stroke.png",
        "wind/lateral.png",
        "hot/heights.png",
    } <= names
    assert {"wind/blow_off.csv", "push/pushes.csv", "gap/droppers.csv", "cold/wires.csv"} <= names
    assert not {"hot/blow_off.csv", "hot/pushes.csv", "hot/lateral.png"} & names
    table = rows(tmp_path / "out" / "cases.csv")
    assert [row["case"] for row in table] == ["as built", *CASES]
    assert all(float(row["temperature_degC"]) - float(row["warming_K"]) == 15.0 for row in table)
    assert float(table[2]["contact_wire_stroke_m"]) > 0.05
    assert table[0]["push_uplift_m"] == ""
    assert float(table[4]["push_uplift_m"]) == pytest.approx(study.cases[3].pushed.uplift[0], abs=1e-5)
    assert (table[3]["within_400_mm"], table[1]["within_400_mm"]) == ("False", "True")


def test_a_missing_dropper_is_marked(study: LoadStudy, tmp_path: Path) -> None:
    write_loads(study, tmp_path / "out", figures=False)
    table = rows(tmp_path / "out" / "gap" / "droppers.csv")
    broken = [(row["span"], row["dropper"], row["force_N"]) for row in table if row["broken"] == "True"]
    assert broken == [("2", "4", "0.000")]
    assert not list((tmp_path / "out").rglob("*.png"))


def test_the_table_of_the_textbook_says_what_its_formula_says(study: LoadStudy) -> None:
    blown = study.cases[2].blow_off
    numbers = blown.length, blown.stagger_start, blown.stagger_end, blown.load, blown.tension, blown.curvature
    for i, row in enumerate(zip(*numbers, strict=True)):
        assert BlownSpan(*map(float, row)).furthest[1] == pytest.approx(blown.alone[i], rel=1e-12)
    assert not study.cases[1].blow_off.wire


GUIDE = Path(__file__).parents[2] / "docs" / "guide" / "load_cases.md"


def test_the_example_gives_the_numbers_of_the_guide() -> None:
    """Blow-off by both formulas and as solved, of the three cases with wind."""
    examples = EXAMPLE.parent
    study = under_loads(solve(examples / "simple_60m.yaml", rebuild="none"), examples / "load_cases.yaml")
    found: list[list[str]] = []
    for case in study.cases:
        blown = case.blow_off
        if blown.wire:
            i = int(np.argmax(np.abs(blown.solved)))
            found.append([f"{1e3 * abs(by[i]):.0f} mm" for by in (blown.alone, blown.combined, blown.solved)])
    table = [line.strip("| ").split(" | ") for line in GUIDE.read_text(encoding="utf-8").splitlines()]
    assert found == [cells[1:] for cells in table if len(cells) == 4 and cells[-1].endswith(" mm")]
    assert len(found) == 3


def test_only_what_deviates_has_a_plan(study: LoadStudy) -> None:
    assert [deviates(study, case) for case in study.cases] == [False, False, True, False, False]


def test_a_study_replaces_only_a_study(study: LoadStudy, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("keep")
    with pytest.raises(InconsistentInputError, match="left as it is"):
        write_loads(study, tmp_path / "mine", figures=False)
    assert (tmp_path / "mine" / "notes.txt").read_text() == "keep"


def test_results_without_nodes_are_refused() -> None:
    string = solve(EXAMPLE, method="separated")
    with pytest.raises(UnsupportedError, match="separated"):
        under_loads(string, LoadCases.model_validate({"format": 1, "cases": {"none": {}}}))


def test_a_case_without_rest_is_named(result: FormResult, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise NotConvergedError("It does not rest", "less of it")

    monkeypatch.setattr(BuiltLine, "at_rest", BuiltLine.of(_line(result), result).at_rest)
    monkeypatch.setattr("catenaria.loading.case.at_rest", fail)
    with pytest.raises(NotConvergedError, match="Load case cold: It does not rest"):
        under_loads(result, LoadCases.model_validate({"format": 1, "cases": {"cold": CASES["cold"]}}))


def _line(result: FormResult) -> Any:
    from catenaria.line import Line

    return Line.model_validate(result.inputs)
