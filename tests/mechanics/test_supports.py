"""Supports: the frictionless joint as a special case, springs, and Coulomb friction against the belt."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.joints.supports import Supports
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
SECTION = Section(EA=1e5, EJ=20.0, rhoA=1.0)
SPAN, UNSTRESSED, START = 16.0, 15.9, 5.2
AT = np.array([5.0, 0.3, 0.4])
RIGID = np.zeros((1, 3, 3))


def dense(part: Contribution, state: State) -> np.ndarray:
    matrix = np.zeros((state.z.size, state.z.size))
    np.add.at(matrix, part.pattern(), part.jacobian(state, 0.0, 0.0))
    return matrix


def pair(friction: float, on_nodes: bool) -> tuple[SlidingJoints, Supports, State]:
    """Return frictionless joints and supports of the same points, and a generic state."""
    wire = Chain(np.arange(18).reshape(3, 6), np.array([0.0, 1.0, 2.5]), SECTION)
    s, la, nodes = np.array([18, 19]), np.arange(20, 26).reshape(2, 3), np.arange(26, 32).reshape(2, 3)
    X = np.random.default_rng(1).normal(size=(2, 3))
    joints = SlidingJoints(wire, s, la, np.array([0, 1]), X, nodes if on_nodes else None)
    one = np.full(2, friction)
    supports = Supports(wire, s, la, joints.element, X, np.zeros((2, 3, 3)), one, joints.nodes)
    z = np.random.default_rng(2).normal(size=32)
    z[s] = [0.4, 1.7]
    return joints, supports, State.at_rest(z)


@pytest.mark.parametrize("on_nodes", [False, True])
def test_rigid_frictionless_supports_are_sliding_joints(on_nodes: bool) -> None:
    joints, supports, state = pair(0.0, on_nodes)
    f, g = np.zeros(32), np.zeros(32)
    joints.add_residual(state, f)
    supports.add_residual(state, g)
    np.testing.assert_array_equal(f, g)
    np.testing.assert_array_equal(dense(joints, state), dense(supports, state))
    rough = pair(0.1, on_nodes)[1]
    rough.add_residual(state, h := np.zeros(32))
    assert np.abs(h - f)[joints.s].min() > 1e-3
    np.testing.assert_array_equal(np.delete(h, joints.s), np.delete(f, joints.s))


def test_supports_of_strands_are_those_of_the_chain() -> None:
    joints, supports, state = pair(0.2, False)
    strands = Strands.on((joints.wire,), np.zeros(2, dtype=np.int64))
    np.testing.assert_array_equal(dense(supports, state), dense(replace(supports, carrier=strands), state))


def test_no_force_is_no_special_case() -> None:
    """At la = 0, where |la| has a kink, nothing is undefined, and the row is the frictionless one."""
    joints, supports, state = pair(0.3, False)
    state.z[supports.multipliers] = 0.0
    f = np.zeros(32)
    supports.add_residual(state, f)
    assert np.all(f[supports.s] == 0.0)
    np.testing.assert_array_equal(dense(joints, state), dense(supports, state))


def test_what_cannot_be_is_refused() -> None:
    supports = pair(0.2, False)[1]
    for friction in (np.array([0.1, 1.0]), np.array([np.nan, 0.0]), np.zeros(1)):
        with pytest.raises(InconsistentInputError):
            replace(supports, friction=friction)
    with pytest.raises(InconsistentInputError, match="3 by 3"):
        replace(supports, compliance=np.zeros((2, 3)))


@dataclass(frozen=True)
class Held:
    """An equilibrium of a wire between two hinges that a support holds aside."""

    pulls: np.ndarray
    la: np.ndarray
    r: np.ndarray


def held(
    lay_wire: Lay, solve_statics: Solve, X: np.ndarray, friction: float, compliance: np.ndarray = RIGID
) -> Held:
    """Solve with a mesh that is fine about the support; `pulls` are the wire's forces on its hinges."""
    fine = START - 2.013 + 0.05 * np.arange(80)
    knots = np.concatenate((np.linspace(0.0, fine[0], 13)[:-1], fine, np.linspace(7.3, UNSTRESSED, 35)))
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], [SPAN, 0, 0], knots, SECTION)
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    la = builder.add(Kind.MULTIPLIER, np.zeros((1, 3)))
    s = builder.add(Kind.SLIDING, np.array([START]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    at = wire.locate(np.array([START]))
    support = Supports(wire, s, la, at, X[None, :], compliance, np.array([friction]))
    _, z = solve_statics(System(table, (CableElements.of([wire]), hinges, support)), table.start)
    return Held(z[ends], z[la][0], wire.evaluate(z, z[s]).r[0])


def check_friction(found: Held, friction: float) -> None:
    """T2 = T1 + f |la|, and the belt equation T2 = T1 exp(mu angle) with f = sin(atan mu)."""
    T1, T2 = np.linalg.norm(found.pulls, axis=1)
    np.testing.assert_allclose(found.la, -found.pulls.sum(axis=0), atol=1e-7)
    np.testing.assert_allclose(T2 - T1, friction * np.linalg.norm(found.la), rtol=1e-2)
    angle = np.arccos(-found.pulls[0] @ found.pulls[1] / (T1 * T2))
    assert 0.1 < angle < 0.2
    np.testing.assert_allclose(np.log(T2 / T1), np.tan(np.arcsin(friction)) * angle, rtol=1e-2)


@pytest.mark.parametrize("friction", [0.2, -0.2, 0.05])
def test_friction_is_that_of_a_belt(lay_wire: Lay, solve_statics: Solve, friction: float) -> None:
    found = held(lay_wire, solve_statics, AT, friction)
    check_friction(found, friction)
    np.testing.assert_allclose(found.r, AT, atol=1e-10)
    for wrong in (1.03 * friction, -friction):
        with pytest.raises(AssertionError):
            check_friction(found, wrong)


def test_control_without_friction_tensions_are_equal(lay_wire: Lay, solve_statics: Solve) -> None:
    found = held(lay_wire, solve_statics, AT, 0.0)
    np.testing.assert_allclose(*np.linalg.norm(found.pulls, axis=1), rtol=1e-4)
    with pytest.raises(AssertionError):
        check_friction(found, 0.05)


def test_spring_gives_by_force_over_stiffness(lay_wire: Lay, solve_statics: Solve) -> None:
    """The displacement from the ends' reactions, and the force of a long tensioned beam on a spring.

    A load F in the middle of such a beam deflects it by F (a b/(a + b) - sqrt(EJ/T)/2)/T.
    """
    k = np.array([np.inf, 4000.0, 800.0])
    found = held(lay_wire, solve_statics, AT, 0.0, np.diag(1.0 / k)[None])
    force = -found.pulls.sum(axis=0)
    np.testing.assert_allclose(found.r - AT, force / k, atol=1e-10)
    assert found.r[2] < AT[2] - 0.05, "the wire presses the spring down"
    T = float(np.abs(found.pulls[:, 0]).mean())
    give = (AT[0] * (SPAN - AT[0]) / SPAN - 0.5 * np.sqrt(SECTION.EJ / T)) / T
    np.testing.assert_allclose(force[2], -found.r[2] / give, rtol=2e-3)
    rigid = held(lay_wire, solve_statics, AT, 0.0)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(rigid.r - AT, -rigid.pulls.sum(axis=0) / k, atol=1e-3)
