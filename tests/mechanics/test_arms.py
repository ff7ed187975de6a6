"""Steady arms: force along the bar, balance of its moments, and its length."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.arms import Arms
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
SECTION, G = Section(EA=1e5, EJ=5.0, rhoA=1.0), 9.81
HINGE, LENGTH, MASS = np.array([6.4, 1.3, 0.3]), 1.1, 2.4
LATE = 1e9


@dataclass(frozen=True)
class Held:
    """An equilibrium: the arm, its state, and the forces of the wire on its hinges."""

    arm: Arms
    z: np.ndarray
    pulls: np.ndarray

    @property
    def d(self) -> np.ndarray:
        """From the hinge to the wire."""
        return self.arm.carrier.evaluate(self.z, self.z[self.arm.s]).r[0] - HINGE


@pytest.fixture(scope="module")
def held(lay_wire: Lay, solve_statics: Solve) -> Held:
    """Solve a taut weightless wire that an arm pulls aside."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], [16, 0, 0], np.linspace(0.0, 15.8, 41), SECTION)
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    q = builder.add(Kind.MULTIPLIER, np.array([30.0]))
    s = builder.add(Kind.SLIDING, np.array([6.3]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    at, one = wire.locate(np.array([6.3])), np.ones(1)
    arm = Arms(wire, s, q, at, HINGE[None], LENGTH * one, MASS * one, G, Ramp(4.0))
    parts = (CableElements.of([wire]), hinges, arm, Given(s, np.array([6.3])))
    system, z = solve_statics(System(table, parts), table.start)
    part = system.contributions[2]
    assert isinstance(part, Arms)
    return Held(part, z, z[ends])


def check_balance(d: np.ndarray, load: np.ndarray, pulls: np.ndarray) -> None:
    """Wire in equilibrium; no moment about the hinge of the arm's weight at its middle and of the wire."""
    np.testing.assert_allclose(load - pulls.sum(axis=0), 0.0, atol=1e-7)
    weight = np.array([0.0, 0.0, -MASS * G])
    np.testing.assert_allclose(np.cross(d, -load) + np.cross(0.5 * d, weight), 0.0, atol=1e-7)


def test_rigid_and_in_balance(held: Held) -> None:
    load = held.arm.loads(LATE, held.z)[0]
    np.testing.assert_allclose(np.linalg.norm(held.d), LENGTH, rtol=1e-12)
    check_balance(held.d, load, held.pulls)
    assert held.z[held.arm.density[0]] > 30.0, "the arm is in tension"
    assert load @ held.d < 0.0, "and pulls the wire to its hinge"
    assert load[1] > 30.0


def test_control_other_shares_of_weight_are_out_of_balance(held: Held) -> None:
    """All of the weight at the wire, or none of it."""
    load = held.arm.loads(LATE, held.z)[0]
    for share in (-0.5, 0.5):
        wrong = load + share * np.array([0.0, 0.0, MASS * G])
        with pytest.raises(AssertionError):
            check_balance(held.d, wrong, wrong)


def test_force_without_weight_is_along_the_bar(held: Held) -> None:
    load = held.arm.loads(0.0, held.z)[0]
    np.testing.assert_allclose(np.cross(load, held.d), 0.0, atol=1e-9)
    assert np.abs(np.cross(held.arm.loads(LATE, held.z)[0], held.d)).max() > 1.0


def test_residual_is_minus_the_loads_on_the_wire(held: Held) -> None:
    """At any state: the positions' shares add up to the load, and the row of q is in metres."""
    z = held.z.copy()
    z[held.arm.carrier.nodes[:, :3]] += [0.0, -0.01, 0.0]
    f = np.zeros(z.size)
    held.arm.add_residual(State.at_rest(z, 2.0), f)
    np.testing.assert_allclose(
        f[held.arm.carrier.nodes[:, :3]].sum(axis=0), -held.arm.loads(2.0, z)[0], rtol=1e-12
    )
    d = replace(held, z=z).d
    np.testing.assert_allclose(f[held.arm.density[0]], np.linalg.norm(d) - LENGTH, rtol=1e-2)
    assert f[held.arm.density[0]] > 5e-3
    assert f[held.arm.s[0]] == 0.0, "the row of s belongs to a guide"
