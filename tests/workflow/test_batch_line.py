"""One line of a batch: what is solved, what is solved again, and what is told of what fails."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.results import FormResult, is_intact, load_result
from catenaria.workflow import batch_line
from catenaria.workflow.batch_files import LineFile
from catenaria.workflow.batch_line import Job, Options, fingerprint, run_job

OPTIONS = Options("direct", "static", figures=False)


@pytest.fixture
def job(small_file: Path, tmp_path: Path) -> Job:
    file = tmp_path / "small.json"
    file.write_bytes(small_file.read_bytes())
    return Job(LineFile(file, "small.json", tmp_path / "out", "small"), OPTIONS, fresh=False)


@pytest.fixture
def count(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Count the lines that are solved."""
    solved: list[Path] = []
    solve: Callable[..., FormResult] = batch_line.solve

    def counted(line: Path, method: str, rebuild: Any) -> FormResult:
        solved.append(line)
        return solve(line, method=method, rebuild=rebuild)

    monkeypatch.setattr(batch_line, "solve", counted)
    return solved


def test_a_line_is_solved_and_told(job: Job, small_result: FormResult) -> None:
    row = run_job(job)
    assert (row.status, row.why, row.reused, row.file, row.folder) == (
        "done",
        "",
        False,
        "small.json",
        "small",
    )
    assert (row.spans, row.droppers, row.length_m) == (1, 2, 20.0)
    assert row.residual is not None
    assert 0.0 < row.residual <= 1.0
    assert row.dropper_force_min_N == pytest.approx(small_result.droppers.force_bottom.min())
    assert row.iterations == sum(work.steps for work in small_result.counters)
    found = load_result(job.line.folder)
    np.testing.assert_allclose(found.droppers.length, small_result.droppers.length, atol=1e-12)
    assert is_intact(job.line.folder)


def test_a_line_that_is_done_is_not_solved_again(job: Job, count: list[Path]) -> None:
    first = run_job(job)
    before = (job.line.folder / "result.npz").stat().st_mtime_ns
    again = run_job(job)
    assert again == replace(first, reused=True)
    assert len(count) == 1
    assert (job.line.folder / "result.npz").stat().st_mtime_ns == before


def another_file(job: Job) -> Job:
    text = job.line.file.read_text(encoding="utf-8")
    job.line.file.write_text(text + "\n", encoding="utf-8")
    return job


def damaged(job: Job) -> Job:
    (job.line.folder / "result.npz").unlink()
    return job


def another_version(job: Job) -> Job:
    record = job.line.folder / "batch.json"
    manifest = job.line.folder / "manifest.json"
    record.unlink()
    stated = json.loads(manifest.read_text(encoding="utf-8"))
    del stated["files"]["batch.json"]
    manifest.write_text(json.dumps(stated), encoding="utf-8")
    return job


@pytest.mark.parametrize(
    "change",
    [
        another_file,
        damaged,
        another_version,
        lambda job: replace(job, fresh=True),
        lambda job: replace(job, options=Options("direct", "none", figures=False)),
    ],
    ids=["file", "damaged", "without record", "fresh", "options"],
)
def test_what_changed_is_solved_again(job: Job, count: list[Path], change: Callable[[Job], Job]) -> None:
    run_job(job)
    row = run_job(change(job))
    assert (row.status, row.reused, len(count)) == ("done", False, 2)
    assert is_intact(job.line.folder)


def test_the_fingerprint_depends_on_file_options_and_version(
    job: Job, monkeypatch: pytest.MonkeyPatch
) -> None:
    marks = {fingerprint(job.line.file, OPTIONS), fingerprint(job.line.file, replace(OPTIONS, figures=True))}
    monkeypatch.setattr(batch_line, "__version__", "another")
    marks.add(fingerprint(job.line.file, OPTIONS))
    marks.add(fingerprint(another_file(job).line.file, OPTIONS))
    assert len(marks) == 4


def test_bad_input_is_told_in_one_line(job: Job) -> None:
    job.line.file.write_text('{"format": 2, "spans": 3}', encoding="utf-8")
    row = run_job(job)
    assert row.status == "bad input"
    assert "format: found 2; allowed: 1; " in row.why
    assert not job.line.folder.exists()


def test_a_missing_file_is_told(job: Job) -> None:
    job.line.file.unlink()
    row = run_job(job)
    assert (row.status, row.why) == ("failed", f"{job.line.file}: No such file or directory")


def test_a_failure_leaves_the_earlier_result_and_says_so(job: Job, monkeypatch: pytest.MonkeyPatch) -> None:
    run_job(job)

    def fail(line: Path, method: str, rebuild: Any) -> FormResult:
        raise NotConvergedError("no rest", "something else")

    monkeypatch.setattr(batch_line, "solve", fail)
    row = run_job(replace(job, fresh=True))
    assert row.status == "failed"
    assert row.why == "no rest. Try: something else (small holds an earlier result)"
    assert is_intact(job.line.folder)


def test_a_result_that_fails_its_audit_is_not_written(
    job: Job, small_result: FormResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    distrusted = replace(small_result, audit=replace(small_result.audit, findings=("a wire is off",)))
    monkeypatch.setattr(batch_line, "solve", lambda line, method, rebuild: distrusted)
    row = run_job(job)
    assert (row.status, row.why, row.folder) == ("failed", "a wire is off", "")
    assert not job.line.folder.exists()


def test_files_of_others_are_not_replaced(job: Job, count: list[Path]) -> None:
    job.line.folder.mkdir(parents=True)
    (job.line.folder / "notes.txt").write_text("mine", encoding="utf-8")
    row = run_job(job)
    assert row.status == "bad input"
    assert "notes.txt" in row.why
    assert count == []
