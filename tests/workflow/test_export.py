"""Exports are written whole or not at all, and nobody else's files are touched."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from catenaria.errors import InconsistentInputError, UnsupportedError
from catenaria.export import libraries
from catenaria.results import FormResult
from catenaria.workflow import FORMATS, ExportOptions, export, formats_of, solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


@pytest.fixture(scope="module")
def result() -> FormResult:
    return solve(EXAMPLE, rebuild="none")


def test_all_formats_into_a_folder(result: FormResult, tmp_path: Path) -> None:
    files = export(result, FORMATS, tmp_path / "out", ExportOptions(step=5e-3, modes=2))
    names = {path.relative_to(tmp_path / "out").as_posix() for path in files}
    assert {"schedule.xlsx", "schedule.csv", "profile.dxf", "plan.dxf", "line.vtu", "tables.json"} <= names
    assert {"dynamics/model.json", "exudyn/model.json", "exudyn/line_in_exudyn.py"} <= names
    assert all(path.stat().st_size for path in files)
    assert len(export(result, ["csv"], tmp_path / "out")) == 1  # replaces the earlier export
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["manifest.json", "schedule.csv"]


@pytest.mark.parametrize(
    ("name", "suffix"), [("xlsx", "xlsx"), ("csv", "csv"), ("vtk", "vtu"), ("json", "json")]
)
def test_one_format_as_the_named_file(result: FormResult, tmp_path: Path, name: Any, suffix: str) -> None:
    file = tmp_path / f"line.{suffix}"
    file.write_text("earlier")
    assert export(result, [name], file) == (file,)
    assert file.stat().st_size > 1000
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize(
    ("formats", "name"),
    [
        (["dxf"], "line.dxf"),
        (["xlsx", "csv"], "line.xlsx"),
        (["json"], "line.xlsx"),
        (["dynamics"], "line.json"),
    ],
)
def test_a_file_for_what_is_none_is_refused(
    result: FormResult, tmp_path: Path, formats: Any, name: str
) -> None:
    with pytest.raises(InconsistentInputError, match="Name a folder"):
        export(result, formats, tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("formats", "out"), [(["json", "xlsx"], "out"), (["csv"], "line.csv")])
def test_a_failure_leaves_what_was_there(result: FormResult, tmp_path: Path, formats: Any, out: str) -> None:
    export(result, ["csv"], tmp_path / out)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    with pytest.raises(InconsistentInputError, match="nothing is left"):
        export(result, formats, tmp_path / out, ExportOptions(step=9.0))
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_folders_of_others_are_refused(result: FormResult, tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(InconsistentInputError, match=r"mine\.txt"):
        export(result, ["csv"], tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_methods_without_nodes_have_no_matrices(tmp_path: Path) -> None:
    strings = solve(EXAMPLE, method="force density", rebuild="none")
    assert formats_of(strings) == ("xlsx", "csv", "dxf", "vtk", "json")
    export(strings, formats_of(strings), tmp_path / "out")
    with pytest.raises(UnsupportedError, match="no nodes"):
        export(strings, ["exudyn"], tmp_path / "matrices")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize(("name", "library"), [("xlsx", "XlsxWriter"), ("dxf", "ezdxf"), ("vtk", "meshio")])
def test_a_missing_library_is_named_with_its_extra(
    result: FormResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: Any, library: str
) -> None:
    def absent(module: str) -> Any:
        raise ModuleNotFoundError(module)

    monkeypatch.setattr(libraries, "import_module", absent)
    with pytest.raises(UnsupportedError, match=rf"{library}.*pip install 'catenaria\[export\]'"):
        export(result, [name], tmp_path / "out")
    assert not list(tmp_path.iterdir())


def test_what_needs_no_library_is_written_without(
    result: FormResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(libraries, "import_module", None)
    assert len(export(result, ["csv", "json"], tmp_path / "out")) == 2
