"""Heights above a canted track, measured and prescribed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.measures import WireHeight
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.controls.track_height import TrackHeight
from catenaria.mechanics.elements.bars import Bars
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.guides import Guides
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
CANT = 0.15 / 1.5  # of the outer rail over the distance of the rails
UP = np.tile([0.0, -CANT, np.sqrt(1.0 - CANT**2)], (2, 1))
P = np.array([[4.0, -0.7, -5.4], [11.0, -0.7, -5.5]])
ALONG = np.tile([1.0, 0.0, 0.0], (2, 1))


@dataclass(frozen=True)
class Hanging:
    """A wire that hangs from another one by two rigid bars, whose lengths are found by its heights."""

    lower: Chain
    system: System
    heights: TrackHeight
    length: np.ndarray


def hanging(lay_wire: Lay, target: np.ndarray) -> Hanging:
    builder, knots = UnknownsBuilder(), np.linspace(0.0, 15.95, 25)
    section = Section(EA=1e6, EJ=0.1, rhoA=1.0)
    wires = (
        lay_wire(builder, [0, 0, 0], [16, 0.3, 0], knots, section),
        lay_wire(builder, [0, 0.2, 1.2], [16, 0.1, 1.2], knots, section),
    )
    ends = builder.add(Kind.MULTIPLIER, np.zeros((4, 3)))
    s = builder.add(Kind.SLIDING, P[:, 0] + 0.6), builder.add(Kind.SLIDING, P[:, 0])
    q, length = builder.add(Kind.MULTIPLIER, np.ones(2)), builder.add(Kind.PARAMETER, np.full(2, 1.2))
    table = builder.build()
    on = Strands.on(wires[:1], np.array([0, 0])), Strands.on(wires[1:], np.array([0, 0]))
    at = on[0].locate(table.start[s[0]]), on[1].locate(table.start[s[1]])
    nothing = np.zeros(2)
    bars = Bars(*on, *s, *at, q, length, nothing, nothing, nothing, nothing, 9.81, Ramp(0.0))
    nodes = np.concatenate([wire.nodes[[0, -1], :3] for wire in wires])
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((4, 3)), np.full(4, -1))
    guides = [Guides(on[k], s[k], at[k], P, ALONG) for k in (0, 1)]
    heights = TrackHeight(on[0], s[0], at[0], P, UP)
    parts = (CableElements.of(list(wires)), hinges, *guides, bars, Targets(length, heights, target))
    return Hanging(wires[0], System(table, parts), heights, length)


def check_heights(model: Hanging, z: np.ndarray, target: np.ndarray, up: np.ndarray = UP) -> None:
    """Distances of the wire from the plane of the rails at the places P along the track."""
    for i, point in enumerate(model.lower.evaluate(z, z[model.heights.s]).r):
        assert point[0] == pytest.approx(P[i, 0], abs=1e-9)
        assert float(np.dot(point - P[i], up[i])) == pytest.approx(target[i], abs=1e-9)


def test_lengths_of_bars_are_found_by_heights(lay_wire: Lay, solve_statics: Solve) -> None:
    target = np.array([5.4, 5.45])
    model = hanging(lay_wire, target)
    z = solve_statics(model.system, model.system.unknowns.start)[1]
    check_heights(model, z, target)
    assert (np.abs(z[model.length] - 1.2) > 1e-3).all()
    with pytest.raises(AssertionError):
        check_heights(model, z, target + 1e-6)
    with pytest.raises(AssertionError):
        check_heights(model, z, target, np.tile([0.0, 0.0, 1.0], (2, 1)))
    with pytest.raises(AssertionError):
        check_heights(model, z, target, UP * [1.0, -1.0, 1.0])  # canted to the other side


def test_without_cant_it_is_the_height_of_the_wire(lay_wire: Lay) -> None:
    model = hanging(lay_wire, np.zeros(2))
    z = model.system.unknowns.start + 0.01 * np.random.default_rng(8).normal(size=model.system.size)
    level = replace(model.heights, up=np.tile([0.0, 0.0, 1.0], (2, 1)))
    plain = WireHeight(model.lower, level.s, level.element)
    np.testing.assert_allclose(level.value(0.0, z) + P[:, 2], plain.value(0.0, z), atol=1e-14)
    dense, expected = np.zeros((2, z.size)), np.zeros((2, z.size))
    for matrix, measure in ((dense, level), (expected, plain)):
        for i in (0, 1):
            matrix[i, measure.columns()[i]] = measure.gradient(0.0, z)[i]
    np.testing.assert_allclose(dense, expected, atol=1e-14)
    assert np.abs(model.heights.value(0.0, z) - level.value(0.0, z)).min() > 0.01


def test_points_find_their_elements(lay_wire: Lay) -> None:
    heights = hanging(lay_wire, np.zeros(2)).heights
    z = hanging(lay_wire, np.zeros(2)).system.unknowns.start.copy()
    assert heights.relocate(z) is None
    z[heights.s] = [15.0, 0.1]
    moved = heights.relocate(z)
    assert moved is not None
    np.testing.assert_array_equal(moved.element, moved.carrier.locate(z[heights.s]))
