"""The paper's three-span line, and ways to change it."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.workflow import solve

PEERS = {"exudyn": ("test_exudyn.py", "spatial/test_exudyn_in_space.py")}  # extra: bench

collect_ignore = [file for name, files in PEERS.items() if find_spec(name) is None for file in files]

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"

Change = dict[str, Any]


def changed(line: Line, change: Change) -> Line:
    """Return a line with some values replaced; keys are dotted paths."""
    data = line.model_dump()
    for path, value in change.items():
        *way, last = path.split(".")
        place: Any = data
        for key in way:
            place = place[key]
        place[last] = value
    return Line.model_validate(data)


@pytest.fixture(scope="session")
def line() -> Line:
    return load_line(EXAMPLE)


@pytest.fixture(scope="session")
def vary(line: Line) -> Callable[[Change], Line]:
    """Return the example with some values replaced; keys are dotted paths."""
    return lambda change: changed(line, change)


@pytest.fixture(scope="session")
def paper(line: Line) -> FormResult:
    """The example as it stands."""
    return solve(line, method="dynamic")


NARROW: Change = {
    "solver.dynamic.contact_tension.dead_band": 0.1,
    "solver.dynamic.contact_tension.saturation": 2.0,
    "solver.dynamic.messenger_tension.dead_band": 0.1,
    "solver.dynamic.messenger_tension.saturation": 2.5,
}


@pytest.fixture(scope="session")
def variant(line: Line) -> Callable[[Change], Line]:
    """Return the example with tension bands of 0.1 N and further changes."""
    return lambda change: changed(line, NARROW | change)


@pytest.fixture(scope="session")
def narrow(variant: Callable[[Change], Line]) -> Callable[[tuple[tuple[str, Any], ...]], FormResult]:
    """Solve the example with tension bands of 0.1 N and further changes; each combination once."""

    @cache
    def solved(change: tuple[tuple[str, Any], ...] = ()) -> FormResult:
        return solve(variant(dict(change)), method="dynamic")

    return solved
