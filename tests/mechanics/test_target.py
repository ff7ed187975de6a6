"""Targets as equations: the fixed point of the velocity law without a dead band."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.measures import Height
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State

CONTROLS = Controls(
    np.array([2, 3]),
    Height(np.array([0, 1])),
    np.array([0.5, -0.2]),
    VelocityLaw(1.0, 0.0, 2.0),
    Ramp(0.0),
    Ramp(0.0),
)


def residual(part: Controls | Targets, heights: list[float]) -> np.ndarray:
    f = np.zeros(4)
    part.add_residual(State.at_rest(np.array([*heights, 0.0, 0.0])), f)
    return f[2:]


def check_same_root(targets: Targets) -> None:
    """Both vanish where the heights are as wanted, and nowhere near it."""
    for heights, met in (([0.5, -0.2], True), ([0.5, -0.1], False), ([0.4, -0.2], False)):
        assert np.array_equal(residual(targets, heights) == 0.0, residual(CONTROLS, heights) == 0.0)
        assert bool(np.all(residual(targets, heights) == 0.0)) is met


def test_same_root_as_the_controls() -> None:
    check_same_root(Targets.of(CONTROLS))


def test_another_target_is_noticed() -> None:
    with pytest.raises(AssertionError):
        check_same_root(replace(Targets.of(CONTROLS), target=np.array([0.5, -0.1])))


def test_nothing_to_relocate() -> None:
    assert Targets.of(CONTROLS).relocate(np.zeros(4)) is None
