"""The paper's line, an uneven one, and what the direct method finds for them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from catenaria.formfinding.direct import Direct
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.registry import ELEMENT_METHODS
from catenaria.line import Line
from catenaria.results import FormResult

Change = dict[str, Any]


@pytest.fixture(scope="session")
def system(line: Line) -> LineSystem:
    return LineSystem.of(line)


@pytest.fixture(scope="session")
def uneven(vary: Callable[[Change], Line]) -> Line:
    """Unequal spans with pre-sag and clamps, far from the origin; the contact wire is held once more."""
    both = {"contact_wire": {"height": 5.0}, "messenger_wire": {"height": 6.3}}
    spans = (
        {"length": 50.0, "droppers": {"positions": (3, 14, 26, 37, 47)}, "contact_wire_height": 5.0},
        {
            "length": 60.0,
            "droppers": {"positions": (5, 16, 30, 44, 56)},
            "contact_wire_height": (4.99, 4.98, 4.975, 4.98, 4.99),
        },
        {"length": 40.0, "droppers": {"positions": (8, 20, 31)}, "contact_wire_height": 5.0},
    )
    return vary(
        {
            "spans": spans,
            "supports": (both, {"messenger_wire": {"height": 6.3}}, both, both),
            "start_chainage": 10_000.0,
            "contact_wire.tension.force": 17e3,
            "messenger_wire.tension": {"force": 12e3, "at": "start"},
            "dropper.clamp_mass_top": 0.2,
            "dropper.clamp_mass_bottom": 0.3,
            "dropper.clamp_height_top": 0.02,
        }
    )


@pytest.fixture(scope="session", params=["paper", "uneven"])
def any_line(request: pytest.FixtureRequest, line: Line, uneven: Line) -> Line:
    return line if request.param == "paper" else uneven


@pytest.fixture(scope="session")
def direct(any_line: Line) -> FormResult:
    return Direct().find_form(any_line)


@pytest.fixture(scope="session", params=list(ELEMENT_METHODS))
def method(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="session")
def found(any_line: Line, method: str) -> FormResult:
    """What each method finds for each line."""
    return ELEMENT_METHODS[method](None).find_form(any_line)
