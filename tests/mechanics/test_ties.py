"""Tied ends: the same as a hinge where the tie is at a node of the host, and forces that balance anywhere."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.spherical import SphericalJoints
from catenaria.mechanics.joints.ties import Ties
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
SECTION = Section(EA=1e5, EJ=5.0, rhoA=1.0)
NODE = 9


@dataclass(frozen=True)
class Fork:
    """An equilibrium of a wire and a branch tied to it; forces are those of wires on what holds them."""

    host: Chain
    branch: Chain
    z: np.ndarray
    pulls: np.ndarray
    la: np.ndarray


def fork(lay_wire: Lay, solve_statics: Solve, at: float, hinge: bool = False) -> Fork:
    """Solve a taut wire from which a branch leads aside to an anchor, by a tie or by a hinge of nodes."""
    builder = UnknownsBuilder()
    host = lay_wire(builder, [0, 0, 0], [16, 0, 0], np.linspace(0.0, 15.9, 25), SECTION)
    branch = lay_wire(builder, [6, 0, 0], [9, 4, 1], np.linspace(0.0, 4.9, 9), SECTION)
    ends = builder.add(Kind.MULTIPLIER, np.zeros((3, 3)))
    la = builder.add(Kind.MULTIPLIER, np.zeros((1, 3)))
    s = builder.add(Kind.SLIDING, np.array([at]))
    table = builder.build()
    nodes = np.concatenate((host.nodes[[0, -1], :3], branch.nodes[-1:, :3]))
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((3, 3)), np.full(3, -1))
    end = branch.nodes[:1, :3]
    joint: Contribution = SphericalJoints(end, host.nodes[[NODE], :3], la)
    if not hinge:
        joint = Ties(end, host, s, host.locate(np.array([at])), la)
    parts = (CableElements.of([host, branch]), hinges, joint, Given(s, np.array([at])))
    _, z = solve_statics(System(table, parts), table.start)
    return Fork(host, branch, z, z[ends], z[la][0])


def check_balance(found: Fork, at: float) -> None:
    """The end is at its place on the host, all of the branch's force passes, and all forces balance."""
    np.testing.assert_allclose(
        found.z[found.branch.nodes[0, :3]], found.host.evaluate(found.z, np.array([at])).r[0], atol=1e-11
    )
    np.testing.assert_allclose(found.la, -found.pulls[2], atol=1e-7)  # a wire without weight
    np.testing.assert_allclose(found.pulls.sum(axis=0), 0.0, atol=1e-7)
    moment = np.cross(found.z[found.host.nodes[-1, :3]], found.pulls[1])
    moment += np.cross(found.z[found.branch.nodes[-1, :3]], found.pulls[2])
    np.testing.assert_allclose(moment, 0.0, atol=1e-6)


@pytest.mark.parametrize("at", [5.5, 6.1])
def test_forces_balance_anywhere_on_the_host(lay_wire: Lay, solve_statics: Solve, at: float) -> None:
    found = fork(lay_wire, solve_statics, at)
    check_balance(found, at)
    assert np.linalg.norm(found.la) > 20.0
    assert found.la[1] > 0.0, "the branch pulls its host aside"
    for wrong in (at + 0.01, at - 0.01):
        with pytest.raises(AssertionError):
            check_balance(found, wrong)


def test_tie_at_a_node_is_a_hinge(lay_wire: Lay, solve_statics: Solve) -> None:
    at = 15.9 * NODE / 24
    tied, hinged = (fork(lay_wire, solve_statics, at, hinge) for hinge in (False, True))
    np.testing.assert_allclose(tied.z, hinged.z, atol=1e-6)
    other = fork(lay_wire, solve_statics, at + 0.05)
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(other.z, hinged.z, atol=1e-3)


def test_no_force_along_any_way_is_kept_back() -> None:
    """On node and host together the tie exerts neither a force nor, where they coincide, a power."""
    host = Chain(np.arange(12).reshape(2, 6), np.array([0.0, 2.0]), SECTION)
    tie = Ties(np.array([[12, 13, 14]]), host, np.array([15]), np.array([0]), np.array([[16, 17, 18]]))
    z = np.random.default_rng(3).normal(size=19)
    z[15] = 0.7
    tie.add_residual(State.at_rest(z), f := np.zeros(19))
    np.testing.assert_allclose(f[:3] + f[6:9], -z[16:], atol=1e-14)
    np.testing.assert_allclose(f[12:15], z[16:], atol=0.0)
    assert f[15] == 0.0, "the row of s belongs to whatever places the tie"
    rate = np.random.default_rng(4).normal(size=12)
    velocity = host.evaluate(rate, z[[15]], np.array([0])).r[0]
    np.testing.assert_allclose(f[:12] @ rate, -z[16:] @ velocity, atol=1e-13)
