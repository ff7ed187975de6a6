"""The paper's line as text and as plain data in SI, to be spoilt in one place by each test."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


@pytest.fixture(scope="session")
def example_path() -> Path:
    return EXAMPLE


@pytest.fixture(scope="session")
def example_text() -> str:
    return EXAMPLE.read_text(encoding="utf-8")


_SPAN: dict[str, Any] = {
    "length": 65.0,
    "droppers": {"positions": [4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0]},
    "contact_wire_height": 0.0,
}


def _conductor(youngs_modulus: float, area: float, density: float, stiffness: float) -> dict[str, Any]:
    return {
        "youngs_modulus": youngs_modulus,
        "area": area,
        "density": density,
        "bending_stiffness": stiffness,
    }


_TREE: dict[str, Any] = {
    "format": 1,
    "gravity": 9.8,
    "conductors": {
        "contact": _conductor(130e9, 120e-6, 7710.0, 400.0),
        "messenger": _conductor(81.7e9, 153e-6, 4020.0, 311.0),
        "dropper": _conductor(119e9, 10e-6, 8900.0, 4.0),
    },
    "contact_wire": {"conductor": "contact", "tension": {"force": 15e3}},
    "messenger_wire": {"conductor": "messenger", "tension": {"force": 15e3}},
    "dropper": {"conductor": "dropper"},
    "supports": [
        {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}},
        {"messenger_wire": {"height": 1.5}},
        {"messenger_wire": {"height": 1.5}},
        {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 1.5}},
    ],
    "spans": [_SPAN, _SPAN, _SPAN],
    "solver": {"dynamic": {"settle": {"remaining_travel": 0.5e-6}}},
}


@pytest.fixture
def tree() -> dict[str, Any]:
    """The paper's line in SI; every part may be changed without changing another."""
    fresh = copy.deepcopy(_TREE)
    fresh["spans"] = [copy.deepcopy(_SPAN) for _ in range(3)]
    return fresh


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str, str], Path]:
    """Write a text to a file with the given name."""

    def write_text(text: str, name: str = "line.yaml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write_text
