"""The spherical joint: equal positions, no moment."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.fixed import FixedJoints, normals
from catenaria.mechanics.joints.spherical import SphericalJoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
A, B = 1.2, 2.0  # lengths of the cantilever and of the beam that hangs on it [m]
SECTION = Section(EA=1e5, EJ=10.0, rhoA=1e-5)
G = 9.81


def test_residual_by_hand() -> None:
    """Two joints, one node in both: gaps to multipliers, forces to nodes, nothing to slopes."""
    z = np.random.default_rng(3).normal(size=24)
    nodes = np.arange(18).reshape(3, 6)
    la = np.arange(18, 24).reshape(2, 3)
    f = np.zeros(24)
    SphericalJoints(nodes[[0, 1], :3], nodes[[1, 2], :3], la).add_residual(State.at_rest(z), f)
    first, second = z[la]
    zero = np.zeros(3)
    np.testing.assert_allclose(f[:18], np.concatenate((first, zero, second - first, zero, -second, zero)))
    np.testing.assert_allclose(f[18:], np.concatenate((z[0:3] - z[6:9], z[6:9] - z[12:15])))


def gerber_beam(
    lay_wire: Lay, solve_statics: Solve, hinged: bool
) -> tuple[np.ndarray, np.ndarray, Chain, Chain]:
    """Return the solution of a cantilever that carries one end of a beam whose other end is supported."""
    builder = UnknownsBuilder()
    first = lay_wire(builder, [0, 0, 0], [A, 0, 0], np.linspace(0.0, A, 4), SECTION)
    second = lay_wire(builder, [A, 0, 0], [A + B, 0, 0], A + np.linspace(0.0, B, 5), SECTION)
    la = builder.add(Kind.MULTIPLIER, np.zeros((1, 3 if hinged else 5)))
    table = builder.build()
    i, j = first.nodes[-1:], second.nodes[:1]
    joint: Contribution = SphericalJoints(i[:, :3], j[:, :3], la)
    if not hinged:
        joint = FixedJoints(i, j, la, normals(np.array([[1.0, 0.0, 0.0]])))
    elements = CableElements.of([first, second])
    system = System(table, (elements, Gravity(elements.weight(table.size), G, Ramp(0.0)), joint))
    held = np.concatenate((first.nodes[0, [0, 1, 2, 4, 5]], second.nodes[-1, [1, 2]]))
    _, z = solve_statics(system, table.start, held)
    return z, z[la[0, :3]], first, second


def check_hinge(z: np.ndarray, force: np.ndarray, first: Chain, second: Chain) -> None:
    """The cantilever carries half of the beam's weight, and the beam's ends have no moment (r'' = 0)."""
    w = SECTION.rhoA * G
    hinge_force = 0.5 * w * B
    np.testing.assert_allclose(force, [0.0, 0.0, hinge_force], atol=1e-6 * hinge_force)
    sag = w * A**4 / (8.0 * SECTION.EJ) + hinge_force * A**3 / (3.0 * SECTION.EJ)
    np.testing.assert_allclose([z[first.nodes[-1, 2]], z[second.nodes[0, 2]]], -sag, rtol=1e-5)
    ends = second.evaluate(z, second.knots[[0, -1]]).r2[:, 2]
    middle = second.evaluate(z, np.array([A + 0.5 * B])).r2[0, 2]
    assert np.abs(ends).max() < 0.1 * abs(middle)


def test_transmits_no_moment(lay_wire: Lay, solve_statics: Solve) -> None:
    z, force, first, second = gerber_beam(lay_wire, solve_statics, hinged=True)
    check_hinge(z, force, first, second)
    assert abs(z[first.nodes[-1, 5]] - z[second.nodes[0, 5]]) > 1e-6, "the slope has a kink at the hinge"


def test_control_fixed_joint_transmits_it(lay_wire: Lay, solve_statics: Solve) -> None:
    with pytest.raises(AssertionError):
        check_hinge(*gerber_beam(lay_wire, solve_statics, hinged=False))


def check_hub(part: Contribution, hub: np.ndarray, z: np.ndarray, forces: np.ndarray) -> None:
    """The hub feels what the two joints exert together, minus the sum of the forces on the others."""
    f = np.zeros(z.size)
    part.add_residual(State.at_rest(z), f)
    np.testing.assert_allclose(f[hub], -forces.sum(axis=0), rtol=1e-13)


def test_two_nodes_may_hang_on_one() -> None:
    """A batch in which both joints have the same second node, as where three wires meet."""
    z = np.random.default_rng(3).normal(size=15)
    i, hub, la = np.arange(6).reshape(2, 3), np.arange(6, 9), np.arange(9, 15).reshape(2, 3)
    check_hub(SphericalJoints(i, np.stack((hub, hub)), la), hub, z, z[la])
    check_hub(SphericalJoints(np.stack((hub, hub)), i, la), hub, z, -z[la])
    with pytest.raises(AssertionError):
        check_hub(SphericalJoints(i[1:], hub[None, :], la[1:]), hub, z, z[la])
