"""Rounding to whole steps."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.numerics.rounding import rounded_half_up


def test_halves_go_upwards_and_not_to_even_steps() -> None:
    assert rounded_half_up(np.array([0.5, 1.5, 2.5]), 1.0).tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(AssertionError):
        assert np.round([0.5, 1.5, 2.5]).tolist() == [1.0, 2.0, 3.0]


def test_a_half_within_rounding_errors_is_a_half() -> None:
    assert rounded_half_up(np.array([0.0125 - 1e-12, 0.0124]), 0.005).tolist() == [0.015, 0.010]
