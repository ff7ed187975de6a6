"""Point loads at given places along a wire, against the closed form of a string."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.hung_point import HungPoints
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
LOAD, X, SPAN = 100.0, 4.0, 16.0


@dataclass(frozen=True)
class Loaded:
    """A string between two points with a load at X."""

    wire: Chain
    system: System
    ends: np.ndarray
    s: np.ndarray
    force: np.ndarray


def loaded(lay_wire: Lay, load: float = LOAD) -> Loaded:
    builder = UnknownsBuilder()
    knots = np.concatenate(
        (np.linspace(0.0, 3.6, 10)[:-1], np.arange(3.6, 4.4, 0.02), np.linspace(4.5, 15.9, 24))
    )
    wire = lay_wire(builder, [0, 0, 0], [SPAN, 0, 0], knots, Section(EA=1e6, EJ=0.5, rhoA=1.0))
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    s, force = builder.add(Kind.SLIDING, np.array([4.1])), builder.add(Kind.MULTIPLIER, np.array([load]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    point = HungPoints(wire, s, force, wire.locate(np.array([4.1])), np.array([X]))
    # the load pulls downwards: the wire holds it up by la > 0
    parts = (CableElements.of([wire]), hinges, point, Given(force, np.array([load])))
    return Loaded(wire, System(table, parts), ends, s, force)


def check_string(model: Loaded, z: np.ndarray, load: float) -> None:
    """Vertical reactions of a beam on two supports, and z(X) H = -P a b/L."""
    la = z[model.ends]
    np.testing.assert_allclose(la[:, 2], [-load * (1 - X / SPAN), -load * X / SPAN], rtol=1e-6)
    assert la[0, 0] == pytest.approx(-la[1, 0], rel=1e-9)  # no force along the track
    point = model.wire.evaluate(z, z[model.s]).r[0]
    assert point[0] == pytest.approx(X, abs=1e-10)
    assert point[2] == pytest.approx(-load * X * (SPAN - X) / SPAN / la[0, 0], rel=0.02)  # bending


def test_load_on_a_string(lay_wire: Lay, solve_statics: Solve) -> None:
    model = loaded(lay_wire)
    _, z = solve_statics(model.system, model.system.unknowns.start)
    check_string(model, z, LOAD)
    with pytest.raises(AssertionError):
        check_string(model, z, 1.01 * LOAD)


def test_point_finds_its_element(lay_wire: Lay) -> None:
    model = loaded(lay_wire)
    z = model.system.unknowns.start.copy()
    z[model.s] = 9.0
    moved = model.system.relocate(z)
    assert moved is not None
    assert moved.relocate(z) is None
    (point,) = (part for part in moved.contributions if isinstance(part, HungPoints))
    np.testing.assert_array_equal(point.element, model.wire.locate(np.array([9.0])))
