"""How many points of a study are done: a bar in a terminal, a line now and then elsewhere."""

from __future__ import annotations

import time
from collections.abc import Callable, Generator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.status import Status

_PLAIN_INTERVAL = 10.0  # seconds of wall time between two lines when there is no terminal


@contextmanager
def points_shown(console: Console) -> Generator[Callable[[str, int, int], None], None, None]:
    """Yield what is to be told the name of a part, how many points are done, and of how many."""
    if not console.is_terminal:
        yield _Lines(console)
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("Bringing the line to rest", total=None)
        yield lambda part, done, of: bar.update(task, description=part.capitalize(), completed=done, total=of)


def elasticity_told(status: Status, doing: str) -> Callable[[str, int, int], None]:
    """Return what makes a status say how far the elasticity of a report is."""
    return lambda part, done, of: status.update(f"{doing}: elasticity, {part}, {done} of {of} points")


class _Lines:
    """Prints a line now and then."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._printed_at = time.perf_counter()

    def __call__(self, part: str, done: int, of: int) -> None:
        if time.perf_counter() - self._printed_at >= _PLAIN_INTERVAL:
            self._console.print(f"{part.capitalize()}: {done} of {of} points", soft_wrap=True)
            self._printed_at = time.perf_counter()
