"""Equations of wire and line: derivatives by complex step, and a catenary in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements.beam import Section
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.rest import LineState, come_to_rest
from catenaria.formfinding.finite_elements.start import laid_out, parabolic_start
from catenaria.formfinding.finite_elements.wire import WireMesh
from catenaria.formfinding.finite_elements.wire_system import WireSystem

STEP = 1e-30


@pytest.fixture(scope="module")
def rest(system: LineSystem) -> LineState:
    y, unstressed = parabolic_start(system)
    return come_to_rest(system, unstressed, y)


def disturbed(y: np.ndarray) -> np.ndarray:
    return y + 1e-4 * np.random.default_rng(3).standard_normal(y.size)


@pytest.mark.parametrize("given", ["tensions", "pulls"])
def test_the_jacobian_is_that_of_the_residual(system: LineSystem, given: str) -> None:
    y, unstressed = parabolic_start(system)
    own = system if given == "tensions" else system.pulled(0.1, 0.09)
    y = disturbed(y)
    ours, complex_y = own.jacobian(y, unstressed).toarray(), y.astype(complex)
    for column in [*np.random.default_rng(4).choice(own.size, 150, replace=False).tolist(), own.size - 1]:
        step = np.zeros_like(complex_y)
        step[column] = 1j * STEP
        exact = np.imag(own.residual(complex_y + step, unstressed)) / STEP
        np.testing.assert_allclose(ours[:, column], exact, rtol=0, atol=1e-11 * max(1.0, np.abs(exact).max()))


def test_the_derivative_by_lengths_is_that_of_the_residual(system: LineSystem) -> None:
    y, unstressed = parabolic_start(system)
    step = np.zeros(unstressed.size, dtype=complex)
    step[4] = 1j * STEP
    exact = np.imag(system.residual(y.astype(complex), unstressed + step)) / STEP
    np.testing.assert_allclose(system.by_length(y, unstressed)[:, 4], exact, rtol=1e-12, atol=1e-8)


def test_what_a_length_changes(rest: LineState) -> None:
    change = np.zeros(rest.unstressed.size)
    change[5] = 1e-5
    up, down = (come_to_rest(rest.system, rest.unstressed + sign * change, rest.y) for sign in (1, -1))
    height, force = (up.height - down.height) / 2e-5, (up.foot_force - down.foot_force) / 2e-5
    np.testing.assert_allclose(rest.height_by_parameter[:, 5], height, atol=1e-6)
    np.testing.assert_allclose(rest.foot_force_by_length[:, 5], force, atol=1e-2)


def test_what_a_pull_changes(rest: LineState) -> None:
    pulls = [float(part[-1]) for part in rest.system.parts(rest.y)]
    state = come_to_rest(rest.system.pulled(*pulls), rest.unstressed, rest.y)
    moved = [
        come_to_rest(rest.system.pulled(pulls[0], pulls[1] + d), rest.unstressed, rest.y)
        for d in (1e-5, -1e-5)
    ]
    exact = (moved[0].tension - moved[1].tension) / 2e-5
    np.testing.assert_allclose(state.tension_by_parameter[:, -1], exact, rtol=1e-5, atol=0.1)
    assert state.tension == pytest.approx([15e3, 15e3], abs=1e-6)


def test_a_dropper_of_no_length_is_refused(rest: LineState) -> None:
    refused = "dropper 3 of the line would have to be shorter than nothing"
    with pytest.raises(NotConvergedError, match=refused):
        come_to_rest(rest.system, rest.unstressed * (np.arange(rest.unstressed.size) != 2), rest.y)


TENSION = 6e3


def hanging_wire(weight: float) -> WireSystem:
    """Return a wire without bending stiffness over two supports 65 m apart, finely meshed at its kinks."""
    fine = np.geomspace(1e-3, 2.0, 12)
    x = np.unique(np.concatenate((-fine[fine < 0.4], [-0.5, 0.0], fine, np.linspace(4.0, 32.5, 20))))
    x = np.concatenate((x, 65.0 - x[-2::-1]))
    support = np.searchsorted(x, [0.0, 65.0])
    both = np.array([True, True])
    return WireSystem(
        WireMesh("wire", Section(1.25e7, 0.0, weight), 0.0, x, support, both, 0.0, 0.5, TENSION, True)
    )


def sag(weight: float) -> float:
    """Return the depth of the wire in the middle of its span."""
    wire = hanging_wire(weight)
    x = wire.mesh.x
    inside = (x >= 0.0) & (x <= 65.0)
    z = -0.5 * weight / TENSION * np.where(inside, x * (65.0 - x), 0.0)
    y = laid_out(wire, z, -0.5 * weight / TENSION * np.where(inside, 65.0 - 2.0 * x, 0.0))
    for _ in range(30):
        y = y - np.linalg.solve(wire.jacobian(y).toarray(), wire.residual(y, np.zeros(0)))
    return -float(wire.coordinates(y)[x.size // 2, 1])


def test_a_wire_hangs_in_a_catenary() -> None:
    """H/w (cosh(w l/2H) - 1), with H cosh(w l/2H) = T at the supports and w per stretched length."""
    w, H = 6.0 / (1.0 + TENSION / 1.25e7), TENSION
    for _ in range(50):
        H = TENSION / np.cosh(0.5 * w * 65.0 / H)
    exact = H / w * (np.cosh(0.5 * w * 65.0 / H) - 1.0)
    assert sag(6.0) == pytest.approx(exact, abs=2e-5)
    assert abs(sag(6.01) - exact) > 2e-4
