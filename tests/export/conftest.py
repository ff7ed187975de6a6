"""Every example line, solved once."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.workflow import solve

PEERS = ("exudyn",)  # extra: bench

collect_ignore = [f"test_line_in_{name}.py" for name in PEERS if find_spec(name) is None]

FOLDER = Path(__file__).parents[2] / "examples"
LINES = (
    "yang2017_three_span",
    "simple_55m",
    "simple_60m",
    "stitched_re250",
    "compound",
    "curve_800m",
    "overlap",
    "bridge",
    "two_contact_wires_3kv",
)
WITH_FRICTION = ("simple_60m",)


@cache
def varied(name: str) -> FormResult:
    """Return the three-span line with droppers that are rigid, or some of them slack, or both."""
    line: dict[str, Any] = load_line(FOLDER / "yang2017_three_span.yaml").model_dump()
    if "rigid" in name:
        line["dropper"]["model"] = "rigid"
    if "slack" in name:
        line["dropper"] |= {
            "model": line["dropper"]["model"] if "rigid" in name else "bar",
            "slack": "allowed",
        }
        line["spans"][1]["contact_wire_height"] = [0.0, 0.0, 0.0, 0.08, 0.0, 0.0, 0.0]
    return solve(Line.model_validate(line), rebuild="none")


@cache
def solved(name: str) -> FormResult:
    """Return what the direct method finds for an example."""
    return solve(FOLDER / f"{name}.yaml", rebuild="none")


@pytest.fixture(params=LINES)
def every(request: pytest.FixtureRequest) -> FormResult:
    return solved(request.param)


@pytest.fixture(params=[name for name in LINES if name not in WITH_FRICTION])
def frictionless(request: pytest.FixtureRequest) -> FormResult:
    return solved(request.param)


@pytest.fixture(params=["rigid", "slack", "rigid and slack"])
def unlike(request: pytest.FixtureRequest) -> FormResult:
    """Return lines with droppers that are no springs."""
    return varied(request.param)


@pytest.fixture
def plane() -> FormResult:
    return solved("yang2017_three_span")


@pytest.fixture
def space() -> FormResult:
    """Return a line with arms, cantilevers and clamps."""
    return solved("simple_60m")


@pytest.fixture
def stitched() -> FormResult:
    return solved("stitched_re250")


@pytest.fixture
def compound() -> FormResult:
    """Return a line whose droppers hold two kinds of wires."""
    return solved("compound")


@pytest.fixture
def curve() -> FormResult:
    return solved("curve_800m")


@pytest.fixture(scope="session")
def strings() -> FormResult:
    """Return a result of a method without nodes."""
    return solve(FOLDER / "yang2017_three_span.yaml", method="force density", rebuild="none")
