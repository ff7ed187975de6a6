"""Controls (19)-(23): residual, and stability of the closed loop in four small models with real elements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.measures import DropperForce, Height, ReactionTension, StrainTension
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.guided import GuidedJoints
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

Lay = Callable[..., Chain]
Solve = Callable[..., tuple[System, np.ndarray]]
LATE = 1e9


@dataclass(frozen=True)
class Loop:
    """A structure with one control; `start` is where a static solution begins."""

    system: System
    parameter: int
    start: np.ndarray

    def control(self, system: System) -> Controls:
        return next(part for part in system.contributions if isinstance(part, Controls))


def tension_loop(lay_wire: Lay, strain: bool) -> Loop:
    """Return a wire that lies over two supports, its ends pulled outwards by one parameter; target 500 N."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 0], [10, 0, 0], np.linspace(0.0, 10.0, 11), Section(2e4, 50.0, 0.5))
    la = builder.add(Kind.MULTIPLIER, np.zeros((4, 3)))
    s = builder.add(Kind.SLIDING, np.array([1.5, 8.5]))
    p = builder.add(Kind.PARAMETER, np.array([0.1]))
    table = builder.build()
    nodes = wire.nodes[[0, -1], :3]
    outwards = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    at = wire.locate(table.start[s])
    supports = SlidingJoints(wire, s, la[2:], at, np.array([[1.5, 0.0, 0.0], [8.5, 0.0, 0.0]]))
    ends = HeldPoints(nodes, la[:2], table.start[nodes], outwards, np.repeat(p, 2))
    measure = StrainTension(wire, s[1:], at[1:]) if strain else ReactionTension(la[1:2], outwards[1:])
    control = Controls(p, measure, np.array([500.0]), VelocityLaw(0.02, 5.0, 100.0), Ramp(5.0), Ramp(0.0))
    elements = CableElements.of([wire])
    gravity = Gravity(elements.weight(table.size), 9.8, Ramp(5.0))
    start = table.start.copy()
    start[wire.nodes[:, [0, 3]]] *= 1.02
    start[wire.nodes[:, 0]] -= 0.1
    return Loop(System(table, (elements, gravity, supports, ends, control)), int(p[0]), start)


def dropper_loop(lay_wire: Lay, up: bool) -> Loop:
    """Return a tensioned wire with one dropper cable, raised to a height or pulled down to a force."""
    builder = UnknownsBuilder()
    wire = lay_wire(builder, [0, 0, 5], [10, 0, 5], np.linspace(0.0, 9.9, 21), Section(2e4, 10.0, 0.5))
    far = 6.0 if up else 4.0
    cable = lay_wire(builder, [4, 0, 5], [4, 0, far], np.linspace(0.0, 1.0, 3), Section(2e4, 0.1, 0.2))
    la = builder.add(Kind.MULTIPLIER, np.zeros((4, 3)))
    s = builder.add(Kind.SLIDING, np.array([4.0]))
    p = builder.add(Kind.PARAMETER, np.array([0.1]))
    table = builder.build()
    ends = np.concatenate((wire.nodes[[0, -1], :3], cable.nodes[-1:, :3]))
    along = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, far - 5.0]])
    held = HeldPoints(ends, la[:3], table.start[ends], along, np.array([-1, -1, p[0]]))
    inner = cable.nodes[:1, :3]
    clamp = GuidedJoints(wire, s, la[3:], wire.locate(table.start[s]), np.array([4.0]), inner)
    if up:
        control = Controls(
            p, Height(inner[:, 2]), np.array([5.05]), VelocityLaw(0.02, 1e-3, 0.1), Ramp(5.0), Ramp(0.0)
        )
    else:
        measure = DropperForce(
            la[3:, 2], inner, np.array([[4.0, 0.0, 3.9]]), 0.2, np.zeros(1), 9.8, Ramp(5.0)
        )
        control = Controls(p, measure, np.array([40.0]), VelocityLaw(0.02, 0.2, 50.0), Ramp(5.0), Ramp(5.0))
    elements = CableElements.of([wire, cable])
    gravity = Gravity(elements.weight(table.size), 9.8, Ramp(5.0))
    return Loop(System(table, (elements, gravity, held, clamp, control)), int(p[0]), table.start)


LOOPS: dict[str, Callable[[Lay], Loop]] = {
    "reaction": lambda lay_wire: tension_loop(lay_wire, strain=False),
    "strain": lambda lay_wire: tension_loop(lay_wire, strain=True),
    "height": lambda lay_wire: dropper_loop(lay_wire, up=True),
    "dropper force": lambda lay_wire: dropper_loop(lay_wire, up=False),
}


def at_parameter(
    loop: Loop, solve_statics: Solve, start: tuple[System, np.ndarray], p: float
) -> tuple[System, np.ndarray]:
    """Return the equilibrium with the parameter held at p."""
    system, z = start
    z = z.copy()
    z[loop.parameter] = p
    return solve_statics(system, z, [loop.parameter])


def error_and_rate(loop: Loop, solved: tuple[System, np.ndarray]) -> tuple[float, float]:
    """Return e, and the p' that makes the control's residual zero."""
    system, z = solved
    f = np.zeros(z.size)
    control = loop.control(system)
    control.add_residual(State.at_rest(z, LATE), f)
    return float(control.error(LATE, z)[0]), -float(f[loop.parameter])


