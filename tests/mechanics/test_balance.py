"""The balance of forces on a dropper in two halves, eq. (23)."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.mechanics.controls.balance import ForceBalance
from catenaria.mechanics.controls.measures import DropperForce
from catenaria.mechanics.loads.gravity import Ramp

# unknowns: force of the upper wire on the dropper, force of the dropper on the lower wire, two heights
Z = np.array([122.0, 120.5, 1.31, 0.01])


def balance(sign: tuple[float, float] = (1.0, -1.0), mass: float = 0.0) -> ForceBalance:
    return ForceBalance(
        force=np.array([[0, 1]]),
        sign=np.array([sign]),
        end=np.array([[2, 3]]),
        rhoA=np.array([0.089]),
        mass=np.array([mass]),
        g=9.8,
        ramp=Ramp(2.0),
    )


def test_sum_of_the_forces_on_one_dropper() -> None:
    expected = 122.0 - 120.5 - 9.8 * (0.089 * 1.3 + 0.2)
    np.testing.assert_allclose(balance(mass=0.2).value(9.0, Z), expected, rtol=1e-13)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(balance(mass=0.2).value(1.0, Z), expected, rtol=1e-3)


def test_agrees_with_the_measure_of_two_steps() -> None:
    """With the lower force and end known beforehand, it is T_md - G against the target T_cd."""
    top, bottom = np.array([[4, 5, 2]]), np.array([[0.0, 0.0, 0.01]])
    known = DropperForce(np.array([0]), top, bottom, 0.089, np.array([0.2]), 9.8, Ramp(2.0))
    expected = known.value(1.0, np.append(Z, [0.0, 0.0])) - Z[1]
    np.testing.assert_allclose(balance(mass=0.2).value(1.0, Z), expected, rtol=1e-13)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(balance().value(1.0, Z), expected, rtol=1e-3)


def test_signs_of_joints() -> None:
    """A joint that gives the force on the dropper instead changes one sign."""
    turned = Z * [1.0, -1.0, 1.0, 1.0]
    np.testing.assert_allclose(balance((1.0, 1.0)).value(9.0, turned), balance().value(9.0, Z), rtol=1e-13)


def test_gradient() -> None:
    measure, step = balance(mass=0.2), 1e-3
    columns = measure.columns()[0]
    for column, slope in zip(columns, measure.gradient(1.0, Z)[0], strict=True):
        ahead, behind = (Z + side * step * np.eye(4)[column] for side in (1.0, -1.0))
        difference = measure.value(1.0, ahead) - measure.value(1.0, behind)
        np.testing.assert_allclose(difference / (2.0 * step), slope, atol=1e-9)
    assert measure.relocate(Z) is None
