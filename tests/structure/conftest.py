"""Descriptions of small structures as plain data, to be spoilt in one place by each test."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"

_TAUT: dict[str, Any] = {
    "format": 1,
    "name": "taut cable",
    "gravity": 9.8,
    "sections": {"wire": {"EA": 1e6, "EJ": 10.0, "rhoA": 1.0}},
    "cables": {
        "main": {"section": "wire", "points": [[0, 0, 0], [10.5, 0, 0]], "elements": 21},
        "hanger": {"section": "wire", "points": [[4, 0, 0], [4, 0, 1]], "elements": 2},
    },
    "joints": {
        "left": {"type": "spherical", "on": {"cable": "main", "point": "start"}},
        "ring": {"type": "sliding", "on": {"cable": "main", "point": 10.0}},
        "right": {"type": "spherical", "on": {"cable": "main", "point": "end"}},
        "clamp": {
            "type": "guided",
            "on": {"cable": "main", "point": 4.0},
            "to": {"cable": "hanger", "point": "start"},
        },
        "top": {"type": "spherical", "on": {"cable": "hanger", "point": "end"}},
    },
    "tensions": {"T": {"joint": "right", "force": 1000.0, "move": {"right": [1, 0, 0]}}},
    "heights": {"h": {"joint": "clamp", "height": 0.02, "move": {"top": [0, 0, 1]}}},
}


@pytest.fixture
def taut() -> dict[str, Any]:
    """Return a cable that slides through a ring, is held up by a hanger, and has two targets."""
    return copy.deepcopy(_TAUT)


@pytest.fixture
def examples() -> Path:
    return EXAMPLES
