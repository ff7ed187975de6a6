"""Bars by force density between taut wires: statics by hand, whole droppers, slackness."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.elements.bars import Bars
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.elements.dropper import Droppers
from catenaria.mechanics.joints.guides import Guides
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
G, SPAN, LATE = 9.81, 16.0, 1e9
X = np.array([4.0, 11.0])
SECTION = Section(EA=1e6, EJ=0.01, rhoA=1.0)
KNOTS = np.linspace(0.0, 15.95, 33)
FLEXIBILITY, RHO_A = np.array([1.0 / 4e4, 0.0]), np.array([0.3, 0.2])
MASS_LOWER, MASS_UPPER = np.array([0.2, 0.5]), np.array([0.1, 0.4])
SHORT, LONG = np.array([1.1, 1.2]), np.array([1.5, 1.6])
APART = ((0.4, 1.2), (-0.5, 1.3))  # y and z of the upper wires: the bars incline to either side


@dataclass(frozen=True)
class Hung:
    """A lower wire with an elastic and a rigid bar, each to an upper wire of its own or both to one."""

    wires: tuple[Chain, ...]
    system: System
    bars: Bars
    ends: np.ndarray

    def replaced(self, **change: Any) -> Hung:
        """Return the same with other bars."""
        bars = replace(self.bars, **change)
        parts = tuple(bars if isinstance(part, Bars) else part for part in self.system.contributions)
        return replace(self, bars=bars, system=replace(self.system, contributions=parts))


def hung(lay_wire: Lay, length: np.ndarray, uppers: tuple[tuple[float, float], ...] = APART) -> Hung:
    builder = UnknownsBuilder()
    wires = tuple(
        lay_wire(builder, [0, y, z], [SPAN, y, z], KNOTS, SECTION) for y, z in ((0.0, 0.0), *uppers)
    )
    ends = builder.add(Kind.MULTIPLIER, np.zeros((2 * len(wires), 3)))
    s = builder.add(Kind.SLIDING, X + 0.3), builder.add(Kind.SLIDING, X + 0.3)
    density, l0 = builder.add(Kind.MULTIPLIER, np.full(2, 50.0)), builder.add(Kind.PARAMETER, length)
    table = builder.build()
    on = Strands.on(wires[:1], np.array([0, 0])), Strands.on(wires[1:], np.array([0, len(uppers) - 1]))
    at = on[0].locate(table.start[s[0]]), on[1].locate(table.start[s[1]])
    places, along = np.column_stack((X, np.zeros((2, 2)))), np.tile([1.0, 0.0, 0.0], (2, 1))
    bars = Bars(
        *on, *s, *at, density, l0, FLEXIBILITY, RHO_A, MASS_LOWER, MASS_UPPER, G, Ramp(20.0), only_pull=False
    )
    nodes = np.concatenate([wire.nodes[[0, -1], :3] for wire in wires])
    hinges = HeldPoints(nodes, ends, table.start[nodes], np.zeros(nodes.shape), np.full(len(nodes), -1))
    guides = [Guides(on[k], s[k], at[k], places, along) for k in (0, 1)]
    parts = (CableElements.of(list(wires)), hinges, *guides, bars, Given(l0, length))
    return Hung(wires, System(table, parts), bars, ends)


def solved(model: Hung, solve_statics: Solve, load: np.ndarray | None = None) -> tuple[Bars, np.ndarray]:
    """Return the bars where they are in the end, and the equilibrium."""
    system, z = solve_statics(model.system, model.system.unknowns.start, (), load)
    (bars,) = (part for part in system.contributions if isinstance(part, Bars))
    return bars, z


def between(bars: Bars, z: np.ndarray) -> np.ndarray:
    """Return the vectors from the lower to the upper clamps."""
    return bars.upper.evaluate(z, z[bars.s_upper]).r - bars.lower.evaluate(z, z[bars.s_lower]).r


def check_balance(model: Hung, bars: Bars, z: np.ndarray, rhoA: np.ndarray = RHO_A) -> None:
    """What ends of wires hold is what bars do to them; all ends together hold the weight."""
    on_lower, on_upper = bars.loads(LATE, z)
    la = z[model.ends].reshape(-1, 2, 3).sum(axis=1)
    np.testing.assert_allclose(la[0], on_lower.sum(axis=0), atol=1e-6)
    np.testing.assert_allclose(la[1:], on_upper, atol=1e-6)
    size = np.linalg.norm(between(bars, z), axis=1)
    weight = G * float((rhoA * size + MASS_LOWER + MASS_UPPER).sum())
    np.testing.assert_allclose(la.sum(axis=0), [0.0, 0.0, -weight], atol=1e-6)


def pulls(bars: Bars, z: np.ndarray) -> np.ndarray:
    """Return what is left of the forces on the lower wire without half of the weight and the clamps."""
    half = 0.5 * RHO_A * np.linalg.norm(between(bars, z), axis=1)
    return bars.loads(LATE, z)[0] + np.outer(G * (half + MASS_LOWER), [0.0, 0.0, 1.0])


def check_elasticity(bars: Bars, z: np.ndarray, flexibility: np.ndarray) -> None:
    """Pulls are along the bars: EA times Green strain for the elastic one, the rigid one keeps its length."""
    d, l0, pull = between(bars, z), z[bars.length], pulls(bars, z)
    size = np.linalg.norm(d, axis=1)
    np.testing.assert_allclose(np.cross(pull, d), 0.0, atol=1e-9)
    assert (np.einsum("ni,ni->n", pull, d) > 0.0).all()
    strain = 0.5 * ((size / l0) ** 2 - 1.0)
    np.testing.assert_allclose(strain, flexibility * np.linalg.norm(pull, axis=1) * l0 / size, atol=1e-9)


def check_string(model: Hung, bars: Bars, z: np.ndarray, force: np.ndarray) -> None:
    """Deflections of the lower wire across, times H, are moments of a beam: within its bending, 1 %."""
    H = z[model.ends][0, 0]
    right = (X / SPAN) @ force
    moment = np.stack((X[0] * (force.sum(axis=0) - right), (SPAN - X[1]) * right))
    r = bars.lower.evaluate(z, z[bars.s_lower]).r
    np.testing.assert_allclose(r[:, 0], X, atol=1e-9)
    np.testing.assert_allclose(r[:, 1:] * H, moment[:, 1:], atol=0.01 * np.abs(moment).max())


def test_inclined_bars_balance(lay_wire: Lay, solve_statics: Solve) -> None:
    model = hung(lay_wire, SHORT)
    bars, z = solved(model, solve_statics)
    check_balance(model, bars, z)
    check_elasticity(bars, z, FLEXIBILITY)
    check_string(model, bars, z, bars.loads(LATE, z)[0])
    d = between(bars, z)
    np.testing.assert_allclose(d[:, 0], 0.0, atol=1e-9)
    assert (np.abs(d[:, 1]) > 0.2).all()
    assert z[model.ends][0, 0] == pytest.approx(-z[model.ends][1, 0], rel=1e-9)  # no force along the track


def test_control_wrong_statics_are_noticed(lay_wire: Lay, solve_statics: Solve) -> None:
    model = hung(lay_wire, SHORT)
    bars, z = solved(model, solve_statics)
    with pytest.raises(AssertionError):
        check_balance(model, bars, z, rhoA=1.01 * RHO_A)
    with pytest.raises(AssertionError):
        check_balance(model, replace(bars, mass_lower=MASS_UPPER), z)
    with pytest.raises(AssertionError):
        check_elasticity(bars, z, FLEXIBILITY * 1.001)
    with pytest.raises(AssertionError):
        check_elasticity(bars, z, FLEXIBILITY + 1e-7)  # the rigid bar is rigid
    with pytest.raises(AssertionError):
        check_elasticity(replace(bars, rhoA=0.9 * RHO_A), z, FLEXIBILITY)
    with pytest.raises(AssertionError):
        check_string(model, bars, z, bars.loads(LATE, z)[0] * 1.02)


def test_a_flexible_bar_becomes_longer_and_a_rigid_one_does_not(lay_wire: Lay, solve_statics: Solve) -> None:
    bars, z = solved(hung(lay_wire, SHORT), solve_statics)
    stretch = np.linalg.norm(between(bars, z), axis=1) / SHORT - 1.0
    assert stretch[0] > 1e-3
    assert abs(stretch[1]) < 1e-12


def whole(model: Hung, EA: float, rhoA: float, clamps: tuple[float, float]) -> System:
    """Return the same line with whole droppers instead of bars and guides."""
    bars, (lower, upper) = model.bars, model.wires
    at = lower.locate(X + 0.3), upper.locate(X + 0.3)
    droppers = Droppers(
        lower, upper, bars.s_lower, bars.s_upper, *at, bars.length, X, EA, rhoA, *clamps, G, may_push=True
    )
    cables, hinges, *_, lengths = model.system.contributions
    idle = Given(bars.density, np.zeros(2))
    return System(model.system.unknowns, (cables, hinges, droppers, lengths, idle))


def check_like_whole_droppers(model: Hung, solve_statics: Solve, EA: float) -> None:
    """Wires, forces of both ends and reactions are the same."""
    bars, z = solved(model, solve_statics)
    system = whole(model, EA, 0.3, (0.2, 0.1))
    other, y = solve_statics(system, system.unknowns.start)
    (droppers,) = (part for part in other.contributions if isinstance(part, Droppers))
    for wire in model.wires:
        np.testing.assert_allclose(z[wire.nodes], y[wire.nodes], atol=1e-9)
    np.testing.assert_allclose(z[model.ends], y[model.ends], atol=1e-5)
    np.testing.assert_allclose(bars.loads(LATE, z), droppers.loads(y), atol=1e-6)


def test_vertical_bars_are_whole_droppers(lay_wire: Lay, solve_statics: Solve) -> None:
    """In the plane; also of a bar that is too long and pushes."""
    model = hung(lay_wire, np.array([1.15, 1.22]), ((0.0, 1.2),)).replaced(
        flexibility=np.full(2, 1.0 / 5e4),
        rhoA=np.full(2, 0.3),
        mass_lower=np.full(2, 0.2),
        mass_upper=np.full(2, 0.1),
    )
    check_like_whole_droppers(model, solve_statics, 5e4)
    with pytest.raises(AssertionError):
        check_like_whole_droppers(model, solve_statics, 5.05e4)
    with pytest.raises(AssertionError):
        check_like_whole_droppers(model.replaced(g=0.99 * G), solve_statics, 5e4)


def check_slack(bars: Bars, z: np.ndarray) -> None:
    """Nothing but weights on the wires, and the clamps are nearer than the bars are long."""
    np.testing.assert_allclose(pulls(bars, z), 0.0, atol=1e-9)
    assert (np.linalg.norm(between(bars, z), axis=1) < z[bars.length]).all()
    assert bars.slack(z).all()


def test_slack_bars_only_weigh(lay_wire: Lay, solve_statics: Solve) -> None:
    """From a start in which both are taut."""
    model = hung(lay_wire, LONG)
    hanging = model.replaced(only_pull=True)
    bars, z = solved(hanging, solve_statics)
    check_slack(bars, z)
    check_balance(hanging, bars, z)
    pushing, y = solved(model, solve_statics)
    assert (y[pushing.density] < 0.0).all()
    with pytest.raises(AssertionError):
        check_slack(pushing, y)


def test_taut_bars_that_can_only_pull_are_like_others(lay_wire: Lay, solve_statics: Solve) -> None:
    model = hung(lay_wire, SHORT)
    z = solved(model, solve_statics)[1]
    bars, y = solved(model.replaced(only_pull=True), solve_statics)
    np.testing.assert_allclose(y, z, rtol=1e-9, atol=1e-9)
    assert not bars.slack(y).any()


@pytest.mark.parametrize(("load", "taut"), [(30.0, False), (400.0, True)])
def test_a_load_makes_slack_bars_taut(lay_wire: Lay, solve_statics: Solve, load: float, taut: bool) -> None:
    """Both kinds of bars take part as soon as the lower wire has come down far enough."""
    free = hung(lay_wire, LONG).replaced(only_pull=True)
    down = np.zeros(free.system.size)
    down[free.wires[0].nodes[[8, 22], 2]] = -load
    bars, z = solved(free, solve_statics, down)
    reach = np.linalg.norm(between(bars, z), axis=1)
    model = hung(lay_wire, reach + 0.02 if not taut else reach - 0.02).replaced(only_pull=True)
    bars, z = solved(model, solve_statics, down)
    np.testing.assert_array_equal(bars.slack(z), not taut)
    if taut:
        check_elasticity(bars, z, FLEXIBILITY)
        assert (z[bars.density] > 1.0).all()
    else:
        check_slack(bars, z)


def row(model: Hung, q: float, gap: float) -> np.ndarray:
    """Return the bars' equations where both have density q, and lack `gap` of length to be unstressed."""
    z = model.system.unknowns.start.copy()
    z[model.bars.density] = q
    z[model.bars.length] = np.linalg.norm(between(model.bars, z), axis=1) + gap
    f = np.zeros_like(z)
    model.bars.add_residual(State.at_rest(z), f)
    return f[model.bars.density]


