"""The example, a small line that is solved in a moment, and the command in a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import catenaria
from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.workflow import solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"

# A shell that starts a process in the background makes it deaf to Ctrl-C; this one shall hear it.
COMMAND = (
    "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
    "from catenaria.cli.main import main; main()"
)

Change = dict[str, Any]
Process = subprocess.Popen[str]


@pytest.fixture(scope="session")
def example() -> Path:
    return EXAMPLE


@pytest.fixture(scope="session")
def vary() -> Callable[[Change], Line]:
    """Return the example with some values replaced; keys are dotted paths."""

    def changed(change: Change) -> Line:
        data = load_line(EXAMPLE).model_dump()
        for path, value in change.items():
            *way, last = path.split(".")
            place: Any = data
            for key in way:
                place = place[key]
            place[last] = value
        return Line.model_validate(data)

    return changed


@pytest.fixture(scope="session")
def small(vary: Callable[[Change], Line]) -> Line:
    """One span of 20 m with two droppers."""
    span = {"length": 20.0, "droppers": {"positions": (6.0, 14.0)}, "contact_wire_height": 0.0}
    support = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}}
    return vary({"spans": (span,), "supports": (support, support)})


@pytest.fixture(scope="session")
def small_file(small: Line, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("lines") / "small.json"
    path.write_text(json.dumps(small.model_dump(mode="json", exclude_none=True)), encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def small_result(small: Line) -> FormResult:
    return solve(small)


@pytest.fixture
def command(tmp_path: Path) -> Callable[..., Process]:
    """Start the command in an empty folder; its output is text, as in a pipe."""
    source = str(Path(catenaria.__file__).parents[1])
    environment = os.environ | {"PYTHONPATH": source, "COLUMNS": "200", "MPLBACKEND": "Agg"}

    def started(*arguments: object) -> Process:
        return subprocess.Popen(
            [sys.executable, "-c", COMMAND, *map(str, arguments)],
            cwd=tmp_path,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    return started
