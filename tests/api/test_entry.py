"""Lines from files and mappings, and results from lines."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

import catenaria


@pytest.fixture
def fields(paper_file: Path) -> dict[str, Any]:
    """What stands in the file of the paper's line, by itself."""
    text = json.dumps(YAML(typ="safe").load(paper_file.read_text(encoding="utf-8")))
    return json.loads(text)  # without what YAML's aliases share


def test_paths_and_mappings_give_the_same_line(paper_file: Path, fields: dict[str, Any]) -> None:
    line = catenaria.load(paper_file)
    assert catenaria.load(str(paper_file)) == line
    assert catenaria.load(fields) == line
    assert isinstance(line, catenaria.Line)
    fields["gravity"] = 9.81
    assert catenaria.load(fields) != line


def test_every_fault_of_a_mapping_is_told_by_its_place(fields: dict[str, Any]) -> None:
    fields["spans"][0]["length"] = fields["spans"][1]["length"] = "65 kg"
    fields["messenger_wire"]["tension"]["force"] = "15 km"
    with pytest.raises(catenaria.LineFileError) as caught:
        catenaria.load(fields)
    faults = caught.value.faults
    assert {fault.field for fault in faults} == {
        "spans[0].length",
        "spans[1].length",
        "messenger_wire.tension.force",
    }
    assert all(isinstance(fault, catenaria.Fault) and fault.line == 0 for fault in faults)
    assert str(caught.value).startswith("mapping: ")


@pytest.mark.parametrize("nonsense", [{}, {"format": 1}, {1: 2}, {"format": 1, "spans": None}])
def test_nonsense_is_refused(nonsense: dict[Any, Any]) -> None:
    with pytest.raises(catenaria.LineFileError):
        catenaria.load(nonsense)


def test_a_mapping_that_describes_a_structure_is_refused() -> None:
    with pytest.raises(catenaria.UnsupportedError, match="free structure"):
        catenaria.load({"format": 1, "cables": {}, "sections": {}})


def test_a_mapping_is_left_as_it_was(fields: dict[str, Any]) -> None:
    fields["spans"][0]["length"] = "65 kg"
    before = json.dumps(fields)
    with pytest.raises(catenaria.LineFileError):
        catenaria.load(fields)
    assert json.dumps(fields) == before


def test_lines_paths_and_mappings_are_solved_alike(
    paper_file: Path, fields: dict[str, Any], paper: catenaria.Result
) -> None:
    assert catenaria.solve(fields) == paper
    assert catenaria.solve(catenaria.load(paper_file)) == paper


def test_an_unknown_method_is_refused(paper_file: Path) -> None:
    assert "direct" in catenaria.METHODS
    with pytest.raises(catenaria.UnsupportedError, match="guessing"):
        catenaria.solve(paper_file, "guessing")


def test_mesh_start_and_progress_are_passed_on(paper_file: Path, paper: catenaria.Result) -> None:
    told: list[object] = []
    fine = catenaria.solve(paper_file, mesh=catenaria.Mesh(refine=2), rebuild="none", progress=told.append)
    assert len(fine.profile()) > 1.5 * len(paper.profile())
    assert fine.rebuilt.way == ""
    assert told
    again = catenaria.solve(paper_file, start=paper)
    assert sum(again.table("counters")["steps"]) < sum(paper.table("counters")["steps"])


def test_a_saved_result_comes_back_equal(paper: catenaria.Result, tmp_path: Path) -> None:
    files = paper.save(tmp_path / "run", figures=False)
    assert {"droppers.csv", "result.json", "result.npz"} <= {file.name for file in files}
    assert catenaria.load_result(tmp_path / "run") == paper
    with pytest.raises(catenaria.InconsistentInputError):
        catenaria.load_result(tmp_path / "nothing")


def moved(result: catenaria.Result) -> catenaria.Result:
    droppers = result.form.droppers
    return catenaria.Result(replace(result.form, droppers=replace(droppers, length=droppers.length + 1e-12)))


def renamed(result: catenaria.Result) -> catenaria.Result:
    return catenaria.Result(replace(result.form, name="another"))


def counted(result: catenaria.Result) -> catenaria.Result:
    counters = tuple(replace(counter, steps=counter.steps + 1) for counter in result.form.counters)
    return catenaria.Result(replace(result.form, counters=counters))


@pytest.mark.parametrize("change", [moved, renamed, counted])
def test_equality_sees_everything(
    paper: catenaria.Result, change: Callable[[catenaria.Result], catenaria.Result]
) -> None:
    assert paper == catenaria.Result(replace(paper.form))
    assert paper != change(paper)
    assert paper != "a result"


def test_equality_does_not_see_the_clock(paper: catenaria.Result) -> None:
    counters = tuple(replace(counter, wall_time=1e3) for counter in paper.form.counters)
    assert paper == catenaria.Result(replace(paper.form, counters=counters))
