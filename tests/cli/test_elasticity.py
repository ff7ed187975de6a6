"""`catenaria elasticity`: what it shows and writes, its exit codes, and what it refuses."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.results import save_result
from catenaria.workflow import solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
RUN = CliRunner()


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a solved line."""
    folder = tmp_path_factory.mktemp("results") / "line"
    save_result(solve(EXAMPLE, rebuild="none"), folder)
    return folder


def test_a_line_is_pushed(solved: Path) -> None:
    outcome = RUN.invoke(app, ["elasticity", str(solved), "--force", "200N", "--spacing", "2m"])
    assert outcome.exit_code == 0, outcome.output
    for text in (
        "0.54-0.62",
        "S1, S4: elasticity 0",
        "Geometry is linearised",
        "non-uniformity 36.",
        "200 N",
    ):
        assert text in outcome.output
    assert (solved.parent / "line-elasticity" / "elasticity.png").exists()


def test_spans_out_of_use_do_not_count(tmp_path: Path) -> None:
    arguments = ["--spacing", "2m", "--no-figures", "--out", str(tmp_path / "out")]
    outcome = RUN.invoke(app, ["elasticity", str(EXAMPLE.with_name("overlap.yaml")), *arguments])
    assert outcome.exit_code == 0, outcome.output
    assert "non-uniformity 51." in outcome.output
    assert "Spans count from S3 to S19: in other spans the contact wire has no droppers, or is lifted." in (
        outcome.output
    )
    with (tmp_path / "out" / "spans.csv").open(encoding="utf-8") as stream:
        counted = [row["inner"] for row in csv.DictReader(stream)]
    assert counted == ["False"] * 2 + ["True"] * 16 + ["False"] * 2


def test_all_points_nonlinear_from_a_chainage_to_another(solved: Path, tmp_path: Path) -> None:
    arguments = ["--nonlinear", "--from", "65 m", "--to", "80 m", "--spacing", "5 m", "--no-figures"]
    outcome = RUN.invoke(app, ["elasticity", str(solved), *arguments, "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 0, outcome.output
    assert "Every point was solved with all nonlinearities." in outcome.output
    assert not list((tmp_path / "out").glob("*.png"))
    assert not (tmp_path / "out" / "comparison.csv").exists()


def test_a_limit_that_is_not_kept_is_said_and_all_is_written(solved: Path, tmp_path: Path) -> None:
    limits = ["--max-elasticity", "0.6 mm/N", "--max-nonuniformity", "60", "--spacing", "5 m"]
    outcome = RUN.invoke(app, ["elasticity", str(solved), *limits, "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 1
    assert "Limit not kept: the elasticity is 0.6" in outcome.stderr
    assert "non-uniformity is" not in outcome.stderr
    assert (tmp_path / "out" / "elasticity.csv").exists()
    kept = ["--max-elasticity", "0.7 mm/N", "--spacing", "5 m"]
    outcome = RUN.invoke(app, ["elasticity", str(solved), *kept, "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--force", "100 m"], "--force: found '100 m'; allowed: a force"),
        (["--force=-5 N"], "the force is -5 N"),
        (["--spacing", "0 m"], "--spacing: found '0 m'; allowed: a length above zero"),
        (["--to", "5 km"], "from 0 to 195 m"),
        (["--spacing", "1 um"], "more than 100000 points"),
        (["--max-elasticity", "0.5"], "--max-elasticity: found '0.5'; allowed: with a unit, '0.5 mm/N'"),
        (["--max-elasticity", "5e-4"], "allowed: with a unit"),
        (["--max-elasticity", "0.5 mm"], "an elasticity"),
        (["--force", "0", "--nonlinear"], "the limit of a small force is linear"),
    ],
)
def test_bad_input(solved: Path, tmp_path: Path, arguments: list[str], message: str) -> None:
    outcome = RUN.invoke(app, ["elasticity", str(solved), *arguments, "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 2
    assert message in outcome.stderr.replace("\n", " ")
    assert not (tmp_path / "out").exists()


def test_no_result_there(tmp_path: Path) -> None:
    outcome = RUN.invoke(app, ["elasticity", str(tmp_path)])
    assert outcome.exit_code == 2
    assert "cannot be read" in outcome.stderr


def test_a_folder_of_somebody_else_is_left(solved: Path, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    outcome = RUN.invoke(app, ["elasticity", str(solved), "--out", str(tmp_path)])
    assert outcome.exit_code == 2
    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_an_interruption_leaves_nothing(
    solved: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("catenaria.workflow.elasticity_as", interrupted)
    outcome = RUN.invoke(app, ["elasticity", str(solved), "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 130
    assert "Nothing was written" in outcome.stderr
    assert not (tmp_path / "out").exists()
