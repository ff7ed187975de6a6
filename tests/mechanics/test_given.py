"""Parameters held at given values."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.state import State


def residual(z: list[float]) -> np.ndarray:
    f = np.zeros(3)
    Given(np.array([2, 0]), np.array([0.5, -1.0])).add_residual(State.at_rest(np.array(z)), f)
    return f


def test_vanishes_at_the_given_values_only() -> None:
    np.testing.assert_array_equal(residual([-1.0, 7.0, 0.5]), 0.0)
    with pytest.raises(AssertionError):
        np.testing.assert_array_equal(residual([-1.0, 7.0, 0.6]), 0.0)
