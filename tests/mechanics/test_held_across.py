"""Points held across the track: by height or by lift, and never along the track."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_across import HeldAcross
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
SECTION = Section(EA=1e5, EJ=0.5, rhoA=1.0)
SPAN, UNSTRESSED, AT = 16.0, 15.8, 6.32
ALONG = np.array([np.cos(0.5), np.sin(0.5), 0.0])
LEFT = np.array([-np.sin(0.5), np.cos(0.5), 0.0])
UP = np.array([0.0, 0.0, 1.0])
X = 6.4 * ALONG + 0.35 * LEFT + 0.2 * UP


def test_residual_by_hand() -> None:
    """One point held at a height, one with a lift; the wire gets la_h h + la_v e_z at its nodes."""
    wire = Chain(np.arange(12).reshape(2, 6), np.array([0.0, 2.0]), SECTION)
    s, la, element = np.array([12, 13]), np.arange(14, 18).reshape(2, 2), np.zeros(2, dtype=np.int64)
    z = np.random.default_rng(4).normal(size=18)
    z[s] = [0.4, 1.5]
    part = HeldAcross(
        wire, s, la, element, np.ones((2, 3)), np.stack((ALONG, UP[[2, 1, 0]])), np.array([np.nan, 7.0])
    )
    part.add_residual(State.at_rest(z), f := np.zeros(18))
    off = wire.evaluate(z, z[s], element).r - 1.0
    np.testing.assert_allclose(f[14:], [LEFT @ off[0], off[0, 2], off[1, 1], z[17] + 7.0], atol=1e-14)
    total = f[:3] + f[6:9]  # the shape functions of both positions add up to one
    np.testing.assert_allclose(total, z[14] * LEFT + z[15] * UP + [0.0, z[16], z[17]], atol=1e-14)
    assert not f[s].any(), "the row of s belongs to a guide"


@dataclass(frozen=True)
class Held:
    """An equilibrium: forces of the wire on its hinges and on what holds it aside, and where it is held."""

    pulls: np.ndarray
    la: np.ndarray
    r: np.ndarray


def held(lay_wire: Lay, solve_statics: Solve, lift: float) -> Held:
    """Solve a wire along a track of another direction than x, held at a given material point."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], SPAN * ALONG, np.linspace(0.0, UNSTRESSED, 81), SECTION)
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    la = builder.add(Kind.MULTIPLIER, np.zeros((1, 2)))
    s = builder.add(Kind.SLIDING, np.array([AT]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros((2, 3)), np.array([-1, -1]))
    at = wire.locate(np.array([AT]))
    across = HeldAcross(wire, s, la, at, X[None], ALONG[None], np.array([lift]))
    parts = (CableElements.of([wire]), hinges, across, Given(s, np.array([AT])))
    _, z = solve_statics(System(table, parts), table.start)
    return Held(z[ends], z[la][0], wire.evaluate(z, z[s]).r[0])


def check_held(found: Held) -> None:
    """Where it should be across the track, with a force that has no component along it."""
    np.testing.assert_allclose([LEFT @ (found.r - X), UP @ (found.r - X)], 0.0, atol=1e-10)
    force = -found.pulls.sum(axis=0)
    np.testing.assert_allclose(force, found.la[0] * LEFT + found.la[1] * UP, atol=1e-7)
    assert abs(force @ ALONG) < 1e-7


def test_held_at_a_height(lay_wire: Lay, solve_statics: Solve) -> None:
    found = held(lay_wire, solve_statics, np.nan)
    check_held(found)
    assert found.la[0] < -50.0, "the wire pulls back to the right"
    assert found.la[1] < -30.0, "and down"
    assert abs((found.r - X) @ ALONG) > 1e-4, "nothing holds it along the track"


def check_lift(found: Held, lift: float) -> None:
    """The support lifts by the force that is asked for, and a string rises by F a b/(H L)."""
    np.testing.assert_allclose(found.pulls[:, 2].sum(), lift, atol=1e-8)
    np.testing.assert_allclose(LEFT @ (found.r - X), 0.0, atol=1e-10)
    H, a = abs(found.pulls[0] @ ALONG), found.r @ ALONG
    np.testing.assert_allclose(found.r[2], lift * a * (SPAN - a) / (H * SPAN), rtol=1e-2)


@pytest.mark.parametrize("lift", [40.0, -25.0, 0.0])
def test_given_lift(lay_wire: Lay, solve_statics: Solve, lift: float) -> None:
    found = held(lay_wire, solve_statics, lift)
    check_lift(found, lift)
    with pytest.raises(AssertionError):
        check_lift(found, 1.0 - lift)


def test_control_held_and_lifted_differ(lay_wire: Lay, solve_statics: Solve) -> None:
    with pytest.raises(AssertionError):
        check_held(held(lay_wire, solve_statics, 40.0))
    with pytest.raises(AssertionError):
        check_lift(held(lay_wire, solve_statics, np.nan), 40.0)
