"""The gravity ramp (31) and the load it brings in."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.state import State

seeded = settings(derandomize=True, deadline=None)


def yang(t: float, t1: float) -> float:
    """Return g(t)/g of (31)."""
    return (t / t1) ** 2 * (3.0 - 2.0 * t / t1) if t <= t1 else 1.0


def check_ramp(factor: float, t: float, t1: float) -> None:
    np.testing.assert_allclose(factor, yang(t, t1), rtol=1e-12, atol=1e-15)


@seeded
@given(st.floats(0.0, 20.0), st.floats(0.01, 10.0))
def test_ramp(t: float, t1: float) -> None:
    check_ramp(Ramp(t1)(t), t, t1)


def test_ramp_starts_and_ends_smoothly() -> None:
    ramp, h = Ramp(5.0), 1e-6
    assert ramp(0.0) == ramp(-1.0) == 0.0
    assert ramp(5.0) == ramp(1e9) == 1.0
    for t in (0.0, 5.0):
        assert abs(ramp(t + h) - ramp(t - h)) / (2.0 * h) < 1e-6


def test_no_ramp() -> None:
    """A duration of 0 is full gravity from the start."""
    assert Ramp(0.0)(0.0) == 1.0


def test_control_linear_ramp_fails() -> None:
    with pytest.raises(AssertionError):
        check_ramp(1.0 / 4.0, 1.0, 4.0)


def test_load() -> None:
    """The residual carries -Q: gravity times ramp times weight, whatever the state."""
    rng = np.random.default_rng(4)
    weight, z = rng.normal(size=7), rng.normal(size=7)
    for t in (0.0, 1.3, 4.0, 9.0):
        f = np.zeros(7)
        Gravity(weight, 9.8, Ramp(4.0)).add_residual(State(t, z, z, z), f)
        np.testing.assert_allclose(f, -9.8 * yang(t, 4.0) * weight, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("duration", [-5.0, np.nan, np.inf])
def test_impossible_ramps_are_refused(duration: float) -> None:
    with pytest.raises(InconsistentInputError, match="duration"):
        Ramp(duration)