def check_stable(loop: Loop, solve_statics: Solve) -> None:
    """More p gives more m, p' opposes e, and the quasi-static loop runs into its target."""
    solved = at_parameter(loop, solve_statics, (loop.system, loop.start), 0.1)
    e, _ = error_and_rate(loop, solved)
    more, _ = error_and_rate(loop, at_parameter(loop, solve_statics, solved, 0.101))
    gain = (more - e) / 0.001
    assert gain > 0.0, f"dm/dp = {gain}"
    law = loop.control(loop.system).law
    dt = 0.5 / (1.5 * law.v_s / (law.e1 - law.e0) * gain)
    p, errors = 0.1, [e]
    for _ in range(12):
        e, rate = error_and_rate(loop, solved)
        assert rate * e < 0.0
        p += dt * rate
        solved = at_parameter(loop, solve_statics, solved, p)
        errors.append(error_and_rate(loop, solved)[0])
    sizes = np.abs(errors)
    assert np.all(np.diff(sizes) < 0.0), f"errors {errors}"
    assert sizes[-1] < 0.3 * min(sizes[0], law.e1)


@pytest.mark.parametrize("name", LOOPS)
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_loop_is_stable(name: str, side: float, lay_wire: Lay, solve_statics: Solve) -> None:
    """From below and from above the target: it is moved to either side of where the loop starts."""
    loop = LOOPS[name](lay_wire)
    check_stable(aside(loop, solve_statics, side), solve_statics)


def aside(loop: Loop, solve_statics: Solve, side: float) -> Loop:
    """Return the loop with a target that makes its first error 0.6 e1 on the given side."""
    control = loop.control(loop.system)
    e, _ = error_and_rate(loop, at_parameter(loop, solve_statics, (loop.system, loop.start), 0.1))
    shifted = replace(control, target=control.target + e - 0.6 * side * control.law.e1)
    parts = tuple(shifted if part is control else part for part in loop.system.contributions)
    return replace(loop, system=replace(loop.system, contributions=parts))


@pytest.mark.parametrize("name", LOOPS)
def test_control_reversed_direction_runs_away(name: str, lay_wire: Lay, solve_statics: Solve) -> None:
    """With the driven points' directions reversed, the very same check fails."""
    loop = aside(LOOPS[name](lay_wire), solve_statics, 1.0)
    parts = tuple(
        replace(part, direction=-part.direction, X=part.X + 0.2 * part.direction)
        if isinstance(part, HeldPoints)
        else part
        for part in loop.system.contributions
    )
    with pytest.raises(AssertionError, match="dm/dp"):
        check_stable(replace(loop, system=replace(loop.system, contributions=parts)), solve_statics)


def check_residual(control: Controls, state: State, expected: np.ndarray) -> None:
    f = np.zeros(state.z.size)
    control.add_residual(state, f)
    np.testing.assert_allclose(f, expected, rtol=1e-13)


@pytest.mark.parametrize(("t", "ramp"), [(0.0, 0.0), (1.0, 0.104), (5.0, 1.0), (9.0, 1.0)])
def test_residual_by_hand(t: float, ramp: float) -> None:
    """Rate p' - ramp v(e): 1.5 too high saturates, 0.5 too low is halfway; the ramp brings both in."""
    z, zd = np.array([4.0, 2.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.3, -0.2])
    law = VelocityLaw(0.1, 0.0, 1.0)
    control = Controls(
        np.array([2, 3]), Height(np.array([0, 1])), np.array([2.5, 2.5]), law, Ramp(5.0), Ramp(0.0)
    )
    expected = np.array([0.0, 0.0, 0.3 + ramp * 0.1, -0.2 - ramp * 0.05])
    np.testing.assert_allclose(control.error(t, z), [1.5, -0.5])
    check_residual(control, State(t, z, zd, z), expected)
    if ramp:
        with pytest.raises(AssertionError):
            check_residual(replace(control, target=-control.target), State(t, z, zd, z), expected)


def test_target_ramp() -> None:
    """A target that balances weight grows with it: at half of gravity (t = 2.5 of 5) half of it is wanted."""
    z = np.array([3.0, 0.0])
    law, ramp = VelocityLaw(0.1, 0.0, 1.0), Ramp(5.0)
    control = Controls(np.array([1]), Height(np.array([0])), np.array([4.0]), law, ramp, ramp)
    for t, error in ((0.0, 3.0), (2.5, 1.0), (5.0, -1.0), (9.0, -1.0)):
        np.testing.assert_allclose(control.error(t, z), error, rtol=1e-12)
    np.testing.assert_allclose(replace(control, target_ramp=Ramp(0.0)).error(2.5, z), -1.0, rtol=1e-12)


def test_relocates_with_its_measure(lay_wire: Lay) -> None:
    """Controls of strain follow the point into its element; all others have no discrete state."""
    loop = tension_loop(lay_wire, strain=True)
    control, z = loop.control(loop.system), loop.start.copy()
    measure = control.measure
    assert isinstance(measure, StrainTension)
    assert control.relocate(z) is None
    z[measure.s] = 3.3
    moved = control.relocate(z)
    assert moved is not None
    assert isinstance(moved.measure, StrainTension)
    np.testing.assert_array_equal(moved.measure.element, [3])
    assert replace(moved, measure=measure) == control
    other = tension_loop(lay_wire, strain=False)
    assert other.control(other.system).relocate(z) is None
