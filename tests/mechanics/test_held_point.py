"""Held points: hinges of a wire's ends, and ends driven by a common parameter (20)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.measures import Height
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
SECTION, LENGTH, PULL = Section(EA=5e4, EJ=3.0, rhoA=1.0), 12.0, 0.03


def test_residual_by_hand() -> None:
    """One fixed point and two that share a parameter in opposite directions."""
    z = np.random.default_rng(5).normal(size=19)
    nodes, la = np.arange(9).reshape(3, 3), np.arange(9, 18).reshape(3, 3)
    X = np.random.default_rng(6).normal(size=(3, 3))
    n = np.array([[7.0, 7.0, 7.0], [-0.6, 0.0, 0.8], [0.6, 0.0, -0.8]])  # the first is not used
    f = np.zeros(19)
    HeldPoints(nodes, la, X, n, np.array([-1, 18, 18])).add_residual(State.at_rest(z), f)
    moved = X + np.array([0.0, z[18], z[18]])[:, None] * n
    np.testing.assert_allclose(f[9:18].reshape(3, 3), z[:9].reshape(3, 3) - moved, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(f[:9], z[9:18])
    assert f[18] == 0.0, "the parameter's equation belongs to its control"


def driven(
    lay_wire: Lay, turn: np.ndarray, signs: tuple[float, float]
) -> tuple[System, Chain, np.ndarray, int]:
    """Return an unstrained wire whose ends move by one parameter along its axis, with the given signs.

    The control is there because every parameter needs an equation; the tests keep the parameter at PULL.
    """
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], LENGTH * turn[:, 0], np.linspace(0.0, LENGTH, 7), SECTION)
    la = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    p = builder.add(Kind.PARAMETER, np.array([PULL]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    directions = np.outer(signs, turn[:, 0])
    held = HeldPoints(nodes, la, table.start[nodes], directions, np.repeat(p, 2))
    control = Controls(p, Height(nodes[:1, 2]), np.zeros(1), VelocityLaw(1.0, 0.0, 1.0), Ramp(0.0), Ramp(0.0))
    return System(table, (CableElements.of([wire]), held, control)), wire, la, int(p[0])


def check_tightened(z: np.ndarray, wire: Chain, la: np.ndarray, turn: np.ndarray) -> None:
    """Both ends move outwards by p; the devices feel EA eps |r'|, the force of the node on what holds it."""
    ends = z[wire.nodes[[0, -1], :3]] @ turn
    np.testing.assert_allclose(ends, [[-PULL, 0.0, 0.0], [LENGTH + PULL, 0.0, 0.0]], atol=1e-12)
    a = 1.0 + 2.0 * PULL / LENGTH
    T = SECTION.EA * 0.5 * (a * a - 1.0) * a
    np.testing.assert_allclose(z[la], [T * turn[:, 0], -T * turn[:, 0]], rtol=1e-9, atol=1e-6)


def test_shared_parameter_tightens_from_both_ends(
    lay_wire: Lay, solve_statics: Solve, turn: np.ndarray
) -> None:
    system, wire, la, p = driven(lay_wire, turn, (-1.0, 1.0))
    start = system.unknowns.start.copy()
    start[wire.nodes] *= 1.001  # a little tension, or a straight wire has no stiffness across
    _, z = solve_statics(system, start, [p])
    check_tightened(z, wire, la, turn)


def test_control_equal_signs_only_shift_the_wire(
    lay_wire: Lay, solve_statics: Solve, turn: np.ndarray
) -> None:
    system, wire, la, p = driven(lay_wire, turn, (1.0, 1.0))
    start = system.unknowns.start.copy()
    start[wire.nodes] *= 1.001
    _, z = solve_statics(system, start, [p])
    np.testing.assert_allclose(z[la], 0.0, atol=1e-6)
    with pytest.raises(AssertionError):
        check_tightened(z, wire, la, turn)


def test_rate_is_the_papers_velocity_constraint(turn: np.ndarray) -> None:
    """C is linear in r and p, so dC/dt = r' - p' n is (20) with p' = v_c, whatever the position."""
    nodes, la, p = np.arange(3)[None, :], np.arange(3, 6)[None, :], np.array([6])
    part = HeldPoints(nodes, la, np.ones((1, 3)), turn[:, :1].T, p)
    rng = np.random.default_rng(8)
    z, rate = rng.normal(size=7), rng.normal(size=7)
    at = []
    for step in (-1.0, 1.0):
        f = np.zeros(7)
        part.add_residual(State.at_rest(z + step * rate), f)
        at.append(f[3:6])
    np.testing.assert_allclose(0.5 * (at[1] - at[0]), rate[:3] - rate[6] * turn[:, 0], atol=1e-13)
