"""The velocity law (19), (21): branches as printed (misprint apart), oddness, dead band, saturation, C1."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.controls.velocity_law import VelocityLaw

seeded = settings(derandomize=True, deadline=None)


class Law(Protocol):
    """What the checks need of a law."""

    @property
    def v_s(self) -> float: ...
    @property
    def e0(self) -> float: ...
    @property
    def e1(self) -> float: ...

    def velocity(self, e: np.ndarray) -> np.ndarray:
        """Return v(e)."""
        ...

    def slope(self, e: np.ndarray) -> np.ndarray:
        """Return dv/de."""
        ...


laws = st.builds(
    lambda v_s, e0, width: VelocityLaw(v_s, e0, e0 + width),
    st.floats(1e-6, 10.0),
    st.one_of(st.just(0.0), st.floats(1e-6, 1e3)),
    st.floats(1e-3, 1e3),
)


def yang(law: Law, e: float, misprint: bool = False) -> float:
    """Return (19) branch by branch; the last is printed as `e >= -T1`, which must read `e <= -T1`."""
    v_s, T0, T1 = law.v_s, law.e0, law.e1
    if misprint and e >= -T1:
        return v_s
    if e > T1:
        return -v_s
    if e > T0:
        x = (e - T0) / (T1 - T0)
        return -v_s * x**2 * (3.0 - 2.0 * x)
    if e > -T0:
        return 0.0
    if e > -T1:
        x = (e + T1) / (T1 - T0)
        return v_s - v_s * x**2 * (3.0 - 2.0 * x)
    return v_s


def check_branches(law: Law, e: float, misprint: bool = False) -> None:
    np.testing.assert_allclose(law.velocity(np.array([e]))[0], yang(law, e, misprint), atol=1e-9 * law.v_s)


def check_odd(law: Law, e: float) -> None:
    np.testing.assert_array_equal(law.velocity(np.array([e])), -law.velocity(np.array([-e])))


def check_c1(law: Law) -> None:
    """Across the four breaks value and slope do not jump, and slope is the derivative on both sides."""
    width, largest_slope = law.e1 - law.e0, 1.5 * law.v_s / (law.e1 - law.e0)
    for edge in (-law.e1, -law.e0, law.e0, law.e1):
        h = 1e-5 * width
        e = edge + h * np.array([-1.0, 0.0, 1.0])
        v = law.velocity(e)
        assert np.ptp(v) < 1e-4 * law.v_s
        assert np.ptp(law.slope(e)) < 1e-3 * largest_slope
        np.testing.assert_allclose(np.diff(v) / h, law.slope(e[1:2])[0], atol=1e-3 * largest_slope)


def check_slope(law: Law, e: float) -> None:
    h = 1e-5 * (law.e1 - law.e0)
    v = law.velocity(np.array([e - h, e + h]))
    np.testing.assert_allclose(
        law.slope(np.array([e]))[0], (v[1] - v[0]) / (2.0 * h), atol=1e-3 * law.v_s / (law.e1 - law.e0)
    )


@seeded
@given(laws, st.floats(-2.0, 2.0))
def test_branches_of_the_paper(law: VelocityLaw, relative: float) -> None:
    check_branches(law, relative * law.e1)


@seeded
@given(laws, st.floats(-1e6, 1e6))
def test_odd(law: VelocityLaw, e: float) -> None:
    check_odd(law, e)


@seeded
@given(laws, st.floats(-1.0, 1.0), st.floats(1.0, 1e6))
def test_dead_band_and_saturation(law: VelocityLaw, inside: float, beyond: float) -> None:
    assert law.velocity(np.array([inside * law.e0]))[0] == 0.0
    assert law.slope(np.array([inside * law.e0]))[0] == 0.0
    for sign in (-1.0, 1.0):
        e = np.array([sign * beyond * law.e1])
        np.testing.assert_allclose(law.velocity(e), -sign * law.v_s, rtol=1e-12)
        np.testing.assert_allclose(law.slope(e), 0.0, atol=1e-9 * law.v_s / (law.e1 - law.e0))


@seeded
@given(laws)
def test_continuously_differentiable(law: VelocityLaw) -> None:
    check_c1(law)


@seeded
@given(laws, st.floats(-2.0, 2.0))
def test_slope(law: VelocityLaw, relative: float) -> None:
    check_slope(law, relative * law.e1)


@seeded
@given(laws, st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_never_pushes_away(law: VelocityLaw, first: float, second: float) -> None:
    """v(e) falls monotonously, so it always acts against the error; the slope is never positive."""
    low, high = sorted((first * law.e1, second * law.e1))
    v = law.velocity(np.array([low, high]))
    assert v[1] <= v[0] + 1e-14 * law.v_s
    assert np.all(v * np.array([low, high]) <= 0.0)
    assert np.all(law.slope(np.array([low, high])) <= 0.0)


@seeded
@given(laws, st.floats(-3.0, 3.0))
def test_beyond(law: VelocityLaw, relative: float) -> None:
    """Error less its nearest point of the dead band."""
    e = relative * law.e1
    np.testing.assert_allclose(
        law.beyond(np.array([e]))[0], e - np.clip(e, -law.e0, law.e0), rtol=1e-12, atol=1e-12 * law.e1
    )


def test_control_misprinted_branch_is_not_odd() -> None:
    """Read literally, (19) gives v_s for every e >= -T1 that reaches the last branch: it cannot be meant."""
    law = VelocityLaw(0.2e-3, 5.0, 100.0)
    check_branches(law, 200.0)
    check_branches(law, -200.0)
    with pytest.raises(AssertionError):
        check_branches(law, 200.0, misprint=True)
    with pytest.raises(AssertionError):
        check_branches(law, -200.0 + 150.0, misprint=True)


class Linear:
    """A law with kinks at its breaks, and one that is not odd if shifted."""

    def __init__(self, shift: float = 0.0) -> None:
        self.v_s, self.e0, self.e1, self.shift = 0.2e-3, 5.0, 100.0, shift

    def velocity(self, e: np.ndarray) -> np.ndarray:
        e = e - self.shift
        return -self.v_s * np.sign(e) * np.clip((np.abs(e) - self.e0) / (self.e1 - self.e0), 0.0, 1.0)

    def slope(self, e: np.ndarray) -> np.ndarray:
        inside = (np.abs(e - self.shift) > self.e0) & (np.abs(e - self.shift) < self.e1)
        return np.where(inside, -self.v_s / (self.e1 - self.e0), 0.0)


def test_control_linear_law_fails() -> None:
    with pytest.raises(AssertionError):
        check_c1(Linear())
    with pytest.raises(AssertionError):
        check_branches(Linear(), 30.0)
    with pytest.raises(AssertionError):
        check_odd(Linear(shift=1.0), 30.0)


@pytest.mark.parametrize(
    "wrong",
    [
        (0.0, 1.0, 2.0),
        (-1.0, 1.0, 2.0),
        (1.0, -1.0, 2.0),
        (1.0, 2.0, 2.0),
        (1.0, 3.0, 2.0),
        (1.0, 0.0, np.inf),
    ],
)
def test_refuses_impossible_laws(wrong: tuple[float, float, float]) -> None:
    with pytest.raises(InconsistentInputError):
        VelocityLaw(*wrong)


@pytest.mark.parametrize("wrong", [(np.nan, 1.0, 2.0), (1.0, np.nan, 2.0), (1.0, 1.0, np.nan)])
def test_refuses_nan(wrong: tuple[float, float, float]) -> None:
    with pytest.raises(InconsistentInputError):
        VelocityLaw(*wrong)
