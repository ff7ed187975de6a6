"""From a result to a folder: everything is there, an earlier result is replaced, nothing else is touched."""

from __future__ import annotations

import csv
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.line import Line
from catenaria.results import FormResult, load_result
from catenaria.workflow import solve, write

TABLES = {
    f"{name}.csv" for name in ("droppers", "wires", "supports", "controls", "counters", "configuration")
}


@pytest.fixture(scope="module")
def moved(small: Line) -> FormResult:
    return solve(small, method="dynamic")


def files_in(folder: Path) -> set[Path]:
    return {path for path in folder.rglob("*") if path.is_file() and path.name != "manifest.json"}


def test_everything_is_there(small_result: FormResult, tmp_path: Path) -> None:
    files = write(small_result, tmp_path / "out", figures=False)
    assert set(files) == files_in(tmp_path / "out")
    assert {path.name for path in files} >= TABLES | {"result.json", "result.npz"}
    assert (tmp_path / "out" / "manifest.json").exists()
    assert not any(path.is_dir() for path in (tmp_path / "out").iterdir())
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]  # nothing temporary is left


def test_a_motion_leaves_its_history(moved: FormResult, tmp_path: Path) -> None:
    names = {path.name for path in write(moved, str(tmp_path / "out"), figures=False)}
    assert names >= TABLES | {"history.csv"}


def test_figures_are_drawn_when_they_are_wanted(small_result: FormResult, tmp_path: Path) -> None:
    files = write(small_result, tmp_path / "out")
    figures = [path for path in files if path.parent.name == "figures"]
    assert figures
    assert set(files) == files_in(tmp_path / "out")
    assert all(path.stat().st_size > 1000 for path in figures)


def check_read_back(folder: Path, result: FormResult) -> None:
    again = load_result(folder)
    np.testing.assert_array_equal(again.droppers.length, result.droppers.length)
    assert (again.name, again.method, again.inputs) == (result.name, result.method, result.inputs)
    with (folder / "droppers.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    written = [float(row["length_m"]) for row in rows]
    np.testing.assert_allclose(written, result.droppers.length, rtol=0.0, atol=6e-6)  # five decimals


def test_what_is_written_is_what_was_found(
    small_result: FormResult, moved: FormResult, tmp_path: Path
) -> None:
    write(small_result, tmp_path / "out", figures=False)
    check_read_back(tmp_path / "out", small_result)
    with pytest.raises(AssertionError):
        check_read_back(tmp_path / "out", moved)


def test_a_second_run_replaces_all_of_the_first(
    small_result: FormResult, moved: FormResult, tmp_path: Path
) -> None:
    first = write(moved, tmp_path / "out", figures=False)
    second = write(small_result, tmp_path / "out", figures=False)
    assert set(second) == files_in(tmp_path / "out")
    check_read_back(tmp_path / "out", small_result)
    assert set(first) - set(second) == {tmp_path / "out" / "history.csv"}
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]


@pytest.mark.parametrize("name", ["letter.txt", "figures/mine.png"])
def test_a_foreign_file_is_refused_and_kept(small_result: FormResult, tmp_path: Path, name: str) -> None:
    write(small_result, tmp_path / "out", figures=False)
    foreign = tmp_path / "out" / name
    foreign.parent.mkdir(exist_ok=True)
    foreign.write_text("precious", encoding="utf-8")
    before = files_in(tmp_path / "out")
    with pytest.raises(InconsistentInputError, match=foreign.name):
        write(small_result, tmp_path / "out", figures=False)
    assert files_in(tmp_path / "out") == before
    assert foreign.read_text(encoding="utf-8") == "precious"
    foreign.unlink()
    write(small_result, tmp_path / "out", figures=False)


def test_an_edited_file_is_refused_and_kept(small_result: FormResult, tmp_path: Path) -> None:
    write(small_result, tmp_path / "out", figures=False)
    (tmp_path / "out" / "droppers.csv").write_text("my notes", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"droppers\.csv"):
        write(small_result, tmp_path / "out", figures=False)
    assert (tmp_path / "out" / "droppers.csv").read_text(encoding="utf-8") == "my notes"


def test_a_run_that_fails_leaves_what_was_there(
    small_result: FormResult, moved: FormResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(small_result, tmp_path / "out", figures=False)

    def failing(result: FormResult, folder: Path) -> None:
        raise OSError("disk full")

    module = import_module("catenaria.workflow.write")  # the package's attribute is the function
    monkeypatch.setattr(module, "write_tables", failing)
    with pytest.raises(OSError, match="disk full"):
        write(moved, tmp_path / "out", figures=False)
    check_read_back(tmp_path / "out", small_result)
    assert list(tmp_path.iterdir()) == [tmp_path / "out"]
