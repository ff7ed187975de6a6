"""The command as a whole: help, version, check, schema, and what is not loaded for them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from typer.testing import CliRunner

from catenaria import __version__
from catenaria.cli.main import app, main
from catenaria.errors import Fault, LineFileError, UnsupportedError


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, list(arguments))


def test_version() -> None:
    assert run("--version").stdout == f"catenaria {__version__}\n"


def test_help_teaches() -> None:
    top, solve = run("--help").stdout, run("solve", "--help").stdout
    assert "catenaria solve examples/yang2017_three_span.yaml --method dynamic" in top
    for text in (
        "droppers.csv",
        "--no-figures",
        "0 done and confirmed, 1 not converged or not confirmed",
    ):
        assert text in solve


def loaded_after(statements: str) -> set[str]:
    code = f"{statements}; import sys; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return set(done.stdout.split())


def test_help_loads_no_numerical_library() -> None:
    heavy = {"numba", "scipy", "pandas", "matplotlib", "pint", "pydantic"}
    assert loaded_after("import catenaria.cli.main") & heavy == set()


def test_a_heavy_import_would_be_noticed() -> None:
    """Negative control of the test above."""
    assert "matplotlib" in loaded_after("import catenaria.cli.main, matplotlib")


def test_main_ends_with_an_exit_code(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["catenaria", "--version"])
    with pytest.raises(SystemExit) as caught:
        main()
    assert caught.value.code == 0
    assert capsys.readouterr().out.startswith("catenaria ")


@pytest.fixture
def line(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """Put stand-ins in place of the functions of the line layer."""
    fake = SimpleNamespace(load_failure=None, unsupported=None)

    def load(path: Path) -> str:
        if fake.load_failure is not None:
            raise fake.load_failure
        return f"line of {path}"

    def refuse(described: str) -> None:
        if fake.unsupported is not None:
            raise fake.unsupported

    def summarise(described: str) -> list[tuple[str, list[tuple[str, str]]]]:
        return [("Line", [("name", described), ("spans", "3 x [65] m")]), ("Droppers", [("number", "21")])]

    monkeypatch.setattr("catenaria.line.load_line", load)
    monkeypatch.setattr("catenaria.line.refuse_unsupported", refuse)
    monkeypatch.setattr("catenaria.line.summarise", summarise)
    return fake


def test_check_says_what_a_file_describes(line: SimpleNamespace) -> None:
    outcome = run("check", "a.yaml")
    assert (outcome.exit_code, outcome.stderr) == (0, "")
    rows = [row.split() for row in outcome.stdout.splitlines()]
    assert ["spans", "3", "x", "[65]", "m"] in rows
    assert outcome.stdout.endswith("a.yaml: no faults found.\n")


def test_check_lists_every_fault_on_a_line_of_its_own(line: SimpleNamespace) -> None:
    allowed = "a length, for example '65 m', " * 5
    faults = tuple(Fault("a.yaml", row, 3, "spans[0].length", "'x'", allowed) for row in (4, 8))
    line.load_failure = LineFileError(faults)
    outcome = run("check", "a.yaml")
    assert (outcome.exit_code, outcome.stdout) == (2, "")
    assert outcome.stderr.splitlines() == [str(fault) for fault in faults]


def test_check_says_what_is_not_solved_yet(line: SimpleNamespace) -> None:
    line.unsupported = UnsupportedError("a.yaml:4:3: track.curves: a curved track is not solved yet")
    outcome = run("check", "a.yaml")
    assert (outcome.exit_code, outcome.stdout) == (2, "")
    assert outcome.stderr == "a.yaml:4:3: track.curves: a curved track is not solved yet\n"


def test_schema_is_json_without_any_decoration(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("catenaria.line.schema", lambda: {"title": "Länge [m]", "type": "object"})
    outcome = run("schema")
    assert json.loads(outcome.stdout) == {"title": "Länge [m]", "type": "object"}
    assert "Länge" in outcome.stdout
