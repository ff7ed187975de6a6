"""The pull of a device in its own direction."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.mechanics.controls.measures import ReactionTension
from catenaria.mechanics.controls.pull import Pull

LA = np.arange(6, dtype=np.int64).reshape(2, 3)
UNIT = np.array([[-1.0, 0.0, 0.0], [0.6, 0.0, 0.8]])
Z = np.array([3.0, 4.0, 12.0, -6.0, 5.0, -8.0])


def test_only_what_acts_along_the_direction_counts() -> None:
    measure = Pull(LA, UNIT)
    np.testing.assert_allclose(measure.value(0.0, Z), [3.0, 10.0], rtol=1e-13)
    across = Z + np.concatenate(([0.0, 7.0, -2.0], [0.8, -9.0, -0.6]))
    np.testing.assert_allclose(measure.value(0.0, across), [3.0, 10.0], rtol=1e-13)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(ReactionTension(LA, UNIT).value(0.0, Z), [3.0, 10.0], rtol=1e-3)


def test_without_forces_across_it_is_the_reaction() -> None:
    z = np.concatenate(([5.0, 0.0, 0.0], [-0.6, 0.0, -0.8]))
    np.testing.assert_allclose(
        Pull(LA, UNIT).value(0.0, z), ReactionTension(LA, UNIT).value(0.0, z), rtol=1e-13
    )


def test_it_is_linear() -> None:
    measure = Pull(LA, UNIT)
    np.testing.assert_array_equal(measure.columns(), LA)
    by_gradient = np.sum(measure.gradient(0.0, Z) * Z[LA], axis=1)
    np.testing.assert_allclose(measure.value(0.0, Z), by_gradient, rtol=1e-13)
    assert measure.relocate(Z) is None
