"""The sliding joint (15): no friction, force along the bisector, any number of element boundaries crossed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
SECTION = Section(EA=1e5, EJ=100.0, rhoA=1.0)
SPAN, UNSTRESSED = 16.0, 15.9
START = 6.0


@dataclass(frozen=True)
class Deflected:
    """A wire between two hinges that a support holds aside, and the numbers of what acts there."""

    wire: Chain
    system: System
    ends: np.ndarray
    s: np.ndarray
    la: np.ndarray


def deflected(
    lay_wire: Lay, turn: np.ndarray, X: np.ndarray, knots: np.ndarray, sliding: bool = True
) -> Deflected:
    """Return the wire in a generic orientation; the control holds a node instead."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, turn @ [0, 0, 0], turn @ [SPAN, 0, 0], knots, SECTION)
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    la = builder.add(Kind.MULTIPLIER, np.zeros((1, 3)))
    s = builder.add(Kind.SLIDING, np.array([START])) if sliding else np.empty(0, dtype=np.int64)
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    at = wire.locate(np.array([START]))
    if sliding:
        support = SlidingJoints(wire, s, la, at, (turn @ X)[None, :])
    else:
        support = HeldPoints(wire.nodes[at, :3], la, (turn @ X)[None, :], np.zeros((1, 3)), np.array([-1]))
    return Deflected(wire, System(table, (CableElements.of([wire]), hinges, support)), ends, s, la)


def tension(wire: Chain, z: np.ndarray, s: float) -> float:
    """Return the axial force EA eps |r'|."""
    a = np.linalg.norm(wire.evaluate(z, np.array([s])).r1)
    return float(0.5 * wire.section.EA * (a**2 - 1.0) * a)


def check_frictionless(wire: Chain, z: np.ndarray, ends: np.ndarray, la: np.ndarray) -> None:
    """Equal tension on both sides, at the ends and in the wire; the force bisects the angle."""
    pull = z[ends]
    T = np.linalg.norm(pull, axis=1)
    np.testing.assert_allclose(T[0], T[1], rtol=5e-5)
    np.testing.assert_allclose([tension(wire, z, 1.0), tension(wire, z, wire.knots[-1] - 1.0)], T, rtol=1e-6)
    np.testing.assert_allclose(pull.sum(axis=0) + z[la][0], 0.0, atol=1e-7)
    bisector = -(pull[0] / T[0] + pull[1] / T[1])
    bisector /= np.linalg.norm(bisector)
    np.testing.assert_allclose(z[la][0] / np.linalg.norm(z[la]), bisector, atol=5e-4)


X = np.array([5.0, 0.5, 0.8])


def graded(width: float = 0.05, part: float = 0.4) -> np.ndarray:
    """Return knots that are `width` apart where the answer lies, in the given part of an element."""
    first = 3.51 + part * width
    fine = first + width * np.arange(round(3.2 / width))
    return np.concatenate((np.linspace(0.0, first, 15)[:-1], fine, np.linspace(6.9, UNSTRESSED, 37)))