def test_equation_of_bars_that_only_pull(lay_wire: Lay) -> None:
    """It is met by a taut bar in its length, by a slack one without force, and by nothing else."""
    model = hung(lay_wire, SHORT).replaced(only_pull=True)
    reach = np.linalg.norm(between(model.bars, model.system.unknowns.start), axis=1)
    elastic, rigid = row(model, 0.0, 0.1)
    assert elastic == 0.0
    assert rigid == 0.0
    assert abs(row(model, 70.0, 0.0)[1]) < 1e-15  # taut in its length
    for q, gap in ((-5.0, 0.0), (-5.0, 0.01), (-5.0, -0.01), (5.0, 0.01), (0.0, -0.01)):
        assert (np.abs(row(model, q, gap)) > 1e-5).all()
    l0 = reach[0] - 0.01
    q = 0.5 * (reach[0] ** 2 / l0**2 - 1.0) / (l0 * FLEXIBILITY[0])
    assert abs(row(model, q, -0.01)[0]) < 1e-12
    assert abs(row(model, q, +0.01)[0]) > 1e-3
    assert abs(row(model, 1.01 * q, -0.01)[0]) > 1e-5


def test_weights_grow_with_the_ramp_and_pulls_do_not(lay_wire: Lay) -> None:
    model = hung(lay_wire, SHORT)
    z = model.system.unknowns.start
    start, middle, late = (np.array(model.bars.loads(t, z)) for t in (0.0, 10.0, LATE))
    np.testing.assert_allclose(start[0], -start[1], atol=1e-12)
    np.testing.assert_allclose(start[0], 50.0 * between(model.bars, z), atol=1e-12)
    np.testing.assert_allclose(middle, 0.5 * (start + late), atol=1e-12)
    assert np.abs(late - start).max() > 1.0


def test_forces_turn_with_the_line(lay_wire: Lay, turn: np.ndarray) -> None:
    """Without gravity there is no direction but those of the line."""
    model = hung(lay_wire, SHORT).replaced(g=0.0)
    z = model.system.unknowns.start
    turned = z.copy()
    for wire in model.wires:
        for part in (wire.nodes[:, :3], wire.nodes[:, 3:]):
            turned[part] = z[part] @ turn.T
    for own, other in zip(model.bars.loads(LATE, z), model.bars.loads(LATE, turned), strict=True):
        np.testing.assert_allclose(other, own @ turn.T, atol=1e-10)


def test_bars_find_their_elements(lay_wire: Lay) -> None:
    model = hung(lay_wire, SHORT)
    z = model.system.unknowns.start.copy()
    assert model.bars.relocate(z) is None
    z[model.bars.s_upper] = [12.3, 0.7]
    moved = model.bars.relocate(z)
    assert moved is not None
    np.testing.assert_array_equal(moved.element_lower, model.bars.element_lower)
    np.testing.assert_array_equal(moved.element_upper, moved.upper.locate(z[moved.s_upper]))
