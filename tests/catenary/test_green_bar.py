"""The stretch of a bar with Green strain against its own cubic equation and the linear limit."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.catenary.green_bar import stretch
from catenaria.errors import InfeasibleError

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
    with pytest.raises(InfeasibleError, match=r"compression of 2\.38e\+05 N exceeds the 2\.29e\+05 N"):
        stretch(np.array([100.0, -0.2 * EA]), EA)
    assert float(stretch(-0.19 * EA, EA)) < 0.7
