"""Dead loads: forces that stay what they are, in equilibrium with a spring and with a hanging wire."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.dead import DeadLoads
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]

FORCE = np.array([1.0, -2.0, 0.0, 3.0])


def residual(part: DeadLoads, z: np.ndarray) -> np.ndarray:
    f = np.zeros(4)
    part.add_residual(State.at_rest(z), f)
    return f


def test_the_force_is_that_everywhere() -> None:
    part, z = DeadLoads(FORCE), np.random.default_rng(3).normal(size=4)
    np.testing.assert_array_equal(residual(part, z), -FORCE)
    np.testing.assert_array_equal(residual(part, 2.0 * z), -FORCE)
    assert part.jacobian(State.at_rest(z), 0.0, 0.0).size == part.pattern()[0].size == 0


def hung(lay_wire: Lay, solve_statics: Solve, *, dead: bool, scale: float = 1.0) -> np.ndarray:
    """Return the nodes of a wire of which the weight is gravity or the same as dead load."""
    builder, knots = UnknownsBuilder(), np.linspace(0.0, 9.99, 13)
    wire = lay_wire(builder, [0, 0, 0], [10, 0, 0], knots, Section(EA=1e6, EJ=0.1, rhoA=1.2))
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    cable = CableElements.of([wire])
    hold = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.full(2, -1))
    weight = cable.weight(table.size)
    gravity = Gravity(weight, 9.81, Ramp(0.0))
    load = np.zeros(table.size)
    gravity.add_residual(State.at_rest(table.start), load)
    part = DeadLoads(-scale * load) if dead else gravity
    _, z = solve_statics(System(table, (cable, hold, part)), table.start)
    return z[wire.nodes]


def test_weight_as_dead_load(lay_wire: Lay, solve_statics: Solve) -> None:
    expected = hung(lay_wire, solve_statics, dead=False)
    np.testing.assert_allclose(hung(lay_wire, solve_statics, dead=True), expected, atol=1e-10)
    assert expected[:, 2].min() < -1e-3
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(hung(lay_wire, solve_statics, dead=True, scale=1.01), expected, atol=1e-6)
