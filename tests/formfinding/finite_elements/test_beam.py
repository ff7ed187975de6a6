"""The tensioned beam: derivatives by complex step, rigid motions, closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from catenaria.formfinding.finite_elements import beam
from catenaria.formfinding.finite_elements.beam import Section

WIRE = Section(EA=1.25e7, EJ=311.0, weight=6.03)
STEP = 1e-30


@pytest.fixture
def elements() -> tuple[np.ndarray, np.ndarray]:
    """Elements of many lengths and directions, bent by up to a third of a radian."""
    random = np.random.default_rng(7)
    q = np.zeros((40, 6))
    q[:, 0] = random.uniform(-3.0, 3.0, 40)
    q[:, 3] = q[:, 0] + random.uniform(0.05, 3.0, 40)
    q[:, [1, 4]] = random.uniform(-0.3, 0.3, (40, 2))
    q[:, [2, 5]] = random.uniform(-0.3, 0.3, (40, 2))
    return q, 0.998 * np.hypot(q[:, 3] - q[:, 0], q[:, 4] - q[:, 1])


def by_complex_step(q: np.ndarray, L: np.ndarray) -> np.ndarray:
    """Return the derivatives of the force by the six coordinates and the length, shape (n, 6, 7)."""
    columns = [np.imag(beam.force(q + 1j * STEP * np.eye(6)[i], L, WIRE)) / STEP for i in range(6)]
    columns.append(np.imag(beam.force(q.astype(complex), L + 1j * STEP, WIRE)) / STEP)
    return np.stack(columns, axis=2)


def relative_error(elements: tuple[np.ndarray, np.ndarray], factor: float = 1.0) -> float:
    """Return by how much tangent and complex step differ; the factor spoils one entry."""
    q, L = elements
    K, f_L = beam.tangent(q, L, WIRE)
    K[:, 1, 1] *= factor
    exact = by_complex_step(q, L)
    ours = np.concatenate((K, f_L[:, :, None]), axis=2)
    return float(np.max(np.abs(ours - exact) / np.abs(exact).max(axis=(1, 2))[:, None, None]))


def test_the_tangent_is_that_of_the_force(elements: tuple[np.ndarray, np.ndarray]) -> None:
    assert relative_error(elements) < 1e-13


def test_a_spoilt_tangent_is_noticed(elements: tuple[np.ndarray, np.ndarray]) -> None:
    assert relative_error(elements, 1.001) > 1e-5


def test_the_tangent_is_symmetric(elements: tuple[np.ndarray, np.ndarray]) -> None:
    K, _ = beam.tangent(*elements, WIRE)
    np.testing.assert_allclose(K, K.swapaxes(1, 2), rtol=0, atol=1e-12 * np.abs(K).max())


def test_rigid_motions_do_no_work(elements: tuple[np.ndarray, np.ndarray]) -> None:
    q, L = elements
    f = beam.force(q, L, Section(WIRE.EA, WIRE.EJ, 0.0))
    moment = f[:, 2] + f[:, 5] + q[:, 0] * f[:, 1] + q[:, 3] * f[:, 4] - q[:, 1] * f[:, 0] - q[:, 4] * f[:, 3]
    size = np.abs(f).max()
    np.testing.assert_allclose(f[:, :2] + f[:, 3:5], 0.0, atol=1e-12 * size)
    np.testing.assert_allclose(moment, 0.0, atol=1e-11 * size)


def test_weight_is_that_of_the_unstressed_length(elements: tuple[np.ndarray, np.ndarray]) -> None:
    q, L = elements
    heavy, light = (beam.force(q, L, Section(WIRE.EA, WIRE.EJ, w)) for w in (10.0, 0.0))
    np.testing.assert_allclose((heavy - light)[:, [1, 4]].sum(axis=1), 10.0 * L, rtol=1e-6)


def test_a_straight_bar_pulls_by_green_strain() -> None:
    q = np.array([[0.0, 0.0, 0.0, 2.002, 0.0, 0.0]])
    x = 1.001
    f = beam.force(q, np.array([2.0]), Section(WIRE.EA, WIRE.EJ, 0.0))
    assert f[0, 3] == pytest.approx(0.5 * WIRE.EA * (x * x - 1.0) * x, rel=1e-12)
    assert f[0, [1, 2, 4, 5]] == pytest.approx(0.0)


@pytest.mark.parametrize("turn", [(0.05, -0.05), (0.08, 0.02), (0.0, -0.1)])
def test_the_arc_is_that_of_the_cubic(turn: tuple[float, float]) -> None:
    """A cubic in the arc length whose slopes have the size of its mean stretch, integrated numerically."""
    arc = 1.0
    for _ in range(20):
        slopes = arc * np.array([[np.cos(angle), np.sin(angle)] for angle in turn])

        def speed(t: float, slopes: np.ndarray = slopes) -> float:
            middle = np.array([6.0 * t * (1.0 - t), 0.0])
            return float(
                np.linalg.norm(middle + (1 - 4 * t + 3 * t * t) * slopes[0] + (3 * t * t - 2 * t) * slopes[1])
            )

        arc = quad(speed, 0.0, 1.0, epsabs=1e-14)[0]
    ours = float(beam.arc_length(np.array([[0.0, 0.0, turn[0], 1.0, 0.0, turn[1]]]))[0])
    size = max(abs(angle) for angle in turn)
    assert ours == pytest.approx(arc, abs=0.1 * size**6)
    second_order = 1.0 + (2 * turn[0] ** 2 - turn[0] * turn[1] + 2 * turn[1] ** 2) / 30.0
    assert abs(second_order - arc) > 10.0 * abs(ours - arc)


def deflection(elements: int, T: float) -> float:
    """Return by how much a force of 10 N in the middle deflects a hinged beam of 2 m under tension T."""
    x = np.linspace(0.0, 2.0, elements + 1)
    L = np.diff(x) / (1.0 + T / WIRE.EA * (1.0 - 1.5 * T / WIRE.EA))
    q = np.column_stack((x[:-1], 0 * L, 0 * L, x[1:], 0 * L, 0 * L))
    K, _ = beam.tangent(q, L, Section(WIRE.EA, WIRE.EJ, 0.0))
    full = np.zeros((3 * (elements + 1), 3 * (elements + 1)))
    for e in range(elements):
        full[3 * e : 3 * e + 6, 3 * e : 3 * e + 6] += K[e]
    free = [i for i in range(full.shape[0]) if i not in (0, 1, full.shape[0] - 3, full.shape[0] - 2)]
    load = np.zeros(full.shape[0])
    load[3 * (elements // 2) + 1] = 10.0
    moved = np.zeros_like(load)
    moved[free] = np.linalg.solve(full[np.ix_(free, free)], load[free])
    return float(moved[3 * (elements // 2) + 1])


def test_a_tensioned_beam_deflects_by_its_closed_form() -> None:
    """F l/(4 T) (1 - tanh(u)/u), u = l/2 sqrt(T/EJ): Timoshenko, tie rod with a load in the middle."""
    T = 15e3
    u = np.sqrt(T / WIRE.EJ)
    exact = 10.0 * 2.0 / (4.0 * T) * (1.0 - np.tanh(u) / u)
    coarse, fine = deflection(10, T), deflection(40, T)
    assert fine == pytest.approx(exact, rel=2e-3)
    assert abs(fine - exact) < abs(coarse - exact)
    string = 10.0 * 2.0 / (4.0 * T)
    assert abs(string - exact) > 0.1 * exact
