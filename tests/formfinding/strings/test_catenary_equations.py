"""The elastic catenary against the chain, against integration, and the exactness of its derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.catenary.green_bar import stretch
from catenaria.catenary.hanging_chain import hanging_chain
from catenaria.formfinding.strings import catenary_equations
from catenaria.formfinding.strings.axial_law import tangent_law
from catenaria.formfinding.strings.catenary_equations import elastic_catenary
from catenaria.formfinding.strings.task import StringLine

ONE = np.ones(1)


def test_without_stretch_it_is_the_chain() -> None:
    x, z, dx, dz = hanging_chain(np.array([0.0, 70.0]), 65.0, 1.5, 70.0)
    H = 900.0
    w = H * (dz[1] / dx[1] - dz[0] / dx[0]) / 70.0
    reach = elastic_catenary(H * ONE, H * dz[:1] / dx[:1], 70.0 * ONE, w, (1.0, np.inf))
    assert float(reach.dx[0]) == pytest.approx(x[1], abs=1e-9)
    assert float(reach.dz[0]) == pytest.approx(z[1], abs=1e-9)
    off = elastic_catenary(H * ONE, H * dz[:1] / dx[:1], 70.0 * ONE, 1.01 * w, (1.0, np.inf))
    assert abs(float(off.dx[0]) - x[1]) > 1e-3


def test_it_is_the_integral_of_its_direction_times_its_stretch() -> None:
    """Green strain, by Gauss quadrature, against the law that touches it at 15 kN."""
    H, V, L, w, EA = 14.99e3, -480.0, 65.0, 6.03, 12.5e6
    points, weights = np.polynomial.legendre.leggauss(20)
    up = V + 0.5 * (points + 1.0) * w * L
    T = np.hypot(H, up)
    per_force = 0.5 * L * weights * stretch(T, EA) / T
    reach = elastic_catenary(H * ONE, V * ONE, L * ONE, w, tangent_law(15e3, EA))
    assert float(reach.dx[0]) == pytest.approx(float(np.sum(per_force)) * H, abs=1e-9)
    assert float(reach.dz[0]) == pytest.approx(float(per_force @ up), abs=1e-9)
    hooke = elastic_catenary(H * ONE, V * ONE, L * ONE, w, (1.0, EA))
    assert abs(float(hooke.dx[0] - reach.dx[0])) > 0.1e-3  # negative control: the law matters


def test_derivatives_are_exact() -> None:
    u, law = np.array([14e3, -300.0, 40.0]), tangent_law(15e3, 12.5e6)
    H, V, L = (value * ONE for value in u)
    reach = elastic_catenary(H, V, L, 6.0, law)
    for i in range(3):
        step = 1e-30j * (np.arange(3) == i)
        dx, dz = _complex_reach(u + step, 6.0, law)
        assert float(reach.dx_u[i][0]) == pytest.approx(dx.imag / 1e-30, rel=1e-11)
        assert float(reach.dz_u[i][0]) == pytest.approx(dz.imag / 1e-30, rel=1e-11)


def _complex_reach(u: np.ndarray, w: float, law: tuple[float, float]) -> tuple[complex, complex]:
    """The formulas of the docstring, with functions that are analytic."""
    (H, V, L), (c, E) = u, law
    V_j = V + w * L
    T_i, T_j = np.sqrt(H * H + V * V), np.sqrt(H * H + V_j * V_j)
    dx = H * (c / w * (np.log((T_j + V_j) / H) - np.log((T_i + V) / H)) + L / E)
    return dx, c / w * (T_j - T_i) + L * (V + V_j) / (2.0 * E)


@pytest.mark.parametrize("at_end", [False, True])
@pytest.mark.parametrize("wire", ["contact", "messenger"])
def test_newtons_matrix_is_the_derivative_of_the_residual(task: StringLine, wire: str, at_end: bool) -> None:
    chosen = replace(getattr(task, wire), at_end=at_end)
    joints = chosen.joints(task.x)
    z = np.interp(joints.x, chosen.support_x, chosen.support_z)
    hanging = (task, np.full(task.x.size, 80.0)) if wire == "messenger" else None
    equations = catenary_equations._Equations(chosen, joints, z, hanging)
    rng = np.random.default_rng(1)
    u = equations.start() * (1.0 + 1e-3 * rng.normal(size=(joints.x.size - 1, 4)))
    u[:, 1] = rng.normal(scale=300.0, size=u.shape[0])
    _, band = equations.evaluate(u)
    direction = rng.normal(size=u.shape) * np.array([100.0, 100.0, 0.01, 0.01])
    h = 1e-3
    slope = (equations.evaluate(u + h * direction)[0] - equations.evaluate(u - h * direction)[0]) / (2 * h)
    n, k = u.size, catenary_equations._BAND
    dense = np.zeros((n, n))
    for j in range(n):
        rows = np.arange(max(0, j - k), min(n, j + k + 1))
        dense[rows, j] = band[k + rows - j, j]
    np.testing.assert_allclose((dense @ direction.ravel()).reshape(u.shape), slope, rtol=1e-6, atol=1e-6)
    assert np.abs((1.01 * dense @ direction.ravel()).reshape(u.shape) - slope).max() > 0.1


def test_newton_converges_quadratically(task: StringLine) -> None:
    """A wrong matrix would still converge, but not within five iterations a wire."""
    assert catenary_equations.find_rest(task).iterations <= 10
