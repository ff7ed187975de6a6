"""The inextensible catenary against its definition: ends, arc length, constant horizontal tension."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from catenaria.catenary.hanging_chain import hanging_chain
from catenaria.errors import InconsistentInputError


def check_chain(span: float, rise: float, length: float) -> None:
    s = np.linspace(0.0, length, 2001)
    x, z, dx, dz = hanging_chain(s, span, rise, length)
    np.testing.assert_allclose([x[0], z[0], x[-1], z[-1]], [0.0, 0.0, span, rise], atol=1e-9 * length)
    np.testing.assert_allclose(np.hypot(dx, dz), 1.0, rtol=1e-12)
    np.testing.assert_allclose(np.gradient(x, s)[1:-1], dx[1:-1], atol=1e-4)
    slope = dz / dx  # w s/H + constant: the vertical force grows with arc length, the horizontal one does not
    np.testing.assert_allclose(np.diff(slope), (slope[-1] - slope[0]) / 2000, rtol=1e-6)


@given(
    rise=st.floats(-5.0, 5.0),
    excess=st.floats(1.0001, 3.0),
)
def test_chain(rise: float, excess: float) -> None:
    check_chain(8.0, rise, excess * float(np.hypot(8.0, rise)))


def test_a_wrong_end_is_noticed() -> None:
    x, *_ = hanging_chain(np.array([10.0]), 8.0, 0.0, 10.0)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(x, 8.001, atol=1e-9)


@pytest.mark.parametrize(("span", "rise", "length"), [(8.0, 0.0, 8.0), (3.0, 4.0, 4.9), (0.0, 1.0, 2.0)])
def test_no_chain(span: float, rise: float, length: float) -> None:
    with pytest.raises(InconsistentInputError, match="hangs only if"):
        hanging_chain(np.zeros(1), span, rise, length)
