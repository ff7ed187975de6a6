"""Masses on a taut string, against the beam on two supports and the closed form of the string."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.guides import Guides
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.loads.hung_masses import HungMasses
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
G, SPAN, UNSTRESSED = 9.81, 16.0, 15.9
MASS, X = np.array([8.0, 5.0]), np.array([4.0, 11.0])
KNOTS = np.concatenate((np.linspace(0.0, 15.4, 155), [15.6, UNSTRESSED]))


@dataclass(frozen=True)
class Loaded:
    """A string between two points with two masses."""

    wire: Chain
    system: System
    masses: HungMasses
    ends: np.ndarray


def loaded(lay_wire: Lay, given: np.ndarray | None = None) -> Loaded:
    """Return a string with masses in the planes x = X, or at given material points."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], [SPAN, 0, 0], KNOTS, Section(EA=1e6, EJ=0.5, rhoA=1.0))
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    s = builder.add(Kind.SLIDING, np.array([4.3, 10.2]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    strands = Strands.on((wire,), np.zeros(2, dtype=np.int64))
    at = strands.locate(table.start[s])
    masses = HungMasses(strands, s, at, MASS, G, Ramp(20.0))
    places, along = np.column_stack((X, np.zeros((2, 2)))), np.tile([1.0, 0.0, 0.0], (2, 1))
    place = Guides(strands, s, at, places, along) if given is None else Given(s, given)
    return Loaded(wire, System(table, (CableElements.of([wire]), hinges, masses, place)), masses, ends)


def check_string(model: Loaded, z: np.ndarray, mass: np.ndarray, x: np.ndarray) -> None:
    """Reactions are those of a beam, and its moment over H is the sag: within bending, 0.5 %."""
    weight, la = mass * G, z[model.ends]
    right = float(weight @ x) / SPAN
    np.testing.assert_allclose(la[:, 2], [right - weight.sum(), -right], rtol=1e-6)
    assert la[0, 0] == pytest.approx(-la[1, 0], rel=1e-9)
    left = weight.sum() - right
    moment = np.array([left * x[0], right * (SPAN - x[1])])
    point = model.wire.evaluate(z, z[model.masses.s]).r
    np.testing.assert_allclose(point[:, 0], x, atol=1e-9)
    np.testing.assert_allclose(point[:, 2] * la[0, 0], -moment, rtol=0.005)


def test_masses_in_planes(lay_wire: Lay, solve_statics: Solve) -> None:
    model = loaded(lay_wire)
    z = solve_statics(model.system, model.system.unknowns.start)[1]
    check_string(model, z, MASS, X)
    for wrong in (1.01 * MASS, MASS[::-1]):
        with pytest.raises(AssertionError):
            check_string(model, z, wrong, X)


def test_masses_at_given_material_points(lay_wire: Lay, solve_statics: Solve) -> None:
    """Clamped where the planes were, they rest there."""
    model = loaded(lay_wire)
    z = solve_statics(model.system, model.system.unknowns.start)[1]
    clamped = loaded(lay_wire, z[model.masses.s])
    again = solve_statics(clamped.system, clamped.system.unknowns.start)[1]
    np.testing.assert_allclose(again, z, rtol=1e-8, atol=1e-9)
    elsewhere = loaded(lay_wire, z[model.masses.s] + 0.1)
    other = solve_statics(elsewhere.system, elsewhere.system.unknowns.start)[1]
    with pytest.raises(AssertionError):
        check_string(elsewhere, other, MASS, X)
    check_string(elsewhere, other, MASS, model.wire.evaluate(other, other[model.masses.s]).r[:, 0])


def test_weight_grows_with_the_ramp(lay_wire: Lay) -> None:
    """At half of the ramp's time half of the weight is there, at its start nothing; all of it is vertical."""
    model = loaded(lay_wire)
    z = model.system.unknowns.start
    for t, part in ((0.0, 0.0), (10.0, 0.5), (99.0, 1.0)):
        f = np.zeros_like(z)
        model.masses.add_residual(replace(State.at_rest(z), t=t), f)
        sums = f[model.wire.nodes[:, :3]].sum(axis=0)
        np.testing.assert_allclose(sums, [0.0, 0.0, part * G * MASS.sum()], atol=1e-12)


def test_masses_move_on_to_other_elements(lay_wire: Lay) -> None:
    model = loaded(lay_wire)
    z = model.system.unknowns.start.copy()
    assert model.masses.relocate(z) is None
    z[model.masses.s] = [9.05, 2.05]
    moved = model.masses.relocate(z)
    assert moved is not None
    np.testing.assert_array_equal(moved.element, model.wire.locate(np.array([9.05, 2.05])))
    f = np.zeros_like(z)
    moved.add_residual(State.at_rest(z, 99.0), f)
    # the moment of the loads about the start is that of the masses at their new places
    lever = f[model.wire.nodes[:, 2]] @ z[model.wire.nodes[:, 0]]
    slopes = f[model.wire.nodes[:, 5]] @ z[model.wire.nodes[:, 3]]
    x = model.wire.evaluate(z, z[moved.s]).r[:, 0]
    assert lever + slopes == pytest.approx(G * float(MASS @ x), rel=1e-12)
