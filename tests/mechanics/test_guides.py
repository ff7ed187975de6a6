"""Guides in planes across a track of any direction: they find where wires cross, unfelt by the wires."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.optimize import brentq

from catenaria.errors import InfeasibleError
from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.guides import Guides
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.hung_point import HungPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
ALONG = np.array([[0.8, 0.6, 0.0], [0.8, 0.6, 0.0], [0.6, 0.8, 0.0]])
PLANES = np.array([[4.0, 3.0, 9.0], [8.5, 6.0, 0.0], [6.0, 5.0, -3.0]])
KNOTS = np.linspace(0.0, 14.6, 22)


@dataclass(frozen=True)
class Guided:
    """Two wires that cross three planes; the middle of each is pulled aside."""

    wires: tuple[Chain, Chain]
    system: System
    guides: Guides
    ends: np.ndarray

    def load(self) -> np.ndarray:
        load = np.zeros(self.system.size)
        load[self.wires[0].nodes[9, :3]] = [40.0, -300.0, -200.0]
        load[self.wires[1].nodes[12, :3]] = [0.0, 250.0, -100.0]
        return load


def guided(lay_wire: Lay, held: bool = False) -> Guided:
    """Return wires with guides; with `held` the wires slide through points of the planes instead."""
    builder = UnknownsBuilder()
    section = Section(EA=2e4, EJ=2.0, rhoA=1.0)
    ends = np.array([[0.0, 0.0, 0.0], [12.0, 9.0, 2.0], [0.0, 1.0, 3.0], [12.0, 9.5, 3.0]])
    wires = (
        lay_wire(builder, ends[0], ends[1], KNOTS, section),
        lay_wire(builder, ends[2], ends[3], KNOTS, section),
    )
    s = builder.add(Kind.SLIDING, np.array([6.0, 9.0, 7.0]))
    forces = builder.add(Kind.MULTIPLIER, np.zeros((4, 3)))
    la = builder.add(Kind.MULTIPLIER, np.zeros((3 if held else 0, 3)))
    start = builder.build().start
    strands = Strands.on(wires, np.array([0, 0, 1]))
    guides = Guides(strands, s, strands.locate(start[s]), PLANES, ALONG)
    nodes = np.concatenate([wire.nodes[[0, -1], :3] for wire in wires])
    hinges = HeldPoints(nodes, forces, start[nodes], np.zeros((4, 3)), np.full(4, -1))
    cables = CableElements.of(list(wires))
    joints = (guides,)
    if held:
        points = strands.evaluate(start, start[s]).r
        joints = tuple(
            SlidingJoints(wire, s[own], la[own], wire.locate(start[s[own]]), points[own])
            for wire, own in ((wires[0], [0, 1]), (wires[1], [2]))
        )
    return Guided(wires, System(builder.build(), (cables, hinges, *joints)), guides, forces)


def solved(model: Guided, solve_statics: Solve) -> tuple[Guides, np.ndarray]:
    system, z = solve_statics(model.system, model.system.unknowns.start, (), model.load())
    return next((part for part in system.contributions if isinstance(part, Guides)), model.guides), z


def crossing(wire: Chain, z: np.ndarray, P: np.ndarray, along: np.ndarray) -> float:
    """Return where a wire crosses a plane, by bisection over the whole wire."""

    def distance(s: float) -> float:
        return float(along @ (wire.evaluate(z, np.array([s])).r[0] - P))

    return float(brentq(distance, wire.knots[0], wire.knots[-1], xtol=1e-13))


def check_crossings(model: Guided, z: np.ndarray, planes: np.ndarray, along: np.ndarray) -> None:
    wires = model.wires[0], model.wires[0], model.wires[1]
    expected = [crossing(*at) for at in zip(wires, [z] * 3, planes, along, strict=True)]
    np.testing.assert_allclose(z[model.guides.s], expected, atol=1e-10)


def test_clamps_are_where_the_wires_cross_the_planes(lay_wire: Lay, solve_statics: Solve) -> None:
    model = guided(lay_wire)
    found, z = solved(model, solve_statics)
    check_crossings(model, z, PLANES, ALONG)
    assert not np.array_equal(found.element, model.guides.element)  # they went over nodes to get there
    assert found.relocate(z) is None
    with pytest.raises(AssertionError):
        check_crossings(model, z, PLANES + 0.001 * ALONG, ALONG)
    with pytest.raises(AssertionError):
        check_crossings(model, z, PLANES, np.array([[1.0, 0.0, 0.0]] * 3))


def test_a_point_of_a_plane_may_be_any(lay_wire: Lay, solve_statics: Solve) -> None:
    model = guided(lay_wire)
    z = solved(model, solve_statics)[1]
    other = replace(model.guides, P=PLANES + np.cross(ALONG, [0.0, 0.0, 5.0]) + [0.0, 0.0, 7.0])
    moved = replace(model, guides=other, system=replace(model.system, contributions=(*parts(model), other)))
    np.testing.assert_allclose(solved(moved, solve_statics)[1], z, atol=1e-8)


def parts(model: Guided) -> tuple[CableElements, HeldPoints]:
    cables, hinges, *_ = model.system.contributions
    assert isinstance(cables, CableElements)
    assert isinstance(hinges, HeldPoints)
    return cables, hinges


def check_free(model: Guided, z: np.ndarray) -> None:
    """The ends hold nothing but the loads."""
    load = model.load()
    for wire, la in zip(model.wires, z[model.ends].reshape(2, 2, 3), strict=True):
        np.testing.assert_allclose(la.sum(axis=0), load[wire.nodes[:, :3]].sum(axis=0), atol=1e-7)


def test_wires_do_not_feel_the_guides(lay_wire: Lay, solve_statics: Solve) -> None:
    model = guided(lay_wire)
    z = solved(model, solve_statics)[1]
    check_free(model, z)
    anywhere = Given(model.guides.s, np.array([1.0, 2.0, 3.0]))
    alone = System(model.system.unknowns, (*parts(model), anywhere))
    free = solve_statics(alone, alone.unknowns.start, (), model.load())[1]
    for wire in model.wires:
        np.testing.assert_allclose(z[wire.nodes], free[wire.nodes], atol=1e-9)


def test_control_a_wire_that_slides_through_points_feels_them(lay_wire: Lay, solve_statics: Solve) -> None:
    model = guided(lay_wire, held=True)
    with pytest.raises(AssertionError):
        check_free(model, solved(model, solve_statics)[1])


def test_on_a_straight_track_it_is_the_hung_point_without_force(lay_wire: Lay) -> None:
    model = guided(lay_wire)
    z, wire, s = model.system.unknowns.start, model.wires[0], model.guides.s[:2]
    along, at = np.tile([1.0, 0.0, 0.0], (2, 1)), wire.locate(z[s])
    guides = Guides(wire, s, at, PLANES[:2], along)
    points = HungPoints(wire, s, model.ends[0, :2], at, PLANES[:2, 0])
    f, h = np.zeros_like(z), np.zeros_like(z)
    guides.add_residual(State.at_rest(z), f)
    points.add_residual(State.at_rest(z), h)
    np.testing.assert_allclose(f, h, atol=1e-14)
    assert np.abs(f[s]).min() > 0.1
    assert guides.pattern()[0].size == 2 * 5  # nothing across the track


def test_a_wire_that_does_not_reach_the_plane_is_refused(lay_wire: Lay, solve_statics: Solve) -> None:
    model = guided(lay_wire)
    far = replace(model.guides, P=PLANES + 30.0 * ALONG)
    beyond = replace(model, system=replace(model.system, contributions=(*parts(model), far)))
    with pytest.raises(InfeasibleError, match="slid out"):
        solved(beyond, solve_statics)
