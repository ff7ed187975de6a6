"""The stretch of a bar with Green strain against its own cubic equation and the linear limit."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.catenary.green_bar import stretch

EA = 1.19e6


def check_cubic(x: np.ndarray, force: np.ndarray) -> None:
    """EA eps x = force with eps = (x^2 - 1)/2."""
    np.testing.assert_allclose(EA * (x**2 - 1) / 2 * x, force, rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("force", [-2e5, -10.0, 0.0, 87.0, 1e4, 3e5, 5e7])
def test_solves_the_cubic(force: float) -> None:
    check_cubic(stretch(np.array(force), EA), np.array(force))


def test_engineering_strain_is_noticed() -> None:
    """1 + T/EA differs in the second order, 1.5 (T/EA)^2."""
    with pytest.raises(AssertionError):
        check_cubic(np.array(1.0 + 1e4 / EA), np.array(1e4))


def test_small_forces_stretch_linearly() -> None:
    assert float(stretch(87.0, EA)) == pytest.approx(1.0 + 87.0 / EA - 1.5 * (87.0 / EA) ** 2, abs=1e-11)


def test_more_compression_than_the_law_can_carry_is_refused() -> None:
    with pytest.raises(ValueError, match="compression"):
        stretch(-0.2 * EA, EA)
