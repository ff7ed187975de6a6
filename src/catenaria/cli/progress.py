"""What a user sees while a line is being solved: a live display in a terminal, a few lines elsewhere."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING, Protocol

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.spinner import Spinner
from rich.text import Text

if TYPE_CHECKING:
    from catenaria.workflow import Progress

_REFRESH = 8  # per second
_PLAIN_INTERVAL = 10.0  # seconds of wall time between two lines when there is no terminal


class Display(Protocol):
    """Shows progress and remembers the latest."""

    latest: Progress | None

    def update(self, progress: Progress) -> None:
        """Take note of progress; called at every time step, so it must be cheap."""
        ...

    def shown(self) -> AbstractContextManager[object]:
        """Keep the display on the console while a block runs."""
        ...


def display_on(console: Console) -> Display:
    """Return the live display for a terminal, plain lines for anything else."""
    return LiveDisplay(console) if console.is_terminal else PlainDisplay(console)


class LiveDisplay:
    """Three lines that rich draws again several times a second."""

    def __init__(self, console: Console) -> None:
        self.latest: Progress | None = None
        self._console = console
        self._spinner = Spinner("dots")

    def update(self, progress: Progress) -> None:
        """Take note of progress; the refresh thread draws it."""
        self.latest = progress

    def shown(self) -> AbstractContextManager[object]:
        """Draw until the block ends, then clear."""
        return Live(self, console=self._console, refresh_per_second=_REFRESH, transient=True)

    def __rich__(self) -> RenderableType:
        """Draw the latest progress."""
        progress = self.latest
        if progress is None:
            self._spinner.update(text="Starting")
            return self._spinner
        self._spinner.update(text=f"{headline(progress)}   ({progress.elapsed:.1f} s)")
        details = (Text(f"  {detail}", overflow="ellipsis", no_wrap=True) for detail in details_of(progress))
        return Group(self._spinner, *details)


class PlainDisplay:
    """A line for each stage, and one now and then within a stage."""

    def __init__(self, console: Console) -> None:
        self.latest: Progress | None = None
        self._console = console
        self._printed_at = 0.0

    def update(self, progress: Progress) -> None:
        """Print a line if the stage is a new one or the last line is long ago."""
        previous, self.latest = self.latest, progress
        if previous is None or previous.stage != progress.stage:
            self._console.print(headline(progress), soft_wrap=True)
            self._printed_at = progress.elapsed
        elif progress.elapsed >= self._printed_at + _PLAIN_INTERVAL and (details := details_of(progress)):
            self._console.print("  " + "; ".join(details), soft_wrap=True)
            self._printed_at = progress.elapsed

    def shown(self) -> AbstractContextManager[object]:
        """Do nothing: printed lines stay."""
        return nullcontext()


def headline(progress: Progress) -> str:
    """Say which stage is running."""
    if progress.stage == "compiling":
        return "Compiling kernels: on the first run only, up to a minute"
    if progress.stage == "rebuild":
        return "Rebuilding the line from the found lengths"
    return f"Step {progress.stage_number} of {progress.stage_count}: {progress.stage}"


def details_of(progress: Progress) -> list[str]:
    """Say how far a stage is, in two lines; a stage that does not integrate has none."""
    if not progress.worst_control:
        return []
    return [
        f"simulated time {progress.time:.1f} s, step {progress.step} of {progress.step_size:.3g} s, "
        f"BDF order {progress.order}",
        f"largest control error {progress.worst_error_in_bands:.3g} dead bands ({progress.worst_control})",
    ]
