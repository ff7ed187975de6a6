"""Consistent mass (14) and gravity (17) of the cable against quadrature, closed forms and rigid motions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad_vec

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.loads.linear import Inertia, assemble

LENGTHS = [0.1, 1.0, 2.4]
RHO_A = 1.35


def one(L: float) -> CableElements:
    dofs = np.arange(12, dtype=np.int64)[None, :]
    return CableElements(dofs, np.array([L]), np.array([1.0]), np.array([1.0]), np.array([RHO_A]))


def shape_matrix(arc: float, L: float) -> np.ndarray:
    """Return the shape matrix (2), with (3)-(4) put right, as a function of the arc length."""
    s = 2.0 * arc / L - 1.0
    N1, N2 = 0.25 * (s - 1.0) ** 2 * (s + 2.0), 0.25 * (s + 1.0) ** 2 * (2.0 - s)
    N3, N4 = L / 8.0 * (s - 1.0) ** 2 * (s + 1.0), L / 8.0 * (s + 1.0) ** 2 * (s - 1.0)
    return np.kron([[N1, N3, N2, N4]], np.eye(3))


def check_mass(M: np.ndarray, L: float) -> None:
    """(14) by adaptive quadrature."""
    expected = RHO_A * quad_vec(lambda arc: shape_matrix(arc, L).T @ shape_matrix(arc, L), 0.0, L)[0]
    np.testing.assert_allclose(M, expected, rtol=1e-12, atol=1e-14 * expected.max())


def check_weight(weight: np.ndarray, L: float) -> None:
    """(17) by adaptive quadrature, with our downward axis n = (0, 0, -1)."""
    expected = RHO_A * quad_vec(lambda arc: shape_matrix(arc, L).T @ np.array([0.0, 0.0, -1.0]), 0.0, L)[0]
    np.testing.assert_allclose(weight, expected, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("L", LENGTHS)
def test_mass_by_quadrature(L: float) -> None:
    check_mass(one(L).mass()[0], L)


@pytest.mark.parametrize("L", LENGTHS)
def test_mass_closed_form(L: float) -> None:
    """The textbook matrix of a Hermite beam, rhoA L/420 times integers."""
    beam = np.array(
        [
            [156.0, 22 * L, 54, -13 * L],
            [22 * L, 4 * L**2, 13 * L, -3 * L**2],
            [54, 13 * L, 156, -22 * L],
            [-13 * L, -3 * L**2, -22 * L, 4 * L**2],
        ]
    )
    expected = RHO_A * L / 420.0 * np.kron(beam, np.eye(3))
    np.testing.assert_allclose(one(L).mass()[0], expected, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(expected[0, 0], 13.0 / 35.0 * RHO_A * L, rtol=1e-15)
    np.testing.assert_allclose(expected[0, 3], 11.0 / 210.0 * RHO_A * L**2, rtol=1e-15)


@pytest.mark.parametrize("L", LENGTHS)
def test_weight_by_quadrature(L: float) -> None:
    check_weight(one(L).weight(12), L)


def test_control_lumped_mass_and_weight_fail() -> None:
    L = 2.4
    lumped = np.kron(np.diag([0.5, 0.0, 0.5, 0.0]), np.eye(3)) * RHO_A * L
    with pytest.raises(AssertionError):
        check_mass(lumped, L)
    with pytest.raises(AssertionError):
        check_weight(lumped @ np.tile([0.0, 0.0, -1.0], 4), L)


def wire(turn: np.ndarray) -> tuple[CableElements, np.ndarray, float]:
    """Return a straight wire of unequal elements in a generic direction, its coordinates and its length."""
    knots = np.array([0.0, 0.3, 1.0, 3.4])
    chain = Chain(np.arange(24, dtype=np.int64).reshape(4, 6), knots, Section(1.0, 1.0, RHO_A))
    q = np.hstack((np.outer(knots, turn[:, 0]), np.tile(turn[:, 0], (4, 1)))).ravel()
    return CableElements.of([chain]), q, 3.4


def test_weight_of_a_wire_adds_up(turn: np.ndarray) -> None:
    """Vertical forces sum to the weight, their moment is that of the weight at the centre of mass."""
    elements, q, length = wire(turn)
    weight = elements.weight(30)
    np.testing.assert_allclose(weight[24:], 0.0)
    f, r = weight[:24].reshape(-1, 3), q.reshape(-1, 3)
    np.testing.assert_allclose(f[::2].sum(axis=0), [0.0, 0.0, -RHO_A * length], atol=1e-14)
    moment = np.cross(r, f).sum(axis=0)
    centre = 0.5 * length * turn[:, 0]
    np.testing.assert_allclose(moment, np.cross(centre, [0.0, 0.0, -RHO_A * length]), atol=1e-13)


def check_kinetic_energy(inertia: Inertia, q: np.ndarray, length: float, turn: np.ndarray) -> None:
    """Rigid motion: velocity v of the start, rotation w; T = m v_c^2/2 + m L^2 w_n^2/24 (slender rod)."""
    v, w, mass = np.array([0.3, -0.4, 1.1]), np.array([0.7, 0.2, -0.5]), RHO_A * length
    q = q.reshape(-1, 2, 3)
    velocity = np.stack((v + np.cross(w, q[:, 0]), np.cross(w, q[:, 1])), axis=1).ravel()
    v_c = v + np.cross(w, 0.5 * length * turn[:, 0])
    normal = w - (w @ turn[:, 0]) * turn[:, 0]
    expected = 0.5 * mass * v_c @ v_c + mass * length**2 / 24.0 * normal @ normal
    np.testing.assert_allclose(inertia.kinetic_energy(velocity), expected, rtol=1e-12)


def test_kinetic_energy_of_a_rigid_motion(turn: np.ndarray) -> None:
    elements, q, length = wire(turn)
    M = assemble(elements, elements.mass(), 24)
    check_kinetic_energy(Inertia(M), q, length, turn)
    total = M.toarray().reshape(8, 3, 8, 3)[::2, :, ::2].sum(axis=(0, 2))
    np.testing.assert_allclose(total, RHO_A * length * np.eye(3), rtol=1e-13, atol=1e-14)
    with pytest.raises(AssertionError):
        check_kinetic_energy(Inertia(1.001 * M), q, length, turn)
