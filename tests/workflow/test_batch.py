"""Batches as users run them: in parallel, interrupted, killed, taken up again, on a cluster."""

from __future__ import annotations

import csv
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import psutil
import pytest

import catenaria
from catenaria.errors import InconsistentInputError, NotConvergedError, UnsupportedError
from catenaria.results import FormResult, load_result
from catenaria.workflow import BatchProgress, Row, batch, cluster, solve, solve_many, write_network
from catenaria.workflow.batch_line import Job

pytestmark = pytest.mark.slow

Process = subprocess.Popen[str]
Start = Callable[..., Process]
Folder = Callable[..., Path]

TIMEOUT = 180.0  # s; most of it is for compiling on a machine that never did
SOURCE = str(Path(catenaria.__file__).parents[1])


@pytest.fixture
def lines(small_file: Path, example: Path, tmp_path: Path) -> Folder:
    """Return a folder with some copies of a line; the larger ones take longer."""

    def made(count: int, large: bool = False) -> Path:
        folder = tmp_path / "lines"
        folder.mkdir()
        file = example if large else small_file
        for number in range(count):
            (folder / f"{number:02d}{file.suffix}").write_bytes(file.read_bytes())
        return folder

    return made


def table(out: Path) -> list[dict[str, str]]:
    with (out / "batch.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def complete(out: Path) -> set[str]:
    """Names of result folders; a hidden one is a half that a killed worker left."""
    names = {path.parent.name for path in out.glob("*/result.json")}
    return {name for name in names if not name.startswith(".")}


def hidden(out: Path) -> list[Path]:
    return [path for path in out.rglob("*") if path.name.startswith(".")]


def run(command: Start, *arguments: object) -> tuple[int, str, str]:
    process = command("batch", *arguments)
    out, err = process.communicate(timeout=TIMEOUT)
    return process.returncode, out, err


def test_one_bad_line_does_not_stop_the_others(
    lines: Folder, tmp_path: Path, small_result: FormResult
) -> None:
    folder, out = lines(9), tmp_path / "out"
    (folder / "03.json").write_text('{"format": 1}', encoding="utf-8")
    told: list[BatchProgress] = []
    summary = solve_many([folder], out, workers=2, progress=told.append)
    assert [row.status for row in summary.rows] == [*["done"] * 3, "bad input", *["done"] * 5]
    assert [row.file for row in summary.rows] == [f"{number:02d}.json" for number in range(9)]
    assert "contact_wire" in summary.rows[3].why
    assert [row["status"] for row in table(out)] == [row.status for row in summary.rows]
    found = load_result(out / "08")
    np.testing.assert_allclose(found.droppers.length, small_result.droppers.length, atol=1e-12)
    assert (told[-1].done, told[-1].failed, told[-1].remaining) == (8, 1, 0)
    assert [progress.done + progress.failed for progress in told[-9:]] == list(range(1, 10))
    assert hidden(out) == []


def test_a_line_that_kills_its_worker_fails_and_the_others_do_not(
    lines: Folder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def deadly(job: Job) -> Row:
        import os

        from catenaria.workflow.batch_line import run_job

        return os._exit(1) if job.line.name == "05.json" else run_job(job)

    monkeypatch.setattr(batch, "run_job", deadly)
    summary = solve_many([lines(12)], tmp_path / "out", workers=2)
    assert summary.rows[5].why == "its worker process died: out of memory, or killed"
    assert (summary.count("done"), summary.count("failed")) == (11, 1)
    assert len(complete(tmp_path / "out")) == 11


def test_a_worker_that_is_killed_costs_no_line(lines: Folder, tmp_path: Path) -> None:
    def kill(progress: BatchProgress) -> None:
        if progress.done == 3:
            workers = [
                each for each in psutil.Process().children() if "spawn_main" in " ".join(each.cmdline())
            ]
            workers[0].kill()

    summary = solve_many([lines(20, large=True)], tmp_path / "out", workers=2, progress=kill)
    assert [row.why for row in summary.rows if row.status != "done"] == []
    assert hidden(tmp_path / "out") == []


def test_lines_that_are_done_are_not_solved_again(command: Start, lines: Folder, tmp_path: Path) -> None:
    folder, out = lines(4), tmp_path / "out"
    code, said, err = run(command, folder, "--out", out, "--workers", 2)
    assert (code, err) == (0, "")
    assert "4 of 4 lines done, 0 failed, 0 with bad input; 0 had been done before" in said
    before = {path: path.stat().st_mtime_ns for path in out.glob("*/result.npz")}
    (folder / "02.json").write_text((folder / "02.json").read_text(encoding="utf-8") + "\n", encoding="utf-8")
    code, said, err = run(command, folder, "--out", out, "--workers", 2)
    assert (code, err) == (0, "")
    assert "4 of 4 lines done, 0 failed, 0 with bad input; 3 had been done before" in said
    changed = {path.parent.name for path, then in before.items() if path.stat().st_mtime_ns != then}
    assert changed == {"02"}
    assert [row["reused"] for row in table(out)] == ["yes", "yes", "no", "yes"]


def test_a_batch_that_was_killed_goes_on_where_it_was(command: Start, lines: Folder, tmp_path: Path) -> None:
    folder, out = lines(40, large=True), tmp_path / "out"
    process = command("batch", folder, "--out", out, "--workers", 2)
    processes = _wait_for(out, 3, process)
    process.kill()
    process.communicate(timeout=TIMEOUT)
    _, alive = psutil.wait_procs(processes, timeout=20.0)
    assert alive == []
    done = complete(out)
    assert 3 <= len(done) < 40
    half = out / ".39.0123abcd.new"
    half.mkdir()
    (half / "result.json").write_text("{", encoding="utf-8")
    before = {name: (out / name / "result.npz").stat().st_mtime_ns for name in done}

    code, said, err = run(command, folder, "--out", out, "--workers", 2)
    assert (code, err) == (0, "")
    assert f"40 of 40 lines done, 0 failed, 0 with bad input; {len(done)} had been done before" in said
    assert {name: (out / name / "result.npz").stat().st_mtime_ns for name in done} == before
    assert len(complete(out)) == 40
    assert hidden(out) == []
    assert load_result(out / "39").droppers.x.size == 21


def test_ctrl_c_leaves_whole_results_and_a_whole_table(command: Start, lines: Folder, tmp_path: Path) -> None:
    folder, out = lines(40, large=True), tmp_path / "out"
    process = command("batch", folder, "--out", out, "--workers", 2)
    processes = _wait_for(out, 3, process)
    for each in (process.pid, *(child.pid for child in processes)):  # a terminal tells all of them
        os.kill(each, signal.SIGINT)
    _, err = process.communicate(timeout=TIMEOUT)
    assert process.returncode == 130
    assert err == f"Interrupted. Results so far are in {out}; the same command goes on from there.\n"
    rows = table(out)
    told = {row["folder"] for row in rows if row["status"] == "done"}
    assert len(rows) == 40
    assert {row["status"] for row in rows} == {"done", "not run"}
    assert 1 <= len(told) <= len(complete(out)) < 40  # what a worker has just done may not be told yet
    assert told <= complete(out)
    assert hidden(out) == []


def _wait_for(out: Path, count: int, process: Process) -> list[psutil.Process]:
    """Wait until some lines are done; return the processes that the command has started."""
    end = time.perf_counter() + TIMEOUT
    while len(complete(out)) < count:
        assert process.poll() is None
        assert time.perf_counter() < end
        time.sleep(0.02)
    return psutil.Process(process.pid).children(recursive=True)


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Start parts of a Dask cluster, which end with the test."""
    environment = os.environ | {"PYTHONPATH": SOURCE}
    with ExitStack() as stack:

        def started(*arguments: str) -> Process:
            process = subprocess.Popen(
                [sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:]],
                cwd=tmp_path,
                env=environment,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            )
            stack.callback(_end, process)
            return process

        yield started


def _end(process: Process) -> None:
    process.kill()
    process.communicate()


@pytest.fixture
def scheduler(start: Start) -> str:
    """Start a scheduler and return its address."""
    process = start(
        "dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--dashboard-address", "127.0.0.1:0"
    )
    assert process.stderr is not None
    for line in process.stderr:
        if found := re.search(r"Scheduler at: +(tcp://[\d.:]+)", line):
            return found[1]
    raise AssertionError("the scheduler has not started")


def test_a_cluster_of_two_workers(scheduler: str, start: Start, lines: Folder, tmp_path: Path) -> None:
    for _ in range(2):
        start("dask_worker", scheduler, "--nthreads", "1", "--host", "127.0.0.1")
    folder, out = lines(12), tmp_path / "out"
    (folder / "03.json").write_text('{"format": 1}', encoding="utf-8")
    summary = solve_many([folder], out, scheduler=scheduler)
    assert (summary.count("done"), summary.count("bad input")) == (11, 1)
    assert len(complete(out)) == 11
    assert hidden(out) == []
    assert solve_many([folder], out, scheduler=scheduler).reused == 11


def test_a_cluster_without_workers_is_refused(
    scheduler: str, lines: Folder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster, "CONNECT", 2.0)
    with pytest.raises(InconsistentInputError, match=r"has no workers\. Try: dask worker tcp://"):
        solve_many([lines(1)], tmp_path / "out", scheduler=scheduler)
    assert list((tmp_path / "out").iterdir()) == []


@pytest.mark.parametrize("loses", ["workers", "scheduler"])
def test_a_cluster_that_is_lost_keeps_what_is_done(
    start: Start,
    lines: Folder,
    tmp_path: Path,
    loses: str,
    monkeypatch: pytest.MonkeyPatch,
    request: pytest.FixtureRequest,
) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 2.0)
    folder, out = lines(40, large=True), tmp_path / "out"
    address: str = request.getfixturevalue("scheduler")
    worker = start("dask_worker", address, "--nthreads", "1", "--host", "127.0.0.1", "--no-nanny")

    def lose(progress: BatchProgress) -> None:
        if progress.done == 3:
            ending = psutil.Process().children() if loses == "scheduler" else [psutil.Process(worker.pid)]
            for process in ending:
                process.kill()

    with pytest.raises(NotConvergedError, match=r"scheduler|no workers") as caught:
        solve_many([folder], out, scheduler=address, progress=lose)
    summary = caught.value.partial
    assert summary.count("done") >= 3  # type: ignore[union-attr]
    assert [row["status"] for row in table(out)].count("done") >= 3
    assert len(complete(out)) < 40


def test_an_unreachable_scheduler_is_bad_input_at_once(command: Start, lines: Folder, tmp_path: Path) -> None:
    folder, out = lines(2), tmp_path / "out"
    assert run(command, folder, "--out", out, "--workers", 1)[0] == 0
    begin = time.perf_counter()
    code, _, err = run(command, folder, "--out", out, "--scheduler", "tcp://127.0.0.1:1", "--fresh")
    assert time.perf_counter() - begin < 30.0  # of which 5 s are for the connection
    assert code == 2
    assert err.startswith("the scheduler tcp://127.0.0.1:1 does not answer: ")
    assert len(err.splitlines()) == 1
    assert complete(out) == {"00", "01"}
    assert [row["status"] for row in table(out)] == ["done", "done"]


def test_bad_arguments_are_refused_before_anything_starts(lines: Folder, tmp_path: Path) -> None:
    folder, out = lines(1), tmp_path / "out"
    with pytest.raises(InconsistentInputError, match="there is no such line file"):
        solve_many([folder / "*.yaml"], out)
    with pytest.raises(UnsupportedError, match="there is no method 'best'"):
        solve_many([folder], out, method="best")
    with pytest.raises(InconsistentInputError, match="not both"):
        solve_many([folder], out, workers=1, scheduler="tcp://127.0.0.1:1")
    assert not out.exists()


def test_a_network_is_written_whole_and_each_kind_solves(tmp_path: Path) -> None:
    files = write_network(8, 2, tmp_path / "network")
    assert [file.name for file in files] == [f"line_{number:04d}.yaml" for number in range(1, 9)]
    kinds: set[str] = set()
    for file in files:
        kind = re.search(r"name: line \d, (\w+)", file.read_text(encoding="utf-8"))
        assert kind is not None
        if kind[1] in kinds:
            continue
        kinds.add(kind[1])
        result = solve(file)
        assert (result.audit.findings, result.rebuilt.findings()) == ((), ())
        assert not result.droppers.slack.any()
        assert result.arms.radial.min() > 80.0
    assert kinds == {"simple", "stitched", "curved"}
    again = write_network(8, 2, tmp_path / "again")
    assert [file.read_bytes() for file in again] == [file.read_bytes() for file in files]
