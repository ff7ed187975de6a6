"""`catenaria solve`: arguments, exit codes and messages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.errors import (
    CatenariaError,
    Fault,
    InconsistentInputError,
    InfeasibleError,
    LineFileError,
    NotConvergedError,
    UnsupportedError,
)
from catenaria.workflow import Progress

DEFAULTS = {"line": Path("a.yaml"), "method": "direct", "start": None, "rebuild": "static", "mesh": None}


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, ["solve", *arguments])


def test_a_solved_line_is_written_and_summarised(workflow: Any) -> None:
    outcome = run("lines/three_span.yaml")
    assert (outcome.exit_code, outcome.stderr) == (0, "")
    assert workflow.solved == [DEFAULTS | {"line": Path("lines/three_span.yaml")}]
    assert workflow.written == [(Path("results/three_span"), True)]
    for text in (
        "Compiling kernels: on the first run only",
        "Step 1 of 3: contact wire",
        "Step 3 of 3: lengths",
        "Rebuilding the line from the found lengths",
        "Rebuilt: comes back.",
        "1.3790",
        "61.73",
        "15021.5",
        "Stopped: contact wire: at rest; messenger wire: at rest.",
        "height 0.0107 mm, dropper force 0.021 N, tension 21.50 N",
        "492 s simulated in 0.84 s with 475 steps, 17 rejected, 72 factorisations, 1452 unknowns",
        "Written to results/three_span: 2 files",
    ):
        assert text in outcome.stdout


def test_without_a_terminal_progress_is_a_few_lines(workflow: Any) -> None:
    lines = run("a.yaml").stdout.splitlines()
    assert lines.count("Step 1 of 3: contact wire") == 1
    details = [line for line in lines if line.startswith("  simulated time")]
    assert details == [
        "  simulated time 7.5 s, step 3 of 0.25 s, BDF order 2; "
        "largest control error 41.7 dead bands (height of dropper 3)"
    ]


def test_options_reach_the_workflow(workflow: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("catenaria.results.load_result", lambda path: f"result of {path}")
    options = ("--method", "dynamic", "--out", "here", "--start", "before", "--rebuild", "none")
    outcome = run("a.yaml", *options, "--no-figures")
    assert outcome.exit_code == 0
    changed = {"method": "dynamic", "start": "result of before", "rebuild": "none"}
    assert workflow.solved == [DEFAULTS | changed]
    assert workflow.written == [(Path("here"), False)]


def test_mesh_options_reach_the_workflow_as_a_mesh(workflow: Any) -> None:
    outcome = run("a.yaml", "--mesh", "refine=2", "--mesh", "largest_element=1.2m")
    assert outcome.exit_code == 0
    (call,) = workflow.solved
    assert call["mesh"].model_dump(exclude_unset=True) == {"refine": 2, "largest_element": 1.2}


def test_a_wrong_mesh_option_is_bad_input(workflow: Any) -> None:
    outcome = run("a.yaml", "--mesh", "refine=0", "--mesh", "largest_element=2 kg")
    assert (outcome.exit_code, workflow.solved, workflow.written) == (2, [], [])
    second, first = outcome.stderr.splitlines()  # in the order of the fields
    assert first == "--mesh: refine: found 0; allowed: 1 or more"
    assert second.startswith("--mesh: largest_element: found ")


@pytest.mark.parametrize(("part", "said"), [("audit", "The audit failed"), ("rebuilt", "does not come back")])
def test_a_result_that_cannot_be_trusted_is_not_written(workflow: Any, part: str, said: str) -> None:
    finding = "height off by 0.45 mm at dropper 11"
    distrust = (
        {"findings": (finding,), "passed": False} if part == "audit" else {"findings": lambda: (finding,)}
    )
    getattr(workflow.result, part).__dict__.update(distrust)
    outcome = run("a.yaml")
    assert (outcome.exit_code, workflow.written) == (1, [])
    assert finding in outcome.stderr.splitlines()
    assert said in outcome.stderr
    assert outcome.stderr.endswith("so nothing was written.\n")


def test_a_long_schedule_is_cut_short(workflow: Any) -> None:
    workflow.result.droppers.__dict__.update(_many(70))
    outcome = run("a.yaml").stdout
    assert "... and 46 more in droppers.csv" in outcome
    assert "more in droppers.csv" not in _short(workflow)


def _many(n: int) -> dict[str, Any]:
    from numpy import arange

    names = ("x", "span", "number", "length", "cut_length", "force_bottom", "height_error", "force_error")
    return {name: 1.0 + arange(n) for name in names}


def _short(workflow: Any) -> str:
    workflow.result.droppers.__dict__.update(_many(24))
    return run("b.yaml").stdout


FAULTS = LineFileError(
    (Fault("a.yaml", 3, 5, "gravity", "'x'", "a number"), Fault("a.yaml", 9, 1, "span", "1", "2"))
)


@pytest.mark.parametrize(
    ("failure", "code", "lines"),
    [
        (
            FAULTS,
            2,
            ["a.yaml:3:5: gravity: found 'x'; allowed: a number", "a.yaml:9:1: span: found 1; allowed: 2"],
        ),
        (UnsupportedError("a.yaml:1:1: a curved track is not solved yet"), 2, None),
        (InconsistentInputError("the start has 3 droppers, the line 21"), 2, None),
        (InfeasibleError("dropper 3 would be in compression"), 2, None),
        (NotConvergedError("the step size fell below 1e-12 s", "a larger ramp time"), 1, None),
        (CatenariaError("something foreseen"), 1, None),
    ],
)
def test_failures_become_messages_and_exit_codes(
    workflow: Any, failure: CatenariaError, code: int, lines: list[str] | None
) -> None:
    workflow.solve_failure = failure
    outcome = run("a.yaml")
    assert outcome.exit_code == code
    assert outcome.stderr.splitlines() == (lines or [str(failure)])
    assert workflow.written == []
    assert "Written to" not in outcome.stdout


def test_too_many_elements_for_the_memory_are_told(workflow: Any) -> None:
    workflow.solve_failure = MemoryError()
    outcome = run("a.yaml")
    assert (outcome.exit_code, workflow.written) == (1, [])
    assert outcome.stderr == "There is not enough memory for this. Try: fewer elements, see solver.mesh\n"


def test_an_unforeseen_error_is_not_hidden(workflow: Any) -> None:
    """Negative control of the messages above: a bug keeps its traceback."""
    workflow.solve_failure = ZeroDivisionError("bug")
    outcome = run("a.yaml")
    assert isinstance(outcome.exception, ZeroDivisionError)
    assert outcome.exit_code == 1


def test_interrupting_says_where_and_that_nothing_was_written(workflow: Any) -> None:
    workflow.solve_failure = KeyboardInterrupt()
    outcome = run("a.yaml", "--method", "dynamic")
    assert outcome.exit_code == 130
    assert outcome.stderr == (
        "Interrupted in the stage 'contact wire' at 10.0 s of simulated time. Nothing was written.\n"
    )
    assert list(Path.cwd().iterdir()) == []


def test_interrupting_before_the_first_step(workflow: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(path: Path) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("catenaria.results.load_result", interrupted)
    outcome = run("a.yaml", "--start", "before")
    assert (outcome.exit_code, workflow.solved) == (130, [])
    assert outcome.stderr == "Interrupted before the first step. Nothing was written.\n"


def test_interrupting_while_writing(workflow: Any) -> None:
    workflow.write_failure = KeyboardInterrupt()
    outcome = run("a.yaml")
    assert outcome.exit_code == 130
    assert "Interrupted while writing. results/a holds all of the new results or what it held before." in (
        outcome.stderr
    )


def test_a_folder_that_cannot_be_written(workflow: Any) -> None:
    workflow.write_failure = PermissionError(13, "Permission denied")
    outcome = run("a.yaml")
    assert outcome.exit_code == 2
    assert outcome.stderr == "results/a cannot be written: Permission denied\n"


def test_temporary_names_are_not_shown(workflow: Any) -> None:
    workflow.write_failure = OSError(28, "No space left on device", "results/.a.0123abcd.new/result.json")
    assert run("a.yaml").stderr == "results/a cannot be written: No space left on device\n"


def test_a_place_that_cannot_be_written_is_refused_before_solving(workflow: Any) -> None:
    Path("file").write_text("", encoding="utf-8")
    outcome = run("a.yaml", "--out", "file/run")
    assert (outcome.exit_code, workflow.solved) == (2, [])
    assert "file/run cannot be written: " in outcome.stderr
    assert run("a.yaml", "--out", "beside/run").exit_code == 0


def test_interrupting_a_method_without_time_says_nothing_about_time(
    workflow: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(line: Path, method: str, start: Any, progress: Any, rebuild: str, mesh: Any) -> None:
        progress(Progress("messenger wire", 2, 3, elapsed=0.1))
        progress(Progress("messenger wire", 2, 3, elapsed=20.0))
        raise KeyboardInterrupt

    monkeypatch.setattr("catenaria.workflow.solve", interrupted)
    outcome = run("a.yaml")
    assert outcome.stderr == "Interrupted in the stage 'messenger wire'. Nothing was written.\n"
    assert outcome.stdout == "Step 2 of 3: messenger wire\n"


def test_a_folder_of_somebody_else_is_refused_before_solving(workflow: Any) -> None:
    Path("mine").mkdir()
    Path("mine/letter.txt").write_text("precious", encoding="utf-8")
    outcome = run("a.yaml", "--out", "mine")
    assert (outcome.exit_code, workflow.solved) == (2, [])
    assert "mine is left as it is: letter.txt in it was not written by catenaria" in outcome.stderr


def test_a_start_that_is_no_result_is_refused(workflow: Any) -> None:
    Path("before.json").write_text("{}", encoding="utf-8")
    outcome = run("a.yaml", "--start", "before.json")
    assert (outcome.exit_code, workflow.solved) == (2, [])
    assert outcome.stderr == "before.json is not a catenaria form-finding result\n"


@pytest.mark.parametrize("arguments", [[], ["a.yaml", "b.yaml"], ["a.yaml", "--colour", "red"]])
def test_a_wrong_command_line_is_bad_input(workflow: Any, arguments: list[str]) -> None:
    outcome = run(*arguments)
    assert (outcome.exit_code, workflow.solved) == (2, [])
    assert "Usage: " in outcome.stderr


def test_wires_are_not_told_to_be_cut(workflow: Any) -> None:
    """Their length lies between the end supports: tails come on top."""
    text = run("a.yaml").stdout
    assert "Unstressed lengths are those at 15 °C." in text
    droppers, _, wires = text.partition("Wires: unstressed length between the end supports")
    assert "cut to [m]" in droppers
    assert "cut to" not in wires
    assert "length [m]" in wires
    assert "sag [mm]" in wires  # 80 columns are enough
