"""The progress display in a terminal."""

from __future__ import annotations

from io import StringIO

import pytest
from rich.console import Console

from catenaria.cli.progress import LiveDisplay, PlainDisplay, display_on
from catenaria.workflow import Progress

STEP = Progress("contact wire", 1, 3, 123.44, 1.2345, 210, 2, "height of dropper 3", 34.21, 0.84)


@pytest.fixture
def terminal() -> Console:
    return Console(force_terminal=True, file=StringIO(), width=80, color_system=None)


def shown(terminal: Console, progress: Progress | None) -> str:
    display = LiveDisplay(terminal)
    if progress is not None:
        display.update(progress)
    with terminal.capture() as capture:
        terminal.print(display)
    return capture.get()


def test_a_terminal_gets_the_live_display_and_a_file_plain_lines(terminal: Console) -> None:
    assert isinstance(display_on(terminal), LiveDisplay)
    assert isinstance(display_on(Console(file=StringIO())), PlainDisplay)


def test_a_step_is_described_in_three_lines(terminal: Console) -> None:
    first, second, third = shown(terminal, STEP).splitlines()
    assert first.rstrip().endswith("Step 1 of 3: contact wire   (0.8 s)")
    assert second.strip() == "simulated time 123.4 s, step 210 of 1.23 s, BDF order 2"
    assert third.strip() == "largest control error 34.2 dead bands (height of dropper 3)"


def test_other_stages_take_one_line(terminal: Console) -> None:
    assert "Starting" in shown(terminal, None)
    assert "Compiling kernels: on the first run only" in shown(terminal, Progress("compiling", 1, 3))
    assert len(shown(terminal, Progress("lengths", 3, 3)).splitlines()) == 1


def test_the_live_display_clears_itself_and_remembers(terminal: Console) -> None:
    display = display_on(terminal)
    with display.shown():
        display.update(STEP)
    assert display.latest == STEP
    assert isinstance(terminal.file, StringIO)
    written = terminal.file.getvalue()
    assert "Step 1 of 3: contact wire" in written
    assert written.endswith("\x1b[2K")
