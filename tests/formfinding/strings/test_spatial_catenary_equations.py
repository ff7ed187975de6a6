"""The elastic catenary in space against integration, its derivatives, and the equations of the whole line."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.formfinding.strings.sparse import matrix
from catenaria.formfinding.strings.spatial_catenary_equations import (
    _Equations,
    find_rest,
    spatial_catenary,
)
from catenaria.formfinding.strings.task import StringLine, string_line
from catenaria.line import Line

ONE = np.ones(1)
CASES = {
    "wire": ([14e3, 300.0, -480.0], 65.0, 6.0, (1.000002, 12.5e6)),
    "inclined dropper": ([2.0, -9.0, 80.0], 1.4, 0.87, (1.0, 1.19e6)),
    "vertical dropper": ([0.0, 0.0, 80.0], 1.4, 0.87, (1.0, 1.19e6)),
}


def integral(F: np.ndarray, L: complex, w: float, law: tuple[float, float]) -> np.ndarray:
    """Return the direction times the stretch, integrated by Gauss quadrature; analytic in F and L."""
    points, weights = np.polynomial.legendre.leggauss(20)
    s = 0.5 * (points + 1.0) * L
    inner = F[None, :] + np.outer(w * s, [0.0, 0.0, 1.0])
    T = np.sqrt(np.sum(inner * inner, axis=1))
    per_force = 0.5 * L * weights * (law[0] + T / law[1]) / T
    return per_force @ inner


@pytest.mark.parametrize("case", CASES)
def test_it_is_the_integral_of_its_direction_times_its_stretch(case: str) -> None:
    force, L, w, (c, E) = CASES[case]
    F = np.array(force)
    reach = spatial_catenary(F[None], L * ONE, w * ONE, (c * ONE, E * ONE)).r[0]
    np.testing.assert_allclose(reach, integral(F, L, w, (c, E)), rtol=0.0, atol=1e-10 * L)
    assert np.abs(reach - integral(F, L, 1.01 * w, (c, E))).max() > 1e-10 * L


@pytest.mark.parametrize("case", CASES)
def test_derivatives_are_exact(case: str) -> None:
    force, L, w, law = CASES[case]
    F = np.array(force)
    by = spatial_catenary(F[None], L * ONE, w * ONE, (law[0] * ONE, law[1] * ONE)).by[0]
    scale = np.abs(by).max(axis=0)
    for k in range(4):
        step = 1e-30j * (np.arange(4) == k)
        expected = np.imag(integral(F + step[:3], L + step[3], w, law)) / 1e-30
        np.testing.assert_allclose(by[:, k], expected, rtol=1e-9, atol=1e-9 * scale[k])


@pytest.mark.parametrize("which", ["paper", "uneven"])
def test_newtons_matrix_is_the_derivative_of_the_residual(task: StringLine, uneven: Line, which: str) -> None:
    equations = _Equations.of(task if which == "paper" else string_line(uneven, "test"))
    rng = np.random.default_rng(4)
    u = equations.start()
    elements = equations.node.shape[0]
    u[: 3 * elements] += rng.normal(scale=5.0, size=3 * elements)
    u[4 * elements :] += rng.normal(scale=0.01, size=u.size - 4 * elements)
    _, entries = equations.evaluate(u)
    direction = rng.normal(size=u.size) * np.where(equations.scale > 1.0, 1.0, 1e-3)
    h = 1e-3
    ahead, back = (equations.evaluate(u + sign * h * direction)[0] for sign in (1.0, -1.0))
    slope = matrix(entries, (u.size, u.size)) @ direction
    np.testing.assert_allclose(slope, (ahead - back) / (2.0 * h), rtol=1e-5, atol=1e-6)
    assert np.abs(1.01 * slope - (ahead - back) / (2.0 * h)).max() > 1e-3


def test_newton_converges_quadratically(task: StringLine) -> None:
    assert find_rest(task).iterations <= 6


def test_a_line_in_the_plane_stays_in_it(task: StringLine) -> None:
    """Whatever the lateral start, clamps come back to y = 0: the line has lateral stiffness."""
    equations = _Equations.of(task)
    found = find_rest(task).found
    k = task.x.size
    u = equations.start()
    u[4 * equations.node.shape[0] :][: 2 * k] = 0.05 * np.sin(np.arange(2 * k))
    for _ in range(12):
        f, entries = equations.evaluate(u)
        u = u - np.linalg.solve(matrix(entries, (u.size, u.size)).toarray(), f)
    assert np.abs(u[4 * equations.node.shape[0] :][: 2 * k]).max() < 1e-9
    np.testing.assert_allclose(equations.at_rest(u).unstressed, found.unstressed, atol=1e-9)
