"""Inertia, Rayleigh damping, point masses and the assembly of element matrices."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csr_array

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.loads.linear import Inertia, RayleighDamping, assemble, point_masses
from catenaria.mechanics.state import State

SIZE = 30  # 24 coordinates of four nodes, six more unknowns that are no coordinates
ALPHA, BETA = 0.3, 0.07


def wire(stretch: float = 1.0) -> tuple[CableElements, np.ndarray]:
    """Return a wire of three unequal elements in a generic direction and all unknowns."""
    direction = np.array([0.36, 0.48, 0.8])
    knots = np.array([0.0, 0.4, 1.0, 2.5])
    chain = Chain(np.arange(24, dtype=np.int64).reshape(4, 6), knots, Section(200.0, 5.0, 1.3))
    q = np.hstack((np.outer(stretch * knots, direction), np.tile(stretch * direction, (4, 1)))).ravel()
    return CableElements.of([chain], 3), np.concatenate((q, np.full(6, np.nan)))


def matrices(stretch: float = 1.0) -> tuple[csr_array, csr_array]:
    elements, z = wire(stretch)
    return assemble(elements, elements.mass(), SIZE), assemble(elements, elements.stiffness(z), SIZE)


def drag(damping: RayleighDamping, zd: np.ndarray) -> np.ndarray:
    f = np.zeros(SIZE)
    damping.add_residual(State(0.0, np.full(SIZE, np.nan), zd, np.full(SIZE, np.nan)), f)
    return f


def translation() -> np.ndarray:
    return np.concatenate((np.tile([1.0, -2.0, 0.5, 0.0, 0.0, 0.0], 4), np.zeros(6)))


def check_translation_is_free(damping: RayleighDamping) -> None:
    np.testing.assert_allclose(drag(damping, translation()), 0.0, atol=1e-11)


def check_dissipates(damping: RayleighDamping) -> None:
    """The power q' . D q' is never negative: D is symmetric and positive semi-definite."""
    D = damping.D.toarray()
    np.testing.assert_allclose(D, D.T, atol=1e-12 * np.abs(D).max())
    assert np.linalg.eigvalsh(D).min() > -1e-12 * np.abs(D).max()
    for zd in np.random.default_rng(6).normal(size=(20, SIZE)):
        assert zd @ drag(damping, zd) >= 0.0


def test_stiffness_part_lets_translations_pass() -> None:
    check_translation_is_free(RayleighDamping(BETA * matrices()[1]))


def test_control_mass_part_resists_translations() -> None:
    M, K = matrices()
    with pytest.raises(AssertionError):
        check_translation_is_free(RayleighDamping(ALPHA * M + BETA * K))
    momentum = drag(RayleighDamping(ALPHA * M), translation())[:24].reshape(4, 2, 3)[:, 0].sum(axis=0)
    np.testing.assert_allclose(momentum, ALPHA * 1.3 * 2.5 * np.array([1.0, -2.0, 0.5]), rtol=1e-12)


@pytest.mark.parametrize("stretch", [1.0, 1.001])
def test_dissipation_is_never_negative(stretch: float) -> None:
    M, K = matrices(stretch)
    check_dissipates(RayleighDamping(ALPHA * M + BETA * K))


def test_control_compressed_start_feeds_energy_in() -> None:
    """K_0 of a compressed wire is indefinite: do not take K_0 from one."""
    with pytest.raises(AssertionError):
        check_dissipates(RayleighDamping(BETA * matrices(stretch=0.9)[1]))


def test_assemble_adds_up_and_stores_no_zeros() -> None:
    elements, _ = wire()
    expected = np.zeros((SIZE, SIZE))
    for dofs, matrix in zip(elements.dofs, elements.mass(), strict=True):
        expected[np.ix_(dofs, dofs)] += matrix
    M = matrices()[0]
    np.testing.assert_allclose(M.toarray(), expected, rtol=1e-14)
    assert np.all(M.data != 0.0)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(M.toarray(), np.triu(expected), rtol=1e-14)


def test_inertia() -> None:
    M = matrices()[0]
    zdd = np.random.default_rng(9).normal(size=SIZE)
    f = np.zeros(SIZE)
    Inertia(M).add_residual(State(0.0, np.full(SIZE, np.nan), np.full(SIZE, np.nan), zdd), f)
    np.testing.assert_allclose(f, M.toarray() @ zdd, rtol=1e-12, atol=1e-13)
    np.testing.assert_array_equal(f[24:], 0.0)


def check_point_masses(mass: csr_array, weight: np.ndarray) -> None:
    """2 kg and 3 kg at two nodes, and 0.5 kg more at the first."""
    velocity = np.zeros(SIZE)
    velocity[0:3], velocity[12:15] = [1.0, 2.0, 2.0], [0.0, 3.0, 4.0]
    np.testing.assert_allclose(
        Inertia(mass).kinetic_energy(velocity), 0.5 * (2.5 * 9.0 + 3.0 * 25.0), rtol=1e-14
    )
    expected = np.zeros(SIZE)
    expected[[2, 14]] = [-2.5, -3.0]
    np.testing.assert_allclose(weight, expected)


def test_point_masses() -> None:
    dofs = np.array([[0, 1, 2], [12, 13, 14], [0, 1, 2]])
    check_point_masses(*point_masses(dofs, np.array([2.0, 3.0, 0.5]), SIZE))
    with pytest.raises(AssertionError):
        check_point_masses(*point_masses(dofs, np.array([2.0, 3.0, 0.6]), SIZE))
