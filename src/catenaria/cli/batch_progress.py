"""What a user sees of a batch: a bar in a terminal, a line now and then elsewhere."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING, Protocol

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn

if TYPE_CHECKING:
    from catenaria.workflow import BatchProgress

_PLAIN_INTERVAL = 10.0  # seconds of wall time between two lines when there is no terminal
_STAGES = {
    "compiling": "Compiling kernels: on the first run only, up to a minute",
    "starting": "Starting workers",
}


class BatchDisplay(Protocol):
    """Shows how far a batch is."""

    def update(self, progress: BatchProgress) -> None:
        """Take note of progress; called after every line."""
        ...

    def shown(self) -> AbstractContextManager[object]:
        """Keep the display on the console while a block runs."""
        ...


def batch_display_on(console: Console) -> BatchDisplay:
    """Return the bar for a terminal, plain lines for anything else."""
    return BatchBar(console) if console.is_terminal else BatchLines(console)


class BatchBar:
    """A bar with counts, rate and time left."""

    def __init__(self, console: Console) -> None:
        columns = (SpinnerColumn(), BarColumn(), TextColumn("{task.description}"))
        self._bar = Progress(*columns, console=console, transient=True)
        self._task = self._bar.add_task("Starting", total=None)

    def update(self, progress: BatchProgress) -> None:
        """Move the bar."""
        total = progress.total if progress.stage == "solving" else None
        ended = progress.total - progress.remaining
        self._bar.update(self._task, description=batch_text(progress), total=total, completed=ended)

    def shown(self) -> AbstractContextManager[object]:
        """Draw until the block ends, then clear."""
        return self._bar


class BatchLines:
    """A line for each stage, and one now and then while lines are solved."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._printed_at = 0.0

    def update(self, progress: BatchProgress) -> None:
        """Print a line if it is time for one."""
        due = progress.elapsed >= self._printed_at + _PLAIN_INTERVAL or not progress.remaining
        if progress.stage != "solving" or due:
            self._printed_at = progress.elapsed
            self._console.print(batch_text(progress), soft_wrap=True)

    def shown(self) -> AbstractContextManager[object]:
        """Do nothing: printed lines stay."""
        return nullcontext()


def batch_text(progress: BatchProgress) -> str:
    """Say how far a batch is, in one line."""
    if progress.stage != "solving":
        return _STAGES[progress.stage]
    parts = [f"{progress.done} done", f"{progress.failed} failed", f"{progress.remaining} remaining"]
    if progress.reused:
        parts.insert(1, f"{progress.reused} of them before")
    if progress.time_left is not None:
        minutes, seconds = divmod(round(progress.time_left), 60)
        parts += [f"{progress.rate:.2f} lines/s", f"{minutes}:{seconds:02d} left"]
    return ", ".join(parts)
