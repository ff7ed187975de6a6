"""The paper's line, lines like it, and the methods for strings."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import pytest

from catenaria.formfinding.strings.registry import STRING_METHODS
from catenaria.formfinding.strings.task import StringLine, string_line
from catenaria.line import Line
from catenaria.results import FormResult

PEERS = ("moorpy", "compas_fd")  # extra: bench

collect_ignore = [f"test_{name}.py" for name in PEERS if find_spec(name) is None]

Change = dict[str, Any]


def _uneven(vary: Callable[[Change], Line]) -> Line:
    """Return unequal spans with pre-sag, clamps, a contact wire that is held once more, uneven tensions."""
    spans = (
        {"length": 50.0, "droppers": {"positions": (3, 14, 26, 37, 47)}, "contact_wire_height": 0.0},
        {
            "length": 60.0,
            "droppers": {"positions": (5, 16, 30, 44, 56)},
            "contact_wire_height": (-0.01, -0.02, -0.025, -0.02, -0.01),
        },
        {"length": 40.0, "droppers": {"positions": (8, 20, 31)}, "contact_wire_height": 0.0},
    )
    both = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.3}}
    return vary(
        {
            "spans": spans,
            "supports": (both, {"messenger_wire": {"height": 1.3}}, both, both),
            "start_chainage": 1000.0,
            "contact_wire.tension.force": 17e3,
            "messenger_wire.tension": {"force": 12e3, "at": "start"},
            "dropper.clamp_mass_top": 0.2,
            "dropper.clamp_mass_bottom": 0.3,
            "dropper.clamp_height_top": 0.02,
        }
    )


@pytest.fixture(scope="session", params=["paper", "uneven"])
def any_line(request: pytest.FixtureRequest, line: Line, vary: Callable[[Change], Line]) -> Line:
    return line if request.param == "paper" else _uneven(vary)


@pytest.fixture(scope="session")
def uneven(vary: Callable[[Change], Line]) -> Line:
    return _uneven(vary)


@pytest.fixture(scope="session")
def task(line: Line) -> StringLine:
    return string_line(line, "test")


@pytest.fixture(scope="session")
def found() -> Callable[[str, Line], FormResult]:
    """Solve a line by a method for strings."""
    return lambda name, line: STRING_METHODS[name](None).find_form(line)
