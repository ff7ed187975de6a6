"""Many lines with errors of installation at rest, on several processors, the same whatever their number."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.line import Line
from catenaria.line.installation import Installation
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.errors_of_installation import error_sources
from catenaria.loading.installed import InstalledLine
from catenaria.loading.processes import deaf_start, process_pool
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

Tell = Callable[[int, int], None]  # how many samples are done, of how many

_MOST_A_TASK = 128  # samples that one task solves, after setting up the line; Ctrl-C waits for some tasks
_TASKS_A_WORKER = 8
_ADVICE = (
    "fewer workers if memory is short; in a script of your own, calls with several workers stand below "
    "`if __name__ == '__main__':`"
)


@dataclass(frozen=True)
class Task:
    """Samples `first` to `first + count - 1` of a line."""

    line: Line
    result: FormResult
    installation: Installation
    first: int
    count: int

    def run(self) -> FloatArray:
        """Return the outputs of the samples, shape (count, n_outputs); NaN where there is no rest."""
        built = BuiltLine.of(self.line, self.result)
        sources = error_sources(built, self.installation)
        installed = InstalledLine.of(built, sources)
        errors = sources.distribution.draw(self.installation.seed, self.first, self.count)
        return np.array([_outputs(installed, p) for p in errors])


def solve_samples(
    line: Line, result: FormResult, installation: Installation, samples: int, workers: int, tell: Tell
) -> FloatArray:
    """Return what is observed of all samples, shape (samples, n_outputs); NaN where there is no rest.

    Parameters
    ----------
    line, result
        The line and where it was found.
    installation : Installation
        Its errors, and the seed.
    samples : int
        How many.
    workers : int
        Number of processes; 1 stays in this one.
    tell : callable
        Is told how many samples are done, and of how many.

    Raises
    ------
    NotConvergedError
        If a process ends before its work is done.

    Notes
    -----
    Every sample starts from the line without errors and from its own random numbers, so that nothing depends
    on who computes it, or after what.
    """
    size = max(1, min(_MOST_A_TASK, -(-samples // (_TASKS_A_WORKER * workers))))
    tasks = [
        Task(line, result, installation, first, min(size, samples - first))
        for first in range(0, samples, size)
    ]
    parts: dict[int, FloatArray] = {}
    done = 0
    for first, outputs in _run(tasks, workers):
        parts[first] = outputs
        done += outputs.shape[0]
        tell(done, samples)
    return np.concatenate([parts[task.first] for task in tasks])


def _run(tasks: list[Task], workers: int) -> Iterator[tuple[int, FloatArray]]:
    """Yield the outputs of tasks as they are done."""
    if workers == 1 or len(tasks) == 1:
        yield from ((task.first, task.run()) for task in tasks)
        return
    pool = process_pool(workers)
    try:
        with deaf_start():
            waiting: dict[Future[FloatArray], int] = {pool.submit(task.run): task.first for task in tasks}
        while waiting:
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                yield waiting.pop(future), future.result()
    except BrokenProcessPool as error:
        raise NotConvergedError("A worker process has ended before its work was done", _ADVICE) from error
    finally:  # not by `with`, whose shutdown would take back that what has not begun is cancelled
        pool.shutdown(cancel_futures=True)


def _outputs(installed: InstalledLine, p: FloatArray) -> FloatArray:
    try:
        return installed.outputs(installed.rest(p), p)
    except (NotConvergedError, InfeasibleError):
        return np.full(installed.count, np.nan)
