"""One line of a batch, from its file to its folder: what runs in a worker."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from catenaria import __version__
from catenaria.errors import (
    CatenariaError,
    InconsistentInputError,
    InfeasibleError,
    LineFileError,
    UnsupportedError,
)
from catenaria.results import FormResult, is_intact, replace_folder, require_replaceable
from catenaria.results.audit import ratio
from catenaria.results.store import VERSION
from catenaria.workflow.batch_files import LineFile
from catenaria.workflow.batch_table import Row, Status
from catenaria.workflow.solve import Rebuild, solve
from catenaria.workflow.write import fill

RECORD_NAME = "batch.json"
_BAD_INPUT = (LineFileError, InconsistentInputError, InfeasibleError, UnsupportedError)


@dataclass(frozen=True)
class Options:
    """How all lines of a batch are solved; parameters as in `solve`."""

    method: str
    rebuild: Rebuild
    figures: bool


@dataclass(frozen=True)
class Job:
    """One line of a batch.

    Attributes
    ----------
    line : LineFile
        The file, and where its results go.
    options : Options
        How it is solved.
    fresh : bool
        Whether it is solved even if it has been done.
    """

    line: LineFile
    options: Options
    fresh: bool


def run_job(job: Job) -> Row:
    """Solve a line and write its folder, unless that has been done.

    Parameters
    ----------
    job : Job
        The line and how it is solved.

    Returns
    -------
    Row
        Failures that are known by name are told in it; results exist on disk only if it says ``done``.
    """
    begin = perf_counter()
    try:
        mark = fingerprint(job.line.file, job.options)
        earlier = None if job.fresh else _done_before(job.line, mark)
        return earlier or _solved(job, mark, begin)
    except _BAD_INPUT as error:
        return _not_done(job, "bad input", str(error), begin)
    except CatenariaError as error:
        return _not_done(job, "failed", str(error), begin)
    except MemoryError:
        return _not_done(job, "failed", "there is not enough memory", begin)
    except OSError as error:
        return _not_done(job, "failed", f"{error.filename}: {error.strerror}", begin)


def fingerprint(file: Path, options: Options) -> str:
    """Return a text that changes when a line would have to be solved again.

    Parameters
    ----------
    file : Path
        The line file, of which every byte counts.
    options : Options
        How it is solved. The versions of catenaria and of its result files count too.
    """
    content = hashlib.sha256(file.read_bytes()).hexdigest()
    known = {"file": content, "options": asdict(options), "catenaria": __version__, "format": VERSION}
    return hashlib.sha256(json.dumps(known, sort_keys=True).encode()).hexdigest()


def _done_before(line: LineFile, mark: str) -> Row | None:
    """Return the row of a line that is done, its folder complete and unchanged."""
    if not is_intact(line.folder):
        return None
    try:
        record: Any = json.loads((line.folder / RECORD_NAME).read_bytes())
    except (OSError, ValueError):  # written by `catenaria solve`
        return None
    if record["fingerprint"] != mark:
        return None
    return replace(Row(**record["row"]), file=line.name, folder=line.place, reused=True)


def _solved(job: Job, mark: str, begin: float) -> Row:
    require_replaceable(job.line.folder)
    result = solve(job.line.file, method=job.options.method, rebuild=job.options.rebuild)
    findings = (*result.audit.findings, *result.rebuilt.findings())
    if findings:
        row = _row(job.line, result, "failed", "; ".join(findings) + _warning(job.line))
        return replace(row, wall_time_s=perf_counter() - begin)
    with replace_folder(job.line.folder) as new:
        fill(result, new, job.options.figures)
        row = replace(_row(job.line, result, "done"), wall_time_s=perf_counter() - begin)
        record = json.dumps({"fingerprint": mark, "row": asdict(row)}, indent=1, allow_nan=False)
        (new / RECORD_NAME).write_text(record + "\n", encoding="utf-8")
    return row


def _row(line: LineFile, result: FormResult, status: Status, why: str = "") -> Row:
    audit, droppers = result.audit, result.droppers
    lengths = [float(span["length"]) for span in result.inputs["spans"]]
    return Row(
        name=result.name,
        file=line.name,
        status=status,
        why=why,
        residual=float(ratio(audit.deviation, audit.allowed).max(initial=0.0)),
        iterations=sum(work.steps for work in result.counters),
        spans=len(lengths),
        droppers=droppers.x.size,
        length_m=sum(lengths),
        dropper_force_min_N=float(droppers.force_bottom.min()) if droppers.x.size else None,
        height_error_max_m=float(np.abs(droppers.height_error).max(initial=0.0)),
        folder=line.place if status == "done" else "",
    )


def _not_done(job: Job, status: Status, why: str, begin: float) -> Row:
    text = "; ".join(why.splitlines()) + _warning(job.line)
    return Row("", job.line.name, status, text, wall_time_s=perf_counter() - begin)


def _warning(line: LineFile) -> str:
    """Say that what stands in the folder does not belong to this row."""
    return f" ({line.place} holds an earlier result)" if line.folder.exists() else ""
