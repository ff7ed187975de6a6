"""A wire of two cables, joined by the fixed joint (16), is the same as one cable with shared nodes.

A wire hangs over a support between two hinges, one of which is pulled until the tension is right: form,
forces and natural frequencies do not tell whether it has been cut.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from catenaria.catenary.green_bar import stretch
from catenaria.catenary.taut_string import taut_string
from catenaria.formfinding.natural_frequencies import natural_frequencies
from catenaria.formfinding.static_problem import find_rest
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.measures import ReactionTension
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.fixed import FixedJoints, normals
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.joints.spherical import SphericalJoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.loads.linear import Inertia, assemble
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

SPAN, TENSION, G = 20.0, 4e3, 9.8  # m, N, m/s^2
WIRE = Section(EA=15.6e6, EJ=400.0, rhoA=0.9252)
ALONG = np.array([[1.0, 0.0, 0.0]])
PLACES = 2.0 * SPAN * np.outer([0.0, 1.0], ALONG)


@dataclass(frozen=True)
class Form:
    """What is seen of a wire: points, slopes' directions, forces, sliding coordinate, frequencies."""

    r: np.ndarray
    direction: np.ndarray
    force: np.ndarray
    s: np.ndarray
    frequency: np.ndarray


def knots(size: float, cut: float) -> np.ndarray:
    """Return nodes over two spans, finer towards the support and the cut."""
    centres = np.array([0.0, cut, SPAN, 2.0 * SPAN])
    count = np.round(np.diff(centres) / size).astype(int)
    parts = [
        a + (b - a) * 0.5 * (1.0 - np.cos(np.pi * np.arange(n) / n))
        for a, b, n in zip(centres[:-1], centres[1:], count, strict=True)
    ]
    return np.concatenate((*parts, centres[-1:]))


Joint = type[FixedJoints] | type[SphericalJoints] | None


def hang(size: float, cut: float, joint: Joint) -> Form:
    """Return the form of a wire that is cut at a material coordinate and joined, or in one piece."""
    s = knots(size, cut)
    builder = UnknownsBuilder()
    wires = [lay(builder, piece) for piece in ([s] if joint is None else [s[s <= cut], s[s >= cut]])]
    ends = builder.add(Kind.MULTIPLIER, np.outer([TENSION, -TENSION], ALONG), np.array([0.0, 2.0 * SPAN]))
    pull = builder.add(Kind.PARAMETER, np.zeros(1), 2.0 * SPAN)
    at = builder.add(Kind.SLIDING, np.array([SPAN / stretch(TENSION, WIRE.EA)]), SPAN)
    support = builder.add(Kind.MULTIPLIER, np.array([[0.0, 0.0, -SPAN * WIRE.rhoA * G]]), SPAN)
    count = 0 if joint is None else 5 if joint is FixedJoints else 3
    joined = builder.add(Kind.MULTIPLIER, np.zeros((1, count)), cut)
    table, order = builder.build_along_line()
    wires = [wire.renumbered(order) for wire in wires]
    ends, pull, at, support, joined = (order[index] for index in (ends, pull, at, support, joined))

    elements = CableElements.of(wires)
    outer = np.array([wires[0].nodes[0, :3], wires[-1].nodes[-1, :3]])
    system = System(
        table,
        (
            elements,
            Inertia(assemble(elements, elements.mass(), table.size)),
            Gravity(elements.weight(table.size), G, Ramp(0.0)),
            HeldPoints(outer, ends, PLACES, np.repeat(ALONG, 2, axis=0), np.array([-1, pull[0]])),
            SlidingJoints(wires[-1], at, support, wires[-1].locate(table.start[at]), SPAN * ALONG),
            Targets(pull, ReactionTension(ends[1:], ALONG), np.array([TENSION])),
            *joints(joint, wires, joined),
        ),
    )
    return seen(system, wires, np.concatenate((ends, support)), at)


def joints(joint: Joint, wires: list[Chain], multipliers: np.ndarray) -> tuple[Contribution, ...]:
    """Return what joins two cables, if there are two."""
    if joint is None:
        return ()
    before, after = wires[0].nodes[-1:], wires[1].nodes[:1]
    if joint is FixedJoints:
        return (FixedJoints(before, after, multipliers, normals(ALONG)),)
    return (SphericalJoints(before[:, :3], after[:, :3], multipliers),)


def seen(system: System, wires: list[Chain], forces: np.ndarray, at: np.ndarray) -> Form:
    """Find the wire at rest and return what is seen of it."""
    z = find_rest(system, system.unknowns.start).y
    r, r1 = (np.concatenate(part) for part in zip(*(points(wire, z) for wire in wires), strict=True))
    direction = r1 / np.linalg.norm(r1, axis=1)[:, None]
    return Form(r, direction, z[forces], z[at], natural_frequencies(system, z, 12).frequency)


def lay(builder: UnknownsBuilder, s: np.ndarray) -> Chain:
    """Add one cable as a taut string over the support."""
    supports = np.array([0.0, SPAN, 2.0 * SPAN]), np.zeros(3)
    height, slope = taut_string(s, supports, TENSION, WIRE.rhoA * G)
    f = float(stretch(TENSION, WIRE.EA))
    r = np.column_stack((s * f, 0.0 * s, height))
    r1 = f * np.column_stack((np.ones_like(s), 0.0 * s, slope))
    return Chain(builder.add_nodes(r, r1), s, WIRE)


def points(wire: Chain, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return r and r' at every 0.1 m of unstressed length."""
    everywhere = np.linspace(0.0, 2.0 * SPAN, round(20.0 * SPAN) + 1)
    s = everywhere[(everywhere >= wire.knots[0]) & (everywhere < wire.knots[-1])]
    found = wire.evaluate(z, s)
    return found.r, found.r1


def check_same(form: Form, other: Form) -> None:
    """Coordinates to 0.1 nm, forces to 0.1 uN, frequencies to 1e-9: what rounding leaves."""
    np.testing.assert_allclose(form.r, other.r, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(form.direction, other.direction, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(form.force, other.force, rtol=0.0, atol=1e-7)
    np.testing.assert_allclose(form.s, other.s, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(form.frequency, other.frequency, rtol=1e-9)


@pytest.mark.parametrize("cut", [7.03, 13.0])
@pytest.mark.parametrize("size", [1.0, 0.5])
def test_a_joined_wire_is_one_wire(size: float, cut: float) -> None:
    """Where nothing is clamped to it its slopes have one length, though the joint would let them differ."""
    check_same(hang(size, cut, FixedJoints), hang(size, cut, None))


@pytest.mark.parametrize("field", ["r", "direction", "force", "s", "frequency"])
def test_a_hinge_in_the_wire_is_noticed(field: str) -> None:
    """In form, in forces and in frequencies, each by itself."""
    whole, hinged = hang(1.0, 7.03, None), hang(1.0, 7.03, SphericalJoints)
    with pytest.raises(AssertionError):
        check_same(replace(whole, **{field: getattr(hinged, field)}), whole)
