"""The ANCF cable element against an independent implementation of eqs. (1)-(5), (8)-(10), and patch tests."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.kernels.cable import cable_stiffness
from catenaria.mechanics.state import State
from catenaria.numerics.gauss import gauss_legendre
from catenaria.numerics.hermite import shape_1, shape_2

Curvature = Callable[[np.ndarray, np.ndarray], np.ndarray]
LENGTH, EA, EJ = 1.7, 40.0, 6.0


def one(points: int = 60, length: float = LENGTH, EA: float = EA, EJ: float = EJ) -> CableElements:
    """Return a single element on unknowns 0 to 11."""
    dofs = np.arange(12, dtype=np.int64)[None, :]
    values = (np.array([value]) for value in (length, EA, EJ, 1.3))
    return CableElements(dofs, *values, gauss_points=points)


def straight(length: float = LENGTH, stretch: float = 1.0) -> np.ndarray:
    """Return the coordinates of a straight element along x."""
    return np.array([0, 0, 0, stretch, 0, 0, stretch * length, 0, 0, stretch, 0, 0], dtype=float)


def bent() -> np.ndarray:
    """Return a seeded state with large stretch, bending in two planes and large rotation."""
    return straight() + 0.35 * np.random.default_rng(5).normal(size=12)


def rotated(q: np.ndarray, turn: np.ndarray) -> np.ndarray:
    return (q.reshape(-1, 3) @ turn.T).ravel()


def forces(elements: CableElements, q: np.ndarray) -> np.ndarray:
    f = np.zeros(q.size)
    elements.add_residual(State.at_rest(q), f)
    return f


def curvature_squared(r1: np.ndarray, r2: np.ndarray) -> np.ndarray:
    """Return the square of (10)."""
    cross = np.cross(r1, r2)
    return np.sum(cross * cross, axis=1) / np.sum(r1 * r1, axis=1) ** 3


def approximate_curvature_squared(r1: np.ndarray, r2: np.ndarray) -> np.ndarray:
    """Return the square of |r''|, the curvature of the paper's [29-31] that it does not use."""
    return np.sum(r2 * r2, axis=1)


def energy_terms(q: np.ndarray, curvature: Curvature = curvature_squared) -> tuple[Any, Any]:
    """Return the axial and the bending term of (8), written anew: monomials in l, 60 points."""
    length = LENGTH
    r_i, m_i, r_j, m_j = q.reshape(4, 3)
    c2 = (3.0 * (r_j - r_i) / length - 2.0 * m_i - m_j) / length
    c3 = (m_i + m_j - 2.0 * (r_j - r_i) / length) / length**2
    points, weights = np.polynomial.legendre.leggauss(60)
    arc, weights = 0.5 * length * (points + 1.0), 0.5 * length * weights
    r1 = m_i + 2.0 * np.outer(arc, c2) + 3.0 * np.outer(arc**2, c3)
    r2 = 2.0 * c2 + 6.0 * np.outer(arc, c3)
    green = 0.5 * (np.sum(r1 * r1, axis=1) - 1.0)
    return weights @ (0.5 * EA * green**2), weights @ (0.5 * EJ * curvature(r1, r2))


def printed_forces(q: np.ndarray) -> np.ndarray:
    """Return dU/dq of that energy by complex step."""
    unit = np.eye(q.size) * 1e-30j
    return np.array([sum(energy_terms(q + step)).imag / 1e-30 for step in unit])


def check_energy(elements: CableElements, q: np.ndarray, curvature: Curvature = curvature_squared) -> None:
    np.testing.assert_allclose(elements.energies(q)[0], np.real(energy_terms(q, curvature)), rtol=1e-11)


