"""Starter files: what is offered, what is written, and that nothing is lost."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.cli.new import Kind
from catenaria.line import load_line

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, ["new", *arguments])


def test_help_lists_every_kind_with_a_word_about_it() -> None:
    rows = [row.split() for row in run("--help").stdout.splitlines()]
    for kind in Kind:
        assert any(row[:1] == [kind] and len(row) > 4 for row in rows), kind


@pytest.mark.parametrize("kind", Kind)
def test_the_starter_is_the_example(kind: Kind, tmp_path: Path) -> None:
    path = tmp_path / "line.yaml"
    outcome = run("--type", kind, "--out", str(path))
    assert (outcome.exit_code, outcome.stderr) == (0, "")
    assert path.read_bytes() == (EXAMPLES / f"{kind}.yaml").read_bytes()
    assert f"catenaria solve {path}" in outcome.stdout
    assert not load_line(path).plane


def test_every_line_among_the_examples_is_offered() -> None:
    """All but the examples of the paper, which are for comparison; files without supports are no lines."""
    lines = [path for path in EXAMPLES.glob("*.yaml") if "\nsupports:" in path.read_text(encoding="utf-8")]
    ours = {path.stem for path in lines if not path.stem.startswith("yang2017")}
    assert ours == set(Kind)


def test_the_file_is_named_after_the_kind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("--type", "overlap").exit_code == 0
    assert [path.name for path in tmp_path.iterdir()] == ["overlap.yaml"]


def test_an_existing_file_is_left_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "line.yaml"
    path.write_text("mine", encoding="utf-8")
    outcome = run("--type", "overlap", "--out", str(path))
    assert (outcome.exit_code, outcome.stdout) == (2, "")
    assert (
        outcome.stderr
        == f"{path} exists and is left as it is. Try: another --out, or --force to replace it\n"
    )
    assert path.read_text(encoding="utf-8") == "mine"


def test_force_replaces_it(tmp_path: Path) -> None:
    path = tmp_path / "line.yaml"
    path.write_text("mine", encoding="utf-8")
    assert run("--type", "overlap", "--out", str(path), "--force").exit_code == 0
    assert path.read_bytes() == (EXAMPLES / "overlap.yaml").read_bytes()


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    outcome = run("--type", "overlap", "--out", str(tmp_path / "lines" / "line.yaml"))
    assert outcome.exit_code == 2
    assert outcome.stderr.endswith("cannot be written: No such file or directory. Try: another --out\n")


def test_an_unknown_kind_is_refused_with_the_choices() -> None:
    outcome = run("--type", "simple_55")
    assert outcome.exit_code == 2
    assert "simple_55m" in outcome.stderr
