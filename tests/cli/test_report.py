"""`catenaria report`, `catenaria checks` and `solve --report`: what they write and refuse."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.results import save_result
from catenaria.workflow import pdf, solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
RUN = CliRunner()


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a solved line."""
    folder = tmp_path_factory.mktemp("results") / "line"
    save_result(solve(EXAMPLE, rebuild="none"), folder)
    return folder


def test_the_usual_place(solved: Path) -> None:
    outcome = RUN.invoke(app, ["report", str(solved), "--speed", "200km/h", "--date", "Friday"])
    assert outcome.exit_code == 0, outcome.output
    page = (solved.parent / "line-report.html").read_text(encoding="utf-8")
    assert "<dd>Friday</dd>" in page
    assert "<dd>200 km/h</dd>" in page


def test_the_same_again_is_the_same_file(solved: Path, tmp_path: Path) -> None:
    files = [tmp_path / name for name in ("one.html", "two.html")]
    for file in files:
        assert RUN.invoke(app, ["report", str(solved), "--out", str(file)]).exit_code == 0
    assert files[0].read_bytes() == files[1].read_bytes()


def test_elasticity_is_part_of_it_unless_it_is_left_out(solved: Path, tmp_path: Path) -> None:
    found: list[bool] = []
    for options in ([], ["--no-elasticity"]):
        outcome = RUN.invoke(app, ["report", str(solved), *options, "--out", str(tmp_path / "line.html")])
        assert outcome.exit_code == 0, outcome.output
        text = (tmp_path / "line.html").read_text(encoding="utf-8")
        found.append('<section id="elasticity">' in text)
    assert found == [True, False]
    assert not solved.with_name("line-elasticity").exists()


def test_checks_pass(solved: Path) -> None:
    outcome = RUN.invoke(app, ["checks", str(solved), "--speed", "200 km/h"])
    assert outcome.exit_code == 0, outcome.output
    assert "No check fails" in outcome.output
    assert "EN 50119:2001, Table 8" in (solved.parent / "line-checks.csv").read_text(encoding="utf-8")


def test_a_check_that_fails_ends_with_1(solved: Path, tmp_path: Path) -> None:
    file = tmp_path / "checks.csv"
    outcome = RUN.invoke(app, ["checks", str(solved), "--speed", "330 km/h", "--out", str(file)])
    assert outcome.exit_code == 1, outcome.output
    assert "1 check fails" in outcome.output
    assert "fails" in file.read_text(encoding="utf-8")


def test_rules_of_ones_own(solved: Path, tmp_path: Path) -> None:
    rules = tmp_path / "rules.yaml"
    rules.write_text("format: 1\nname: ours\ntension_variation: {id: even, limit: 0.0001}\n")
    arguments = ["checks", str(solved), "--rules", str(rules), "--out", str(tmp_path / "checks.csv")]
    outcome = RUN.invoke(app, arguments)
    assert outcome.exit_code == 1, outcome.output
    text = (tmp_path / "checks.csv").read_text(encoding="utf-8")
    assert "even" in text
    assert "EN 50119" not in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["report", "--speed", "fast"], "a speed of trains"),
        (["report", "--speed", "0 km/h"], "above 0"),
        (["report", "--speed", "900 km/h"], "540 km/h"),
        (["report", "--out", "line.pdf"], "ends in .html"),
        (["report", "--rules", "nowhere.yaml"], "nowhere.yaml"),
        (["checks", "--speed", "200 m"], "a speed of trains"),
    ],
)
def test_bad_input(
    solved: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    outcome = RUN.invoke(app, [arguments[0], str(solved), *arguments[1:]])
    assert outcome.exit_code == 2
    assert message in outcome.output
    assert list(tmp_path.iterdir()) == []


def test_no_result(tmp_path: Path) -> None:
    outcome = RUN.invoke(app, ["report", str(tmp_path)])
    assert outcome.exit_code == 2
    assert "cannot be read" in outcome.output


def test_no_browser(solved: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pdf, "BROWSERS", ("no-such-browser",))
    outcome = RUN.invoke(app, ["report", str(solved), "--pdf", "--out", str(tmp_path / "line.html")])
    assert outcome.exit_code == 2
    assert "apt install chromium" in outcome.output
    assert list(tmp_path.iterdir()) == []


def test_solve_writes_a_report(tmp_path: Path) -> None:
    arguments = ["--rebuild", "none", "--no-figures", "--report", "--out", str(tmp_path / "line")]
    outcome = RUN.invoke(app, ["solve", str(EXAMPLE), *arguments])
    assert outcome.exit_code == 0, outcome.output
    page = (tmp_path / "line" / "report.html").read_text(encoding="utf-8")
    assert "<!DOCTYPE html>" in page
    assert '<section id="elasticity">' in page
