"""`catenaria adjust`: what is told, written and refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from catenaria import workflow
from catenaria.cli.main import app

EXAMPLES = Path(__file__).parents[2] / "examples"
MEASURED = EXAMPLES / "measured_heights.csv"


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("results") / "line"
    workflow.write(workflow.solve(EXAMPLES / "yang2017_three_span.yaml"), folder, figures=False)
    return folder


def test_droppers_are_told_and_written_beside_the_result(result: Path) -> None:
    outcome = run("adjust", result, "--measured", MEASURED, "--noise", "0.5mm", "--no-figures")
    assert outcome.exit_code == 0, outcome.output
    text = " ".join(outcome.stdout.split())
    assert "1 4 32.50 -30 0.9667 -14.8" in text
    assert "3 droppers. Largest deviation 14.8 mm before" in text
    assert (result.with_name("line-adjust") / "adjust.csv").exists()


def test_the_same_command_gives_the_same_files(result: Path, tmp_path: Path) -> None:
    for name in ("a", "b"):
        assert run("adjust", result, "--measured", MEASURED, "--out", tmp_path / name).exit_code == 0
    names = sorted(path.name for path in (tmp_path / "a").iterdir())
    assert "adjust.png" in names
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()


def test_nothing_to_do_is_no_failure(result: Path, tmp_path: Path) -> None:
    outcome = run("adjust", result, "--measured", MEASURED, "--tolerance", "20mm", "--out", tmp_path / "a")
    assert outcome.exit_code == 0, outcome.output
    assert "Nothing to do: heights are within 15.0 mm" in outcome.stdout


def test_what_is_not_explained_is_said(result: Path, tmp_path: Path) -> None:
    measured = tmp_path / "heights.csv"
    measured.write_text("span,dropper,height_m\n1,4,-0.030\n", encoding="utf-8")
    options = ("--noise", "10 mm", "--tolerance", "20 mm", "--no-figures", "--out", tmp_path / "a")
    outcome = run("adjust", result, "--measured", measured, *options)
    assert outcome.exit_code == 0, outcome.output
    assert "are not explained by dropper lengths" in " ".join(outcome.stdout.split())


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (("--at-most", 2), "3 droppers would do; the best that was found for 2 is 8.0 mm"),
        (("--tolerance", "5 kN"), "--tolerance: found '5 kN'; allowed: a length"),
        (("--step", "0 mm"), "--step: found '0 mm'; allowed: a length above zero"),
        (("--noise", "-1 mm"), "the noise of an adjustment must not be negative"),
        (("--at-most", "-1"), "at most -1 droppers cannot be adjusted"),
        (("--measured", "none.csv"), "none.csv: the file: found no such file"),
    ],
)
def test_bad_input_is_one_message_and_nothing_is_written(
    options: tuple[object, ...], expected: str, result: Path, tmp_path: Path
) -> None:
    outcome = run("adjust", result, "--measured", MEASURED, "--out", tmp_path / "a", *options)
    assert outcome.exit_code == 2
    assert expected in outcome.stderr
    assert "Traceback" not in outcome.output
    assert not (tmp_path / "a").exists()


def test_an_unknown_dropper_is_named_with_its_row(result: Path, tmp_path: Path) -> None:
    measured = tmp_path / "heights.csv"
    measured.write_text("span,dropper,height_m\n1,4,0.0\n2,9,0.0\n", encoding="utf-8")
    outcome = run("adjust", result, "--measured", measured, "--out", tmp_path / "a")
    assert outcome.exit_code == 2
    assert "heights.csv:3:3: dropper: found 9; allowed: 1 to 7 in span 2" in outcome.stderr
