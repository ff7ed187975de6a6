"""`catenaria compare`: table, files, exit codes."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.workflow import Compared

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, ["compare", *arguments])


def test_the_table_tells_differences_and_what_is_neglected(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    outcome = run(str(EXAMPLE), "--methods", "separated, force density")
    assert outcome.exit_code == 0
    rows = [
        line for line in outcome.stdout.splitlines() if line.strip().startswith(("direct ", "sep", "for"))
    ]
    assert "5.16" in rows[1]
    assert all("passed" in row for row in rows[:3])
    assert "separated neglects bending" in outcome.stdout
    names = {path.name for path in (tmp_path / "results" / "yang2017_three_span-methods").iterdir()}
    assert names == {"differences.csv", "differences.png", "manifest.json"}


def test_an_unknown_method_is_bad_input(tmp_path: Path) -> None:
    outcome = run(str(EXAMPLE), "--methods", "newton", "--out", str(tmp_path / "out"))
    assert outcome.exit_code == 2
    assert "no method 'newton'" in outcome.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("change", "code", "text", "told"),
    [
        ({"failure": "slack", "refused": True}, 0, "separated: slack", "refused"),
        ({"failure": "lost"}, 1, "separated: lost", "none found"),
    ],
)
def test_refusals_are_told_and_failures_fail(
    change: dict[str, Any], code: int, text: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    none = Compared("separated", "bending", None, None, 0, 0.0)
    monkeypatch.setattr("catenaria.workflow.compare", lambda *_: (dataclasses.replace(none, **change),))
    monkeypatch.setattr("catenaria.workflow.write_comparison", lambda *_: ())
    outcome = run(str(EXAMPLE), "--out", str(tmp_path / "out"))
    assert (outcome.exit_code, outcome.stderr.strip()) == (code, text)
    assert told in outcome.stdout


def test_an_interrupt_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("catenaria.workflow.compare", interrupted)
    outcome = run(str(EXAMPLE), "--out", str(tmp_path / "out"))
    assert outcome.exit_code == 130
    assert "Nothing was written" in outcome.stderr