def check_forces(elements: CableElements, q: np.ndarray) -> None:
    expected = printed_forces(q)
    np.testing.assert_allclose(forces(elements, q), expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


def check_symmetric(K: np.ndarray) -> None:
    np.testing.assert_allclose(K, np.swapaxes(K, -1, -2), atol=1e-13 * np.abs(K).max())


def test_energy() -> None:
    check_energy(one(), bent())


def test_forces_are_gradient_of_the_energy() -> None:
    check_forces(one(), bent())


@pytest.mark.parametrize("wrong", [{"EA": 1.00001 * EA}, {"EJ": 1.00001 * EJ}, {"length": 1.00001 * LENGTH}])
def test_control_wrong_constants_fail(wrong: dict[str, Any]) -> None:
    for check in (check_energy, check_forces):
        with pytest.raises(AssertionError):
            check(one(**wrong), bent())


def test_control_approximate_curvature_fails() -> None:
    with pytest.raises(AssertionError):
        check_energy(one(), bent(), approximate_curvature_squared)


def test_stiffness_is_symmetric() -> None:
    """K is the second derivative of an energy; its lower triangle is a copy, so difference forces."""
    q, h = bent(), 1e-4
    check_symmetric(one().stiffness(q))
    differences = np.array(
        [(forces(one(), q + h * e) - forces(one(), q - h * e)) / (2.0 * h) for e in np.eye(12)]
    )
    np.testing.assert_allclose(differences, differences.T, atol=1e-6 * np.abs(differences).max())
    with pytest.raises(AssertionError):
        check_symmetric(np.triu(one().stiffness(q)[0]))


def check_rigid_motion_is_free(elements: CableElements, q: np.ndarray) -> None:
    np.testing.assert_allclose(forces(elements, q), 0.0, atol=1e-13 * EA)
    np.testing.assert_allclose(elements.energies(q), 0.0, atol=1e-13 * EA)


@pytest.mark.parametrize("points", [3, 5, 9])
def test_patch_rigid_motion(points: int, turn: np.ndarray) -> None:
    q = rotated(straight(), turn) + np.tile([3.0, -20.0, 7.0, 0.0, 0.0, 0.0], 2)
    check_rigid_motion_is_free(one(points=points), q)


def test_control_moved_slope_is_not_rigid(turn: np.ndarray) -> None:
    """Translating all twelve coordinates, slopes included, is no rigid motion."""
    with pytest.raises(AssertionError):
        check_rigid_motion_is_free(one(), rotated(straight(), turn) + 0.01)


def check_objective(law: Callable[[np.ndarray], np.ndarray], q: np.ndarray, turn: np.ndarray) -> None:
    """Rotated coordinates give rotated forces."""
    expected = rotated(law(q), turn)
    np.testing.assert_allclose(law(rotated(q, turn)), expected, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("points", [3, 5])
def test_objectivity(points: int, turn: np.ndarray) -> None:
    elements, q = one(points=points), bent()
    check_objective(lambda q: forces(elements, q), q, turn)
    np.testing.assert_allclose(elements.energies(rotated(q, turn)), elements.energies(q), rtol=1e-13)


def test_control_linearised_element_is_not_objective(turn: np.ndarray) -> None:
    K = one().stiffness(straight())[0]
    with pytest.raises(AssertionError):
        check_objective(lambda q: K @ (q - straight()), bent(), turn)


def stretched_wire(turn: np.ndarray, stretch: float) -> tuple[Chain, np.ndarray]:
    """Return a straight wire of unequal elements in a generic direction, uniformly stretched."""
    knots = np.array([0.0, 0.1, 0.4, 2.8, 3.0, 10.0])
    nodes = np.arange(6 * knots.size, dtype=np.int64).reshape(-1, 6)
    direction = turn[:, 0]
    q = np.hstack((np.outer(stretch * knots, direction), np.tile(stretch * direction, (knots.size, 1))))
    return Chain(nodes, knots, Section(EA=3e4, EJ=6.0, rhoA=1.0)), q.ravel()


def check_uniform_stretch(elements: CableElements, chain: Chain, q: np.ndarray, force: np.ndarray) -> None:
    """Only the two end positions carry force."""
    f = forces(elements, q).reshape(-1, 2, 3)
    expected = np.zeros_like(f)
    expected[0, 0], expected[-1, 0] = -force, force
    np.testing.assert_allclose(f, expected, atol=1e-12 * chain.section.EA)


@pytest.mark.parametrize("points", [3, 5])
@pytest.mark.parametrize("stretch", [0.99, 1.0, 1.002, 1.3])
def test_patch_uniform_stretch(points: int, stretch: float, turn: np.ndarray) -> None:
    """N = EA eps is constant and the force in space is EA eps |r'|, on any mesh."""
    chain, q = stretched_wire(turn, stretch)
    N = chain.section.EA * 0.5 * (stretch**2 - 1.0)
    elements = CableElements.of([chain], points)
    check_uniform_stretch(elements, chain, q, N * stretch * turn[:, 0])
    np.testing.assert_allclose(
        elements.energies(q), np.outer(0.5 * N**2 / chain.section.EA * chain.L, [1, 0]), atol=1e-10
    )
    if stretch == 1.3:
        with pytest.raises(AssertionError):
            check_uniform_stretch(elements, chain, q, N * turn[:, 0])


def circle_energies(count: int, gauss_points: int = 5) -> np.ndarray:
    """Return both energies of a wire whose nodes and slopes lie on a circle of radius 2."""
    radius, length = 2.0, 5.0
    knots = np.linspace(0.0, length, count + 1)
    angle = knots / radius
    nodes = np.arange(6 * knots.size, dtype=np.int64).reshape(-1, 6)
    zero = np.zeros_like(angle)
    r = radius * np.column_stack((np.sin(angle), zero, 1.0 - np.cos(angle)))
    r1 = np.column_stack((np.cos(angle), zero, np.sin(angle)))
    elements = CableElements.of([Chain(nodes, knots, Section(EA=100.0, EJ=6.0, rhoA=1.0))], gauss_points)
    return elements.energies(np.hstack((r, r1)).ravel()).sum(axis=0)


def check_order(errors: np.ndarray, order: float) -> None:
    """Errors of a mesh doubled each time fall with the given order."""
    slope = -np.polyfit(np.arange(len(errors)), np.log2(np.abs(errors)), 1)[0]
    assert abs(slope - order) < 0.2, f"order {slope}"


def test_pure_bending_to_a_circle() -> None:
    """EJ L/(2 R^2) with order 4; the axial energy, which should be none, vanishes with order 8."""
    energies = np.array([circle_energies(count) for count in (8, 16, 32, 64)])
    exact = 6.0 * 5.0 / (2.0 * 2.0**2)
    check_order(energies[:, 1] - exact, 4.0)
    check_order(energies[:, 0], 8.0)
    np.testing.assert_allclose(energies[-1], [0.0, exact], atol=1e-7)
    with pytest.raises(AssertionError):
        check_order(energies[:, 1] - 1.0001 * exact, 4.0)


def dense(elements: CableElements, q: np.ndarray) -> np.ndarray:
    K = np.zeros((q.size, q.size))
    np.add.at(K, elements.pattern(), elements.stiffness(q).ravel())
    return K


def check_null_space(K: np.ndarray, dimension: int) -> None:
    size = np.abs(np.linalg.eigvalsh(K))
    assert np.sum(size < 1e-10 * size.max()) == dimension


@pytest.mark.parametrize("points", [3, 5])
@pytest.mark.parametrize("count", [1, 2, 5])
def test_no_spurious_modes(points: int, count: int, turn: np.ndarray) -> None:
    """Five rigid modes without strain (no spin about the axis), three translations when stretched."""
    chain, q = stretched_wire(turn, 1.0)
    chain = replace(chain, nodes=chain.nodes[: count + 1], knots=chain.knots[: count + 1])
    q = q[: 6 * (count + 1)]
    elements = CableElements.of([chain], points)
    check_null_space(dense(elements, q), 5)
    check_null_space(dense(elements, 1.003 * q), 3)


@pytest.mark.parametrize("points", [3, 5])
def test_infinitesimal_rotation_turns_the_forces(points: int) -> None:
    """K (w x q) = w x f: what replaces the three rotations of the null space when there are forces."""
    elements, q = one(points=points), bent()
    for w in np.eye(3):
        expected = np.cross(w, forces(elements, q).reshape(-1, 3)).ravel()
        found = elements.stiffness(q)[0] @ np.cross(w, q.reshape(-1, 3)).ravel()
        np.testing.assert_allclose(found, expected, atol=1e-11 * np.abs(elements.stiffness(q)).max())


def test_control_two_points_have_a_spurious_mode() -> None:
    """The kernel with two points has one mode too many (axial), and the element refuses them."""
    points, weights = gauss_legendre(2)
    unit = np.ones(1)
    L, axial, bending = (np.array([value]) for value in (LENGTH, EA, EJ))
    B1, B2 = shape_1(points, unit), shape_2(points, unit)
    K = cable_stiffness(straight(), np.arange(12)[None, :], L, axial, bending, B1, B2, weights)[0]
    with pytest.raises(AssertionError):
        check_null_space(K, 5)
    check_null_space(K, 6)
    with pytest.raises(InconsistentInputError, match="3 Gauss points"):
        one(points=2)


def test_batch_equals_single_elements(turn: np.ndarray) -> None:
    """Different lengths and stiffnesses in one batch, sharing nodes, in shuffled order."""
    rng = np.random.default_rng(8)
    z = rng.normal(size=40)
    dofs = np.array([rng.choice(40, 12, replace=False) for _ in range(4)])
    L, EA, EJ, rhoA = rng.uniform(0.5, 3.0, size=(4, 4))
    batch = CableElements(dofs, L, EA, EJ, rhoA)
    total = np.zeros(40)
    for k in range(4):
        single = CableElements(dofs[k : k + 1], L[k : k + 1], EA[k : k + 1], EJ[k : k + 1], rhoA[k : k + 1])
        single.add_residual(State.at_rest(z), total)
        np.testing.assert_array_equal(batch.stiffness(z)[k], single.stiffness(z)[0])
        np.testing.assert_array_equal(batch.energies(z)[k], single.energies(z)[0])
        np.testing.assert_array_equal(batch.mass()[k], single.mass()[0])
    np.testing.assert_allclose(forces(batch, z), total, rtol=1e-14)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(forces(replace(batch, L=L[::-1].copy()), z), total, rtol=1e-14)


def test_elements_of_chains() -> None:
    """`of` gives every element the constants of its own chain."""
    nodes = np.arange(36, dtype=np.int64).reshape(6, 6)
    first = Chain(nodes[:3], np.array([0.0, 1.0, 1.5]), Section(2.0, 3.0, 4.0))
    second = Chain(nodes[3:], np.array([5.0, 5.2, 9.0]), Section(20.0, 30.0, 40.0))
    batch = CableElements.of([first, second], 3)
    np.testing.assert_array_equal(batch.dofs, [np.arange(k, k + 12) for k in (0, 6, 18, 24)])
    np.testing.assert_allclose(batch.L, [1.0, 0.5, 0.2, 3.8], rtol=1e-14)
    for name, values in {"EA": [2, 2, 20, 20], "EJ": [3, 3, 30, 30], "rhoA": [4, 4, 40, 40]}.items():
        np.testing.assert_array_equal(getattr(batch, name), values)
    assert batch.gauss_points == 3


@pytest.mark.parametrize(
    "wrong",
    [{"length": 0.0}, {"length": -1.0}, {"EA": 0.0}, {"EJ": -1e-9}, {"EA": np.nan}, {"length": np.nan}],
)
def test_refuses_impossible_constants(wrong: dict[str, Any]) -> None:
    with pytest.raises(InconsistentInputError):
        one(**wrong)


def test_refuses_arrays_of_different_lengths() -> None:
    """The compiled loops would read beyond the shorter one."""
    single = np.ones(1)
    with pytest.raises(InconsistentInputError, match="12 dofs"):
        CableElements(np.arange(24).reshape(2, 12), single, single, single, single)
