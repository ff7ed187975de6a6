"""The guided dropper joint: the clamp keeps its place along the track, the force on the wire is vertical."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.guided import GuidedJoints
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
TRACK_X, LOAD, UNSTRESSED = 7.0, 200.0, 17.0


@dataclass(frozen=True)
class Sloping:
    """A sloping wire with a load at the end of a guided dropper."""

    wire: Chain
    system: System
    ends: np.ndarray
    node: np.ndarray
    s: np.ndarray
    la: np.ndarray


def sloping(lay_wire: Lay, guided: bool = True) -> Sloping:
    """Return a wire that climbs by 7 m over 16 m; the control has a frictionless joint instead."""
    builder = UnknownsBuilder()
    knots = np.concatenate(
        (np.linspace(0.0, 6.2, 20)[:-1], np.arange(6.2, 8.6, 0.07), np.linspace(8.8, UNSTRESSED, 25))
    )
    wire = lay_wire(builder, [0, 0, 0], [16, 0, 7], knots, Section(EA=2e4, EJ=20.0, rhoA=1.0))
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    node = builder.add(Kind.POSITION, np.array([[TRACK_X, 0.0, 3.0]]))
    la = builder.add(Kind.MULTIPLIER, np.array([[0.0, 0.0, 100.0]]))
    s = builder.add(Kind.SLIDING, np.array([7.4]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    at = wire.locate(np.array([7.4]))
    if guided:
        joint = GuidedJoints(wire, s, la, at, np.array([TRACK_X]), node)
    else:
        joint = SlidingJoints(wire, s, la, at, np.zeros((1, 3)), node)
    return Sloping(wire, System(table, (CableElements.of([wire]), hinges, joint)), ends, node, s, la)


def solved(model: Sloping, solve_statics: Solve, held: np.ndarray | tuple[int, ...] = ()) -> np.ndarray:
    load = np.zeros(model.system.size)
    load[model.node[0, 2]] = -LOAD
    return solve_statics(model.system, model.system.unknowns.start, held, load)[1]


def check_vertical_force(z: np.ndarray, ends: np.ndarray) -> None:
    """What acts on the wire besides its ends has no component along the track: H is continuous."""
    H = z[ends][:, 0]
    np.testing.assert_allclose(H[0], -H[1], rtol=1e-9)


def check_jump(z: np.ndarray, ends: np.ndarray, la_z: np.ndarray, slope: np.ndarray) -> None:
    """The tension after the clamp less that before is la_z times z'/|r'| (midpoint rule of the kink: 1 %)."""
    T = np.linalg.norm(z[ends], axis=1)
    np.testing.assert_allclose(T[1] - T[0], la_z * slope[2] / np.linalg.norm(slope), rtol=1e-2)
    assert abs(T[1] - T[0]) > 50.0


def test_guided(lay_wire: Lay, solve_statics: Solve) -> None:
    model = sloping(lay_wire)
    z = solved(model, solve_statics)
    point = model.wire.evaluate(z, z[model.s])
    np.testing.assert_allclose(z[model.node[0]], point.r[0], atol=1e-10)
    np.testing.assert_allclose(point.r[0, 0], TRACK_X, atol=1e-10)
    np.testing.assert_allclose(z[model.la][0], [0.0, 0.0, LOAD], atol=1e-7)
    check_vertical_force(z, model.ends)
    np.testing.assert_allclose(z[model.ends].sum(axis=0), [0.0, 0.0, -LOAD], atol=1e-7)
    check_jump(z, model.ends, z[model.la[0, 2]], point.r1[0])
    with pytest.raises(AssertionError):
        check_jump(z, model.ends, z[model.la[0, 2]], -point.r1[0])


def test_wire_is_free_of_the_guides_force(lay_wire: Lay, solve_statics: Solve) -> None:
    """A pull along the track on the dropper's end goes into the guide; the wire does not feel it."""
    model = sloping(lay_wire)
    load = np.zeros(model.system.size)
    load[model.node[0]] = [35.0, 0.0, -LOAD]
    pulled = solve_statics(model.system, model.system.unknowns.start, (), load)[1]
    plain = solved(model, solve_statics)
    np.testing.assert_allclose(pulled[model.la][0] - plain[model.la][0], [35.0, 0.0, 0.0], atol=1e-7)
    np.testing.assert_allclose(pulled[model.ends], plain[model.ends], atol=1e-6)
    np.testing.assert_allclose(pulled[model.s], plain[model.s], atol=1e-9)


def test_control_frictionless_joint_pulls_along_the_track(lay_wire: Lay, solve_statics: Solve) -> None:
    """The literal (15) at the same place hangs normal to the wire: no jump of the tension, but one of H."""
    model = sloping(lay_wire, guided=False)
    z = solved(model, solve_statics, model.node[:, 0])
    slope = model.wire.evaluate(z, z[model.s]).r1[0]
    with pytest.raises(AssertionError):
        check_vertical_force(z, model.ends)
    with pytest.raises(AssertionError):
        check_jump(z, model.ends, z[model.la[0, 2]], slope)
    np.testing.assert_allclose(*np.linalg.norm(z[model.ends], axis=1), rtol=1e-3)


def test_sideways_force_is_carried(lay_wire: Lay, solve_statics: Solve) -> None:
    """In y the joint ties wire and dropper: stagger loads pass, with no force along the track."""
    model = sloping(lay_wire)
    load = np.zeros(model.system.size)
    load[model.node[0]] = [0.0, 40.0, -LOAD]
    _, z = solve_statics(model.system, model.system.unknowns.start, (), load)
    np.testing.assert_allclose(z[model.la][0], [0.0, -40.0, LOAD], atol=1e-7)
    check_vertical_force(z, model.ends)
    np.testing.assert_allclose(z[model.ends].sum(axis=0), [0.0, 40.0, -LOAD], atol=1e-7)
    assert z[model.node[0, 1]] > 0.05
