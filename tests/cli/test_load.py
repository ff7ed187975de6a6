"""`catenaria load`: what it shows and writes, and what it refuses."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.errors import NotConvergedError
from catenaria.results import replace_folder, save_result
from catenaria.workflow import solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
RUN = CliRunner()


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a solved line."""
    folder = tmp_path_factory.mktemp("results") / "line"
    save_result(solve(EXAMPLE, rebuild="none"), folder)
    return folder


def test_options(solved: Path, tmp_path: Path) -> None:
    arguments = ["--temperature", "40 K", "--temperature", "-20 K", "--push", "200N@97.5m", "--no-figures"]
    outcome = RUN.invoke(app, ["load", str(solved), *arguments, "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 0, outcome.output
    assert "as built" in outcome.output
    assert sorted(path.name for path in (tmp_path / "out").iterdir() if path.is_dir()) == [
        "colder 20 K + push 200 N at 97.5 m",
        "warmer 40 K + push 200 N at 97.5 m",
    ]
    assert not list((tmp_path / "out").rglob("*.png"))


def test_a_file_and_the_usual_place(solved: Path, tmp_path: Path) -> None:
    cases = tmp_path / "cases.yaml"
    cases.write_text("format: 1\ncases:\n  calm: {}\n  wind: {wind: {speed: 20 m/s}}\n")
    outcome = RUN.invoke(app, ["load", str(solved / "result.json"), "--case", f"{cases}:wind"])
    assert outcome.exit_code == 0, outcome.output
    assert "by the textbook" in outcome.output
    assert (solved.parent / "line-loads" / "wind" / "lateral.png").exists()
    assert not (solved.parent / "line-loads" / "calm").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "no load case"),
        (["--push", "200N@9000m"], "push[0].chainage: found 9000.0"),
        (["--temperature", "40 m"], "a difference of temperatures"),
        (["--case", "nowhere.yaml"], "nowhere.yaml"),
    ],
)
def test_bad_input(solved: Path, tmp_path: Path, arguments: list[str], message: str) -> None:
    outcome = RUN.invoke(app, ["load", str(solved), *arguments, "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 2
    assert message in outcome.output
    assert not (tmp_path / "out").exists()


def test_an_unknown_dropper_is_named_with_its_line(solved: Path, tmp_path: Path) -> None:
    cases = tmp_path / "cases.yaml"
    cases.write_text("format: 1\ncases:\n  gap:\n    broken_droppers:\n      - {span: 2, number: 99}\n")
    outcome = RUN.invoke(app, ["load", str(solved), "--case", str(cases), "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 2
    assert f"{cases}:5:" in outcome.output
    assert "found 99; allowed: a dropper of span 2" in outcome.output


def test_no_result_there(tmp_path: Path) -> None:
    outcome = RUN.invoke(app, ["load", str(tmp_path), "--wind", "20 m/s"])
    assert outcome.exit_code == 2
    assert "cannot be read" in outcome.output


def test_a_folder_of_somebody_else_is_left(solved: Path, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("keep")
    outcome = RUN.invoke(app, ["load", str(solved), "--wind", "20 m/s", "--out", str(tmp_path)])
    assert outcome.exit_code == 2
    assert (tmp_path / "notes.txt").read_text() == "keep"


def test_the_result_itself_is_not_replaced(solved: Path, tmp_path: Path) -> None:
    line = tmp_path / "line"
    with replace_folder(line) as new:
        shutil.copytree(solved, new, dirs_exist_ok=True)
    before = (line / "result.json").read_bytes()
    for command, *options in (("load", "--wind", "20 m/s"), ("elasticity",), ("rounding",), ("tolerance",)):
        outcome = RUN.invoke(app, [command, str(line), *options, "--out", str(line)])
        assert outcome.exit_code == 2
        assert "it holds a catenaria form-finding result" in outcome.stderr
    assert (line / "result.json").read_bytes() == before


def test_a_line_is_solved_first(tmp_path: Path) -> None:
    arguments = ["load", str(EXAMPLE), "--push", "100N@65m", "--no-figures", "--out", str(tmp_path / "out")]
    outcome = RUN.invoke(app, arguments)
    assert outcome.exit_code == 0, outcome.output
    assert (tmp_path / "out" / "push 100 N at 65 m" / "pushes.csv").exists()


def test_no_rest(solved: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise NotConvergedError("Load case x: stuck", "less of it")

    monkeypatch.setattr("catenaria.workflow.under_loads", fail)
    outcome = RUN.invoke(app, ["load", str(solved), "--wind", "20 m/s", "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 1
    assert "stuck. Try: less of it" in outcome.output
    assert not (tmp_path / "out").exists()
