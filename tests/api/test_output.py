"""A result is written from Python as the commands write it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import catenaria
from catenaria import workflow


@pytest.fixture(scope="module")
def strings(paper_file: Path) -> catenaria.Result:
    return catenaria.solve(paper_file, "force density", rebuild="none")


def test_all_that_a_result_has(strings: catenaria.Result, tmp_path: Path) -> None:
    files = strings.export(tmp_path / "all")
    names = {path.name for path in files} - {"manifest.json"}
    assert names == {"schedule.xlsx", "schedule.csv", "profile.dxf", "plan.dxf", "line.vtu", "tables.json"}


def test_some_of_it_as_the_command_does(paper: catenaria.Result, tmp_path: Path) -> None:
    paper.export(tmp_path / "one", "csv", step=0.005)
    paper.export(tmp_path / "some", ["csv", "json"], step=0.005)
    workflow.export(paper.form, ["csv"], tmp_path / "wanted.csv", workflow.ExportOptions(0.005))
    wanted = (tmp_path / "wanted.csv").read_bytes()
    assert (tmp_path / "one" / "schedule.csv").read_bytes() == wanted
    assert (tmp_path / "some" / "schedule.csv").read_bytes() == wanted
    assert paper.export(tmp_path / "file.csv", "csv") == (tmp_path / "file.csv",)
    assert (tmp_path / "file.csv").read_bytes() != wanted  # at the usual step


def test_modes(paper: catenaria.Result, tmp_path: Path) -> None:
    files = {path.name for path in paper.export(tmp_path / "model", "dynamics", modes=1)}
    assert {"model.json", "modes.npz", "stiffness.npz"} < files


@pytest.mark.parametrize("formats", ["pdf", ["csv", "pdf"], [], "d"])
def test_formats_that_are_none(paper: catenaria.Result, tmp_path: Path, formats: Any) -> None:
    with pytest.raises(catenaria.InconsistentInputError, match="there is xlsx, csv, dxf"):
        paper.export(tmp_path / "nothing", formats)
    assert not (tmp_path / "nothing").exists()


def test_strings_have_no_matrices(strings: catenaria.Result, tmp_path: Path) -> None:
    with pytest.raises(catenaria.UnsupportedError):
        strings.export(tmp_path / "nothing", "dynamics")
    assert not (tmp_path / "nothing").exists()


def test_a_report(paper: catenaria.Result, tmp_path: Path) -> None:
    file = tmp_path / "report.html"
    assert paper.report(file, speed=200 / 3.6, date="today, says the user") == (file,)
    text = file.read_text(encoding="utf-8")
    assert paper.name in text
    assert "today, says the user" in text
    assert '<section id="elasticity">' in text
    paper.report(file, elasticity=False)
    assert '<section id="elasticity">' not in file.read_text(encoding="utf-8")
