"""Measures against independent evaluation, and their signs."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.measures import DropperForce, Height, ReactionTension, StrainTension
from catenaria.mechanics.loads.gravity import Ramp

UNIT = np.array([[-1.0, 0.0, 0.0], [0.6, 0.0, 0.8]])
LA = np.arange(6, dtype=np.int64).reshape(2, 3)


def check_pull(measure: ReactionTension, z: np.ndarray, expected: list[float]) -> None:
    np.testing.assert_allclose(measure.value(0.0, z), expected, rtol=1e-13)


def test_reaction_is_the_size_of_the_force() -> None:
    """The wire pulls the device against n: la . n < 0 counts as tension, whatever its other components."""
    measure = ReactionTension(LA, UNIT)
    check_pull(measure, np.array([3.0, 4.0, 12.0, -6.0, 5.0, -8.0]), [13.0, np.sqrt(125.0)])
    with pytest.raises(AssertionError):
        check_pull(
            ReactionTension(LA, -UNIT), np.array([3.0, 4.0, 12.0, -6.0, 5.0, -8.0]), [13.0, np.sqrt(125.0)]
        )


def test_reaction_is_negative_under_compression() -> None:
    check_pull(
        ReactionTension(LA, UNIT), np.array([-3.0, 4.0, 12.0, 6.0, 5.0, 8.0]), [-13.0, -np.sqrt(125.0)]
    )


def test_reaction_without_force() -> None:
    """At rest there is no direction; the gradient is that of the pull -la . n, so that a solver can start."""
    measure, z = ReactionTension(LA, UNIT), np.zeros(6)
    np.testing.assert_array_equal(measure.value(0.0, z), 0.0)
    np.testing.assert_array_equal(measure.gradient(0.0, z), -UNIT)
    h = 1e-6
    pulled = measure.value(0.0, -h * UNIT.ravel())
    np.testing.assert_allclose(pulled, h, rtol=1e-12)


def strain_measure() -> tuple[StrainTension, np.ndarray]:
    chain = Chain(
        np.arange(18, dtype=np.int64).reshape(3, 6), np.array([0.0, 1.0, 3.0]), Section(2e3, 1.0, 1.0)
    )
    z = np.random.default_rng(4).normal(size=20)
    z[18:] = [0.3, 2.9]
    return StrainTension(chain, np.array([18, 19]), np.array([0, 1])), z


def check_strain(measure: StrainTension, z: np.ndarray, EA: float) -> None:
    """N = EA (r'.r' - 1)/2 with r' from differences of the position."""
    h = 1e-6
    s = z[measure.s]
    r = [measure.wire.evaluate(z, s + side * h, measure.element).r for side in (-1.0, 1.0)]
    slope = (r[1] - r[0]) / (2.0 * h)
    np.testing.assert_allclose(measure.value(0.0, z), 0.5 * EA * (np.sum(slope**2, axis=1) - 1.0), rtol=1e-7)


def test_strain_tension() -> None:
    measure, z = strain_measure()
    check_strain(measure, z, 2e3)
    with pytest.raises(AssertionError):
        check_strain(measure, z, 2.001e3)


def test_strain_tension_is_not_the_true_tension() -> None:
    """N of (11) leaves out |r'|: stretched by 1.1, N = 0.105 EA, the axial force is 0.1155 EA."""
    measure, z = strain_measure()
    r1 = np.array([0.0, 1.1, 0.0])
    z[:18] = np.concatenate([np.concatenate((s * r1, r1)) for s in measure.wire.knots])
    np.testing.assert_allclose(measure.value(0.0, z), 0.105 * 2e3, rtol=1e-12)


def test_strain_tension_relocates() -> None:
    measure, z = strain_measure()
    assert measure.relocate(z) is None
    z[18:] = [1.4, 0.2]
    moved = measure.relocate(z)
    assert moved is not None
    np.testing.assert_array_equal(moved.element, [1, 0])
    np.testing.assert_array_equal(measure.element, [0, 1])
    check_strain(moved, z, 2e3)


def test_height() -> None:
    z = np.array([1.0, 2.0, 3.0, 4.0])
    np.testing.assert_array_equal(Height(np.array([3, 1])).value(0.0, z), [4.0, 2.0])


def test_a_leaning_dropper_weighs_by_its_length() -> None:
    """3 m, 4 m and 0 m apart: 5 m long."""
    one, top = np.array([0]), np.array([[1, 2, 3]])
    measure = DropperForce(one, top, np.array([[1.0, 0.0, 1.0]]), 0.1, np.zeros(1), 10.0, Ramp(0.0))
    assert measure.value(0.0, np.array([50.0, 4.0, 0.0, 5.0]))[0] == pytest.approx(45.0)
    assert measure.value(0.0, np.array([50.0, 1.0, 0.0, 5.0]))[0] == pytest.approx(
        46.0
    )  # if it does not lean


def check_dropper(value: np.ndarray, T_md: float, z_md: float, t: float) -> None:
    """T_md - G with G = g(t) (rhoA |r_md - r_cd| + mass): 0.117 kg/m, 0.165 kg, z_cd = 5.3, ramp of 2 s."""
    ramp = (t / 2.0) ** 2 * (3.0 - t) if t < 2.0 else 1.0
    np.testing.assert_allclose(value, T_md - 9.8 * ramp * (0.117 * (z_md - 5.3) + 0.165), rtol=1e-13)


@pytest.mark.parametrize("t", [0.0, 0.7, 2.0, 50.0])
def test_dropper_force(t: float) -> None:
    one = np.array([0])
    top, bottom = np.array([[1, 2, 3]]), np.array([[7.0, 0.0, 5.3]])
    measure = DropperForce(one, top, bottom, 0.117, np.array([0.165]), 9.8, Ramp(2.0))
    z = np.array([88.0, 7.0, 0.0, 6.35])
    check_dropper(measure.value(t, z), 88.0, 6.35, t)
    with pytest.raises(AssertionError):
        check_dropper(measure.value(t, z + 0.01), 88.0, 6.35, t)
