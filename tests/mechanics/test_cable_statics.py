"""Static solutions of cable elements against closed forms, with orders of convergence."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import root

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
G = 9.81


def check_order(sizes: Sequence[int], errors: Sequence[float], order: float, cap: float) -> None:
    """The errors fall with the given order in the mesh width, and the last one is below the cap."""
    slope = -np.polyfit(np.log(np.asarray(sizes, dtype=float)), np.log(np.asarray(errors)), 1)[0]
    assert abs(slope - order) < 0.2, f"order {slope} instead of {order}, errors {errors}"
    assert errors[-1] < cap, f"last error {errors[-1]}"


def dense_points(chain: Chain) -> np.ndarray:
    """Return material coordinates that are nowhere special in the elements."""
    return np.linspace(chain.knots[0], chain.knots[-1], 997)


def cantilever_error(lay_wire: Lay, solve_statics: Solve, count: int, stiffer: float = 1.0) -> float:
    """Return the largest error of a cantilever's small sag under its weight, relative to the tip's."""
    section, L = Section(EA=1e5, EJ=10.0, rhoA=1e-5), 2.0
    builder = UnknownsBuilder()
    chain = lay_wire(builder, [0, 0, 0], [L, 0, 0], np.linspace(0.0, L, count + 1), section)
    elements = CableElements.of([chain])
    table = builder.build()
    system = System(table, (elements, Gravity(elements.weight(table.size), G, Ramp(0.0))))
    clamped = np.concatenate((chain.nodes[0, :3], chain.nodes[0, 4:]))
    _, z = solve_statics(system, table.start, clamped)
    s, w = dense_points(chain), section.rhoA * G
    exact = -w / (24.0 * section.EJ * stiffer) * s**2 * (s**2 - 4.0 * L * s + 6.0 * L**2)
    return float(np.abs(chain.evaluate(z, s).r[:, 2] - exact).max() / (w * L**4 / 8.0 / section.EJ))


def test_cantilever(lay_wire: Lay, solve_statics: Solve) -> None:
    """Deflection q s^2 (s^2 - 4 L s + 6 L^2)/(24 EJ); the cubic misses the quartic with order 4."""
    sizes = [2, 4, 8, 16]
    errors = [cantilever_error(lay_wire, solve_statics, count) for count in sizes]
    check_order(sizes, errors, 4.0, 1e-6)


def test_control_cantilever_of_wrong_stiffness(lay_wire: Lay, solve_statics: Solve) -> None:
    sizes = [2, 4, 8, 16]
    errors = [cantilever_error(lay_wire, solve_statics, count, stiffer=1.001) for count in sizes]
    with pytest.raises(AssertionError):
        check_order(sizes, errors, 4.0, 1e-6)


def held_wire(
    lay_wire: Lay, start: Sequence[float], end: Sequence[float], knots: np.ndarray, section: Section
) -> tuple[Chain, System, np.ndarray]:
    """Return a wire with gravity between two hinges, and the multipliers of the hinges, shape (2, 3)."""
    builder = UnknownsBuilder()
    chain = lay_wire(builder, start, end, knots, section)
    la = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    table = builder.build()
    elements = CableElements.of([chain])
    ends = chain.nodes[[0, -1], :3]
    hinges = HeldPoints(ends, la, table.start[ends], np.zeros((2, 3)), np.array([-1, -1]))
    return chain, System(table, (elements, Gravity(elements.weight(table.size), G, Ramp(0.0)), hinges)), la


def tensioned_beam_error(lay_wire: Lay, solve_statics: Solve, count: int, softer: float = 1.0) -> float:
    """Return the largest error of a tensioned beam's small sag between hinges, relative to the string's.

    In material coordinates of a wire stretched by a: D w'''' - N w'' = -q with D = EJ/a^4
    (curvature by arc length) and N = EA (a^2 - 1)/2; decay length sqrt(D/N).
    """
    section, L, stretch = Section(EA=1e4, EJ=60.0, rhoA=1e-7), 4.0, 1.02
    knots = np.linspace(0.0, L, count + 1)
    chain, system, _ = held_wire(lay_wire, [0, 0, 0], [stretch * L, 0, 0], knots, section)
    _, z = solve_statics(system, system.unknowns.start)
    D, N, w = softer * section.EJ / stretch**4, 0.5 * section.EA * (stretch**2 - 1.0), section.rhoA * G
    decay, x = np.sqrt(D / N), dense_points(chain) - 0.5 * L
    edge = np.cosh(x / decay) / np.cosh(0.5 * L / decay)
    exact = w / N * (0.5 * (x**2 - 0.25 * L**2) + decay**2 * (1.0 - edge))
    return float(np.abs(chain.evaluate(z, x + 0.5 * L).r[:, 2] - exact).max() / (w * L**2 / 8.0 / N))


def test_tensioned_beam(lay_wire: Lay, solve_statics: Solve) -> None:
    """Order 4 once the elements are shorter than the decay length, 0.53 m here."""
    sizes = [15, 30, 60]
    errors = [tensioned_beam_error(lay_wire, solve_statics, count) for count in sizes]
    check_order(sizes, errors, 4.0, 1e-6)


def test_control_tensioned_beam_of_wrong_decay_length(lay_wire: Lay, solve_statics: Solve) -> None:
    sizes = [15, 30, 60]
    errors = [tensioned_beam_error(lay_wire, solve_statics, count, softer=1.01) for count in sizes]
    with pytest.raises(AssertionError):
        check_order(sizes, errors, 4.0, 1e-6)


def green_stretch(T: np.ndarray | float, EA: float) -> np.ndarray:
    """Return a with EA a (a^2 - 1)/2 = T: true tension and Green strain."""
    a = 1.0 + np.asarray(T) / EA
    for _ in range(30):
        a = a - (0.5 * EA * a * (a * a - 1.0) - T) / (0.5 * EA * (3.0 * a * a - 1.0))
    return a


def green_catenary(
    section: Section, L: float, span: tuple[float, float], s: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return x, z of a perfectly flexible wire at s, and the force on its start, by quadrature."""
    w = section.rhoA * G

    def slope(arc: float, force: np.ndarray) -> np.ndarray:
        pull = np.array([-force[0], -force[1] + w * arc])
        T = float(np.linalg.norm(pull))
        return green_stretch(T, section.EA) * pull / T

    def shape(force: np.ndarray, at: np.ndarray) -> np.ndarray:
        options = {"rtol": 1e-12, "atol": 1e-12, "method": "DOP853"}
        return solve_ivp(lambda arc, _: slope(arc, force), (0.0, L), [0.0, 0.0], t_eval=at, **options).y

    found = root(lambda force: shape(force, np.array([L]))[:, 0] - span, [-w * L, w * L / 2.0], tol=1e-12)
    assert found.success
    return shape(found.x, s).T, found.x


def hanging_wire(lay_wire: Lay, solve_statics: Solve, EJ: float) -> tuple[Chain, np.ndarray, np.ndarray]:
    """Return a solved slack wire of 31 m between hinges 30 m and 2 m apart, and its end forces."""
    section = Section(EA=2e4, EJ=EJ, rhoA=1.0)
    chain, system, la = held_wire(lay_wire, [0, 0, 0], [30, 0, 2], np.linspace(0.0, 31.0, 63), section)
    start = system.unknowns.start.copy()
    start[chain.nodes[:, 2]] -= 3.0 * np.sin(np.pi * chain.knots / 31.0)
    start[chain.nodes[:, 5]] -= 3.0 * np.pi / 31.0 * np.cos(np.pi * chain.knots / 31.0)
    _, z = solve_statics(system, start)
    return chain, z, -z[la]


def check_catenary(chain: Chain, z: np.ndarray, end_force: np.ndarray, EA: float) -> None:
    """Shape to 0.05 mm and force to 0.05 N of the flexible wire with Green strain."""
    section = Section(EA, 0.0, chain.section.rhoA)
    s = dense_points(chain)
    exact, force = green_catenary(section, 31.0, (30.0, 2.0), s)
    np.testing.assert_allclose(chain.evaluate(z, s).r[:, [0, 2]], exact, atol=5e-5)
    np.testing.assert_allclose(end_force[0, [0, 2]], force, atol=0.05)


def test_elastic_catenary(lay_wire: Lay, solve_statics: Solve) -> None:
    chain, z, end_force = hanging_wire(lay_wire, solve_statics, EJ=1e-6)
    check_catenary(chain, z, end_force, EA=2e4)
    np.testing.assert_allclose(end_force.sum(axis=0), [0.0, 0.0, 31.0 * G], atol=1e-8)
    with pytest.raises(AssertionError):
        check_catenary(chain, z, end_force, EA=1.9e4)


def test_elastic_catenary_closed_form(lay_wire: Lay, solve_statics: Solve) -> None:
    """Irvine (1981), engineering strain, from the found end force: the laws differ by 3/2 eps^2."""
    chain, z, end_force = hanging_wire(lay_wire, solve_statics, EJ=1e-6)
    H, V, w, EA = -end_force[0, 0], -end_force[0, 2], G, 2e4
    s = dense_points(chain)
    x = H * s / EA + H / w * (np.arcsinh((V + w * s) / H) - np.arcsinh(V / H))
    height = (V * s + 0.5 * w * s**2) / EA + (np.hypot(H, V + w * s) - np.hypot(H, V)) / w
    r = chain.evaluate(z, s).r
    eps = np.hypot(H, V + w * s).max() / EA
    bound = 1.5 * eps**2 * 31.0 + 2e-4
    assert np.abs(np.column_stack((x, height)) - r[:, [0, 2]]).max() < bound
    assert np.abs(H * s / EA).max() > 10.0 * bound, (
        "the stretch must be seen, or the inextensible form would do"
    )
