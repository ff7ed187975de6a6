"""Many lines at once: solved in parallel, each into a folder of its own, with a table of all."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.mechanics.kernels.warm_up import need_compiling, warm_up
from catenaria.results import clear_interrupted
from catenaria.workflow.batch_files import LineFile, find_files
from catenaria.workflow.batch_line import Job, Options, run_job
from catenaria.workflow.batch_table import BatchSummary, Row, require_table_replaceable, write_table
from catenaria.workflow.cluster import Cluster, Failed, local_cluster, remote_cluster
from catenaria.workflow.solve import Rebuild, refuse_choice

_WINDOW = 4  # jobs handed out for each thread of the workers
_TABLE_INTERVAL = 10.0  # s between two writings of the table


@dataclass(frozen=True)
class BatchProgress:
    """How far a batch is.

    Attributes
    ----------
    stage : {"compiling", "starting", "solving"}
        Kernels are compiled on the first run only; then workers start.
    total, done, failed, reused : int
        Lines in all; done, those done by an earlier run included; failed or with bad input; done earlier.
    elapsed : float
        Wall time since the first line was handed out [s].
    row : Row or None
        The latest outcome.
    """

    stage: str
    total: int
    done: int = 0
    failed: int = 0
    reused: int = 0
    elapsed: float = 0.0
    row: Row | None = None

    @property
    def remaining(self) -> int:
        """How many lines have no outcome yet."""
        return self.total - self.done - self.failed

    @property
    def rate(self) -> float:
        """Lines solved per second by this run."""
        return (self.done + self.failed - self.reused) / self.elapsed if self.elapsed else 0.0

    @property
    def time_left(self) -> float | None:
        """Estimated wall time until the end [s]; None while nothing has been solved."""
        return self.remaining / self.rate if self.rate else None


Tell = Callable[[BatchProgress], None]


def solve_many(
    files: Sequence[str | os.PathLike[str]],
    out: str | os.PathLike[str],
    method: str = "direct",
    rebuild: Rebuild = "static",
    workers: int | None = None,
    scheduler: str | None = None,
    fresh: bool = False,
    figures: bool = False,
    progress: Tell | None = None,
) -> BatchSummary:
    """Solve many lines in parallel and write each to a folder of its own.

    Parameters
    ----------
    files : sequence of path
        Line files, folders with line files, or glob patterns.
    out : path
        Folder for the results, which mirrors the folders of the files, and for the table ``batch.csv``.
    method, rebuild : str
        As in `solve`.
    workers : int, optional
        Worker processes on this computer; one for each processor if left out.
    scheduler : str, optional
        Address of a running Dask scheduler whose workers are to be used instead. They must see files and
        results under the same paths.
    fresh : bool
        Solve lines again that an earlier run has done with the same file, options and version.
    figures : bool
        Whether to draw figures of each line.
    progress : callable, optional
        Receives a `BatchProgress` after every line.

    Returns
    -------
    BatchSummary
        With a row for every line. A line that fails does not stop the others.

    Raises
    ------
    InconsistentInputError
        If there is no such file, `out` is not usable, or the scheduler does not answer.
    UnsupportedError
        If the method does not exist, or Dask is not installed.
    NotConvergedError
        If the cluster is lost meanwhile; `partial` is the summary until then.

    Notes
    -----
    Workers write results and return a row each, and lines are handed out in a sliding window, so that memory
    does not grow with the number of lines beyond their names and rows. Where processes are started by
    spawning, as here, a script must call this below ``if __name__ == "__main__":``.
    """
    begin = perf_counter()
    refuse_choice(method, rebuild)
    if scheduler is not None and workers is not None:
        raise InconsistentInputError("a scheduler has its own workers: give one of the two, not both")
    lines = find_files(files, out)
    folder = require_table_replaceable(out)
    jobs = [Job(line, Options(method, rebuild, figures), fresh) for line in lines]
    ledger = _Ledger(lines, folder, progress)
    _clear(lines)
    try:
        with _cluster(workers, scheduler, folder, ledger) as cluster:
            try:
                for row in _outcomes(cluster, jobs):
                    ledger.enter(row)
            finally:
                write_table(ledger.rows(), folder)
    except NotConvergedError as error:
        raise NotConvergedError(error.reason, error.advice, ledger.summary(begin)) from error
    finally:
        if scheduler is None:  # its workers are gone
            _clear(lines)
    return ledger.summary(begin)


def _clear(lines: Iterable[LineFile]) -> None:
    """Remove what killed workers have left half done."""
    for parent in {line.folder.parent for line in lines}:
        clear_interrupted(parent)


@contextmanager
def _cluster(
    workers: int | None, scheduler: str | None, folder: Path, ledger: _Ledger
) -> Generator[Cluster[Job, Row]]:
    if scheduler is None:
        if need_compiling():
            ledger.tell("compiling")
            warm_up()  # once, not in every worker
        ledger.tell("starting")
        with local_cluster(run_job, workers) as cluster:
            yield cluster
        return
    ledger.tell("starting")
    shared = folder / f".{secrets.token_hex(4)}.shared"
    try:
        shared.touch()
        with remote_cluster(run_job, scheduler, shared) as cluster:
            shared.unlink()
            yield cluster
    finally:
        shared.unlink(missing_ok=True)


def _outcomes(cluster: Cluster[Job, Row], jobs: Iterable[Job]) -> Iterator[Row]:
    """Yield rows as they come; jobs whose worker died once more, one at a time.

    With a worker dies every job that was handed to it, and which one was to blame is not known.
    """
    suspects: list[Job] = []
    for job, outcome in cluster.each(jobs, _WINDOW):
        if isinstance(outcome, Failed) and outcome.died:
            suspects.append(job)
        else:
            yield _row(job, outcome)
    for job, outcome in cluster.each(suspects, 0):
        yield _row(job, outcome)


def _row(job: Job, outcome: Row | Failed) -> Row:
    return Row("", job.line.name, "failed", outcome.why) if isinstance(outcome, Failed) else outcome


class _Ledger:
    """Rows as they come, the table on disk, and what is told of them."""

    def __init__(self, lines: Sequence[LineFile], folder: Path, tell: Tell | None) -> None:
        self._rows = {line.name: Row("", line.name, "not run") for line in lines}
        self._folder = folder
        self._tell = tell
        self._latest = BatchProgress("solving", len(lines))
        self._begin = self._written = perf_counter()

    def tell(self, stage: str) -> None:
        """Tell that a stage before the solving begins."""
        if self._tell is not None:
            self._tell(BatchProgress(stage, len(self._rows)))
        self._begin = perf_counter()

    def enter(self, row: Row) -> None:
        """Take note of an outcome."""
        self._rows[row.file] = row
        done, before, now = row.status == "done", self._latest, perf_counter()
        self._latest = BatchProgress(
            "solving",
            len(self._rows),
            before.done + done,
            before.failed + (not done),
            before.reused + row.reused,
            now - self._begin,
            row,
        )
        if self._tell is not None:
            self._tell(self._latest)
        if now - self._written > _TABLE_INTERVAL:
            write_table(self.rows(), self._folder)
            self._written = now

    def rows(self) -> tuple[Row, ...]:
        """Return all rows in order of the files."""
        return tuple(self._rows.values())

    def summary(self, begin: float) -> BatchSummary:
        """Return what became of all lines since `begin`."""
        return BatchSummary(self.rows(), perf_counter() - begin, self._folder / "batch.csv")
