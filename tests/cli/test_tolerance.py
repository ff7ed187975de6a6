"""`catenaria tolerance` and `catenaria rounding`: what is told, written and refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from catenaria import workflow
from catenaria.cli.main import app

EXAMPLES = Path(__file__).parents[2] / "examples"
EXAMPLE = EXAMPLES / "yang2017_three_span.yaml"


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("results") / "line"
    workflow.write(workflow.solve(EXAMPLE), folder, figures=False)
    return folder


def test_a_study_is_told_and_written_beside_the_result(result: Path) -> None:
    outcome = run("tolerance", result, "--samples", 80, "--workers", 1, "--no-figures")
    assert outcome.exit_code == 0, outcome.output
    text = " ".join(outcome.stdout.split())
    assert "80 samples, nonlinear, seed 1: the contact wire leaves ±5 mm in" in text
    assert "messenger height 4" in text
    assert "The linearised line leaves it in" in text
    assert (result.with_name("line-tolerance") / "heights.csv").exists()


def test_the_same_command_gives_the_same_files(result: Path, tmp_path: Path) -> None:
    for name, workers in (("a", 1), ("b", 2)):
        common = ("--samples", 70, "--seed", 3, "--workers", workers, "--out", tmp_path / name)
        assert run("tolerance", result, *common).exit_code == 0
    names = sorted(path.relative_to(tmp_path / "a") for path in (tmp_path / "a").rglob("*") if path.is_file())
    assert len(names) == 14
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()


def test_a_linear_study_of_a_line_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    errors = EXAMPLES / "installation_errors.yaml"
    outcome = run(
        "tolerance", EXAMPLE, "--linear", "--samples", 500, "--errors", errors, "--tolerance", "1 cm"
    )
    assert outcome.exit_code == 0, outcome.output
    assert "500 samples, linear, seed 2017: the contact wire leaves ±10 mm" in outcome.stdout
    assert (tmp_path / "results" / "yang2017_three_span-tolerance" / "figures" / "heights.png").exists()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("dropper_length: {distribution: normal}", "dropper_length.scale: found nothing"),
        ("known: {droppers: [{span: 7, dropper: 1}]}", "a span from 1 to 3"),
        ("known: {supports: [{support: mast 9}]}", "one of S1, S2, S3, S4"),
    ],
)
def test_wrong_errors_are_bad_input_and_nothing_is_lost(
    result: Path, tmp_path: Path, text: str, told: str
) -> None:
    file, out = tmp_path / "errors.yaml", tmp_path / "out"
    file.write_text(text + "\n", encoding="utf-8")
    assert run("tolerance", result, "--linear", "--samples", 5, "--no-figures", "--out", out).exit_code == 0
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    outcome = run("tolerance", result, "--errors", file, "--samples", 5, "--out", out)
    assert outcome.exit_code == 2
    assert told in outcome.stderr
    assert outcome.stderr.startswith(f"{file}:1:")
    assert "Traceback" not in outcome.output
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--tolerance", "5 N"), "--tolerance: found '5 N'; allowed: a length"),
        (("--tolerance", "0 mm"), "a length above zero"),
        (("--errors", "nowhere.yaml"), "no such file"),
        (("--samples", "90000000", "--linear"), "too much memory"),
    ],
)
def test_wrong_options_are_bad_input(
    result: Path, tmp_path: Path, arguments: tuple[str, ...], told: str
) -> None:
    outcome = run("tolerance", result, *arguments, "--out", tmp_path / "out")
    assert outcome.exit_code == 2
    assert told in outcome.stderr
    assert not (tmp_path / "out").exists()


def test_an_interrupted_study_leaves_nothing(
    result: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("catenaria.workflow.tolerances", interrupt)
    outcome = run("tolerance", result, "--out", tmp_path / "out")
    assert outcome.exit_code == 130
    assert not (tmp_path / "out").exists()


def test_rounding_tells_the_height_errors_of_steps(result: Path) -> None:
    outcome = run("rounding", result, "--step", "5mm", "--step", "1 cm")
    assert outcome.exit_code == 0, outcome.output
    rows = [line.split() for line in outcome.stdout.splitlines() if line.strip()[:2] in ("5 ", "10")]
    assert [row[0] for row in rows] == ["5", "10"]
    assert 1.0 < float(rows[0][2]) < 3.0
    assert (result.with_name("line-rounding") / "rounding.png").exists()


@pytest.mark.parametrize("step", ["0 mm", "five", "-1 mm", "30 m"])
def test_wrong_steps_are_bad_input(result: Path, tmp_path: Path, step: str) -> None:
    outcome = run("rounding", result, "--step", step, "--out", tmp_path / "out")
    assert outcome.exit_code == 2
    assert not (tmp_path / "out").exists()


def test_help_teaches_by_an_example() -> None:
    for command in ("tolerance", "rounding"):
        outcome = run(command, "--help")
        assert outcome.exit_code == 0
        assert f"catenaria {command} examples/yang2017_three_span.yaml" in outcome.stdout
