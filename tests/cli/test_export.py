"""`catenaria export`: what it writes and says, and what it refuses."""

from __future__ import annotations

import json
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


def test_a_file(solved: Path, tmp_path: Path) -> None:
    file = tmp_path / "droppers.csv"
    outcome = RUN.invoke(app, ["export", str(solved), "--format", "csv", "--step", "5mm", "--out", str(file)])
    assert outcome.exit_code == 0, outcome.output
    assert "Written" in outcome.output
    rows = file.read_text().splitlines()
    assert rows[0].startswith(
        "span,dropper,chainage_m,upper_wire,lower_wire,cut_length_rounded_m,cut_length_m"
    )
    assert rows[1].split(",")[5] == "1.38000"


def test_the_usual_places(solved: Path) -> None:
    outcome = RUN.invoke(app, ["export", str(solved / "result.json"), "--format", "vtk"])
    assert outcome.exit_code == 0, outcome.output
    assert (solved.parent / "line-vtk" / "line.vtu").exists()
    outcome = RUN.invoke(app, ["export", str(solved), "--format", "all", "--modes", "2"])
    assert outcome.exit_code == 0, outcome.output
    model = json.loads((solved.parent / "line-export" / "exudyn" / "model.json").read_text())
    assert len(model["frequencies"]) == 2


def test_all_that_a_method_for_strings_has(tmp_path: Path) -> None:
    save_result(solve(EXAMPLE, method="force density", rebuild="none"), tmp_path / "strings")
    outcome = RUN.invoke(app, ["export", str(tmp_path / "strings"), "--format", "all"])
    assert outcome.exit_code == 0, outcome.output
    assert "Left out: dynamics, exudyn" in outcome.output
    assert (tmp_path / "strings-export" / "plan.dxf").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--format", "dxf", "--out", "line.dxf"], "Name a folder"),
        (["--format", "xlsx", "--step", "0 mm"], "a length above zero"),
        (["--format", "xlsx", "--step", "5 N"], "--step"),
        (["--format", "csv", "--step", "9 m"], "nothing is left"),
        (["--format", "pdf"], "pdf"),
        ([], "--format"),
        (["--format", "dynamics", "--modes", "100000"], "modes"),
    ],
)
def test_bad_input(
    solved: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    out = [] if "--out" in arguments else ["--out", "out"]
    outcome = RUN.invoke(app, ["export", str(solved), *arguments, *out])
    assert outcome.exit_code == 2
    assert message in outcome.output
    assert not list(tmp_path.iterdir())


def test_a_folder_without_a_result(tmp_path: Path) -> None:
    outcome = RUN.invoke(app, ["export", str(tmp_path), "--format", "csv"])
    assert outcome.exit_code == 2
    assert "result.json cannot be read" in outcome.output


def test_the_schema_of_tables() -> None:
    outcome = RUN.invoke(app, ["schema", "--result"])
    assert outcome.exit_code == 0
    assert json.loads(outcome.output)["title"] == "Tables of a catenaria result"
    assert json.loads(RUN.invoke(app, ["schema"]).output)["title"] != "Tables of a catenaria result"
