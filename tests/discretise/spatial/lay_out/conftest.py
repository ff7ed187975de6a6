"""A line of three spans as plain data in SI, to be changed by each test, and what it is laid out to."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.discretise.spatial.layout import Layout
from catenaria.line import Line

Tree = dict[str, Any]


def _conductor(area: float, mass: float) -> Tree:
    return {"youngs_modulus": 120e9, "area": area, "mass_per_length": mass, "bending_stiffness": 100.0}


def _support(stagger: float) -> Tree:
    return {"stagger": stagger, "contact_wire": {"height": 5.5}, "messenger_wire": {"height": 7.0}}


def _span() -> Tree:
    return {"length": 50.0, "droppers": {"positions": [5.0, 15.0, 25.0, 35.0, 45.0]}}


@pytest.fixture
def tree() -> Tree:
    """Three spans of 50 m on a straight and level track, with supports at 100, 150, 200 and 250 m."""
    return {
        "format": 1,
        "gravity": 9.81,
        "start_chainage": 100.0,
        "conductors": {
            "contact": _conductor(100e-6, 0.9),
            "messenger": _conductor(50e-6, 0.45),
            "dropper": _conductor(10e-6, 0.09),
            "stitch": _conductor(35e-6, 0.3),
        },
        "contact_wire": {"conductor": "contact", "tension": {"force": 10e3}, "tail": 1.0},
        "messenger_wire": {"conductor": "messenger", "tension": {"force": 12e3}, "tail": 2.0},
        "dropper": {"conductor": "dropper", "clamp_mass_bottom": 0.1, "clamp_mass_top": 0.2},
        "supports": [_support(stagger) for stagger in (-0.2, 0.2, -0.2, 0.2)],
        "spans": [_span() for _ in range(3)],
    }


@pytest.fixture
def laid() -> Callable[[Tree], Layout]:
    return lambda tree: lay_out(Line.model_validate(tree))


@pytest.fixture
def in_curve() -> Callable[[float, float, float, float], NDArray[np.float64]]:
    """Give the point across a canted curve to the left that begins at 100 m, by a formula of its own."""

    def point(along: float, lateral: float, height: float, lean: float) -> NDArray[np.float64]:
        """`along` [m] from where the curve of 300 m begins; `lean` is the angle of the cant."""
        heading = along / 300.0
        across = lateral * np.cos(lean) + height * np.sin(lean)  # the canted plane leans to the left
        z = height * np.cos(lean) - lateral * np.sin(lean)
        radius = 300.0 - across
        return np.array([100.0 + radius * np.sin(heading), 300.0 - radius * np.cos(heading), z])

    return point
