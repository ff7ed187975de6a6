"""`catenaria batch` and `catenaria network`: arguments, progress, exit codes and messages."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console
from typer.testing import CliRunner

from catenaria.cli.batch_progress import BatchBar, batch_display_on, batch_text
from catenaria.cli.main import app
from catenaria.errors import InconsistentInputError, NotConvergedError, UnsupportedError
from catenaria.workflow import BatchProgress, BatchSummary, Row

DEFAULTS = {
    "method": "direct",
    "rebuild": "static",
    "workers": None,
    "scheduler": None,
    "fresh": False,
    "figures": False,
}
DONE = Row("a", "a.yaml", "done", residual=0.5, folder="a")
BAD = Row("", "b.yaml", "bad input", "spans: found 3; allowed: a list")


class Fake:
    """Records how batches were asked for, and ends as it is told."""

    def __init__(self) -> None:
        self.rows: tuple[Row, ...] = (DONE, DONE)
        self.failure: BaseException | None = None
        self.asked: list[Any] = []

    def solve_many(
        self, files: list[str], out: Path, progress: Callable[[BatchProgress], None], **options: Any
    ) -> BatchSummary:
        self.asked.append((files, out, options))
        progress(BatchProgress("starting", 2))
        for done, elapsed in ((1, 1.0), (2, 2.0)):
            progress(BatchProgress("solving", 2, done, elapsed=elapsed, row=DONE))
        if self.failure is not None:
            raise self.failure
        return BatchSummary(self.rows, 2.5, Path(out) / "batch.csv")


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch) -> Fake:
    stand_in = Fake()
    monkeypatch.setattr("catenaria.workflow.solve_many", stand_in.solve_many)
    return stand_in


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, list(arguments))


def test_a_batch_is_asked_for_and_summed_up(fake: Fake) -> None:
    outcome = run("batch", "lines", "more/*.yaml", "--out", "here")
    assert (outcome.exit_code, outcome.stderr) == (0, "")
    assert fake.asked == [(["lines", "more/*.yaml"], Path("here"), DEFAULTS)]
    for text in ("Starting workers", "2 done, 0 failed, 0 remaining", "2 of 2 lines done, 0 failed", "2.5 s"):
        assert text in outcome.stdout


def test_options_reach_the_workflow(fake: Fake) -> None:
    options = ("--method", "dynamic", "--rebuild", "none", "--workers", "3", "--fresh", "--figures")
    assert run("batch", "lines", "--out", "here", *options).exit_code == 0
    changed = {"method": "dynamic", "rebuild": "none", "workers": 3, "fresh": True, "figures": True}
    assert fake.asked[0][2] == DEFAULTS | changed
    assert run("batch", "lines", "--out", "here", "--scheduler", "tcp://h:1").exit_code == 0
    assert fake.asked[1][2] == DEFAULTS | {"scheduler": "tcp://h:1"}


def test_lines_that_are_not_done_are_told_and_fail_the_batch(fake: Fake) -> None:
    fake.rows = (DONE, BAD)
    outcome = run("batch", "lines", "--out", "here")
    assert outcome.exit_code == 1
    assert outcome.stderr == "b.yaml: bad input: spans: found 3; allowed: a list\n"
    assert "1 of 2 lines done, 0 failed, 1 with bad input" in outcome.stdout


def test_many_failures_are_told_in_short(fake: Fake) -> None:
    fake.rows = (BAD,) * 25
    told = run("batch", "lines", "--out", "here").stderr.splitlines()
    assert len(told) == 21
    assert told[-1] == "... and 5 more in here/batch.csv"


def test_what_had_been_done_before_is_told(fake: Fake) -> None:
    fake.rows = (DONE, Row("c", "c.yaml", "done", reused=True))
    said = run("batch", "lines", "--out", "here").stdout
    assert "1 had been done before and were not solved again" in said
    assert "1 lines in 2.5 s" in said


@pytest.mark.parametrize(
    ("failure", "code", "said"),
    [
        (InconsistentInputError("there is no such line file"), 2, "there is no such line file\n"),
        (UnsupportedError("batches need dask.distributed"), 2, "batches need dask.distributed\n"),
        (NotConvergedError("no workers any more", "it again"), 1, "no workers any more. Try: it again\n"),
        (
            KeyboardInterrupt(),
            130,
            "Interrupted. Results so far are in here; the same command goes on from there.\n",
        ),
    ],
)
def test_failures_become_messages_and_exit_codes(
    fake: Fake, failure: BaseException, code: int, said: str
) -> None:
    fake.failure = failure
    outcome = run("batch", "lines", "--out", "here")
    assert (outcome.exit_code, outcome.stderr) == (code, said)


@pytest.mark.parametrize(
    "arguments", [("lines",), ("--out", "here"), ("lines", "--out", "x", "--workers", "0")]
)
def test_wrong_arguments_are_bad_input(fake: Fake, arguments: tuple[str, ...]) -> None:
    assert run("batch", *arguments).exit_code == 2
    assert fake.asked == []


def test_progress_says_how_far_it_is() -> None:
    progress = BatchProgress("solving", 1000, done=310, failed=2, reused=12, elapsed=100.0)
    text = "310 done, 12 of them before, 2 failed, 688 remaining, 3.00 lines/s, 3:49 left"
    assert batch_text(progress) == text
    assert (
        batch_text(BatchProgress("solving", 10, done=3, reused=3))
        == "3 done, 3 of them before, 0 failed, 7 remaining"
    )
    assert batch_text(BatchProgress("compiling", 10)).startswith("Compiling kernels")


def test_a_terminal_gets_a_bar() -> None:
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=True, width=100, color_system=None)
    display = batch_display_on(console)
    assert isinstance(display, BatchBar)
    with display.shown():
        display.update(BatchProgress("starting", 4))
        display.update(BatchProgress("solving", 4, done=1, failed=1, elapsed=1.0))
    assert "1 done, 1 failed, 2 remaining, 2.00 lines/s, 0:01 left" in screen.getvalue()


def test_elsewhere_a_line_is_printed_now_and_then() -> None:
    screen = io.StringIO()
    display = batch_display_on(Console(file=screen, width=100))
    for second in range(1, 31):
        display.update(BatchProgress("solving", 30, done=second, elapsed=float(second)))
    assert [line.split()[0] for line in screen.getvalue().splitlines()] == ["10", "20", "30"]


def test_a_network_is_written(tmp_path: Path) -> None:
    outcome = run("network", "--count", "3", "--out", str(tmp_path / "network"))
    assert (outcome.exit_code, outcome.stderr) == (0, "")
    assert "3 line files" in outcome.stdout
    assert len(list((tmp_path / "network").glob("line_*.yaml"))) == 3
    checked = run("check", str(tmp_path / "network" / "line_0002.yaml"))
    assert checked.exit_code == 0


def test_a_network_does_not_replace_files_of_others(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    outcome = run("network", "--count", "3", "--out", str(tmp_path))
    assert outcome.exit_code == 2
    assert "notes.txt" in outcome.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]