def test_frictionless(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    model = deflected(lay_wire, turn, X, graded())
    system, z = solve_statics(model.system, model.system.unknowns.start)
    check_frictionless(model.wire, z, model.ends, model.la)
    assert abs(z[model.s[0]] - START) > 15 * 0.05, "the point must have crossed several elements"
    assert np.linalg.norm(z[model.la]) > 100.0
    support = system.contributions[2]
    assert isinstance(support, SlidingJoints)
    np.testing.assert_allclose(model.wire.evaluate(z, z[model.s]).r[0], turn @ X, atol=1e-10)
    assert abs(z[model.la][0] @ model.wire.evaluate(z, z[model.s], support.element).r1[0]) < 1e-6


def test_control_held_node_has_friction(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    model = deflected(lay_wire, turn, X, graded(), sliding=False)
    _, z = solve_statics(model.system, model.system.unknowns.start)
    with pytest.raises(AssertionError):
        check_frictionless(model.wire, z, model.ends, model.la)


def asymmetry(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray, width: float) -> float:
    """Return the largest relative difference of the two tensions over places of the joint in its element."""
    worst = 0.0
    for part in (0.2, 0.5, 0.8):
        model = deflected(lay_wire, turn, X, graded(width, part))
        _, z = solve_statics(model.system, model.system.unknowns.start)
        T = np.linalg.norm(z[model.ends], axis=1)
        worst = max(worst, abs(T[0] / T[1] - 1.0))
    return worst


def test_mesh_friction_vanishes_with_order_two(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    """Within an element the third derivative cannot jump at the force: the mesh holds the wire a little."""
    errors = [asymmetry(lay_wire, solve_statics, turn, width) for width in (0.2, 0.1, 0.05)]
    order = -np.polyfit([0.0, 1.0, 2.0], np.log2(errors), 1)[0]
    assert 1.5 < order < 2.5, f"order {order}"
    assert errors[-1] < 5e-5


def test_result_does_not_depend_on_the_starting_element(
    lay_wire: Lay, solve_statics: Solve, turn: np.ndarray
) -> None:
    """From elements on either side of the answer, near and far."""
    model = deflected(lay_wire, turn, X, graded())
    support, found = model.system.contributions[2], []
    assert isinstance(support, SlidingJoints)
    for start in (START, 4.0, 8.0):
        element = model.wire.locate(np.array([start]))
        z = model.system.unknowns.start.copy()
        z[model.s] = start
        parts = (*model.system.contributions[:2], replace(support, element=element))
        _, z = solve_statics(System(model.system.unknowns, parts), z)
        found.append([z[model.s[0]], *z[model.la][0]])
    np.testing.assert_allclose(found[1:], [found[0]] * 2, rtol=1e-8)


def test_no_cycling_at_a_boundary(lay_wire: Lay, solve_statics: Solve, turn: np.ndarray) -> None:
    """With a symmetric support the answer is the middle knot; from either side it is found."""
    middle, aside = 0.5 * UNSTRESSED, np.array([0.5 * SPAN, 0.0, 0.8])
    for side in (-1, 0):
        model = deflected(lay_wire, turn, aside, np.linspace(0.0, UNSTRESSED, 41))
        support = model.system.contributions[2]
        assert isinstance(support, SlidingJoints)
        start = model.system.unknowns.start.copy()
        start[model.s] = middle + 0.1 * side + 0.05
        parts = (*model.system.contributions[:2], replace(support, element=np.array([20 + side])))
        system, z = solve_statics(System(model.system.unknowns, parts), start)
        np.testing.assert_allclose(z[model.s[0]], middle, atol=1e-6)
        assert system.relocate(z) is None
        np.testing.assert_allclose(*np.linalg.norm(z[model.ends], axis=1), rtol=1e-9)


def ring(lay_wire: Lay) -> tuple[Chain, System, np.ndarray, np.ndarray, np.ndarray]:
    """Return a slack wire between hinges of different height with a massless ring, and its numbers."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], [10, 0, 1], np.linspace(0.0, 10.8, 109), replace(SECTION, EJ=20.0))
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    node = builder.add(Kind.POSITION, np.array([[4.0, 0.0, -1.4]]))
    la = builder.add(Kind.MULTIPLIER, np.array([[0.0, 0.0, -500.0]]))
    s = builder.add(Kind.SLIDING, np.array([4.4]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    joint = SlidingJoints(wire, s, la, wire.locate(np.array([4.4])), np.zeros((1, 3)), node)
    system = System(table, (CableElements.of([wire]), hinges, joint))
    z = table.start.copy()
    z[wire.nodes[:, 2]] -= 1.5 * np.sin(np.pi * wire.knots / 10.8)
    z[wire.nodes[:, 5]] -= 1.5 * np.pi / 10.8 * np.cos(np.pi * wire.knots / 10.8)
    return wire, replace(system, unknowns=replace(table, start=z)), ends, node, la


def check_ring(r: np.ndarray, length: float) -> None:
    """The lowest point of the ellipse: both branches equally steep, span = length cos(angle)."""
    left, right = r, np.array([10.0, 0.0, 1.0]) - r
    np.testing.assert_allclose(-left[2] / left[0], right[2] / right[0], rtol=4e-2)
    angle = np.arccos(10.0 / length)
    drop = 0.5 * (length * np.sin(angle) - 1.0)
    np.testing.assert_allclose(-left[2], drop, rtol=2e-2)


def test_point_load_on_a_wire(lay_wire: Lay, solve_statics: Solve) -> None:
    """A loaded ring rests where both sides pull equally; the wire's force on it is minus the load."""
    wire, system, ends, node, la = ring(lay_wire)
    load = np.zeros(system.size)
    load[node[0, 2]] = -500.0
    _, z = solve_statics(system, system.unknowns.start, load=load)
    T = np.linalg.norm(z[ends], axis=1)
    np.testing.assert_allclose(T[0], T[1], rtol=2e-3)
    np.testing.assert_allclose(z[la][0], [0.0, 0.0, 500.0], atol=1e-8)
    length = 10.8 * float(np.linalg.norm(wire.evaluate(z, np.array([1.0])).r1))
    check_ring(z[node[0]], length)
    with pytest.raises(AssertionError):
        check_ring(z[node[0]] + np.array([0.3, 0.0, 0.0]), length)
