"""Square but singular systems are refused by the name of what can move; their neighbours are solved."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.from_line import contact_wire_setup
from catenaria.discretise.wire_alone import WireAlone, build_wire_alone
from catenaria.errors import NotConvergedError, SingularError
from catenaria.formfinding import free_motion
from catenaria.formfinding.free_motion import FreeMotion, ParameterCheck, refuse_free_motion, softest_motion
from catenaria.formfinding.springs import Springs
from catenaria.formfinding.static_problem import find_rest, static_problem
from catenaria.line import Line
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.measures import Height, ReactionTension
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, Unknowns, UnknownsBuilder
from catenaria.solvers.linear import factorise
from catenaria.solvers.newton import solve_newton
from catenaria.solvers.rank import softest

TENSION = 15e3  # N


def spans(line: Line, count: int) -> Line:
    data = line.model_dump()
    ends, inner = (data["supports"][0], data["supports"][-1]), data["supports"][1]
    supports: list[dict[str, Any]] = [ends[0], *[inner] * (count - 1), ends[1]]
    for support in supports:
        support.pop("name", None)
    return Line.model_validate(data | {"spans": [data["spans"][0]] * count, "supports": supports})


def contact_wire(line: Line) -> WireAlone:
    return build_wire_alone(replace(contact_wire_setup(line), gravity_ramp=Ramp(0.0)))


def with_two_pulls(model: WireAlone, second: Callable[[np.ndarray, HeldPoints], Contribution]) -> System:
    """Return the wire with a pull of its own at its start, whose row holds what `second` returns."""
    unknowns, pull = model.system.unknowns, model.hung.pull
    new = np.array([unknowns.size])
    table = Unknowns(np.append(unknowns.kind, int(Kind.PARAMETER)), np.append(unknowns.start, 0.0))
    parts: list[Contribution] = []
    for part in model.system.contributions:
        if isinstance(part, HeldPoints):
            part = replace(part, parameter=np.concatenate((new, pull)))
            parts.append(second(new, part))
        elif isinstance(part, Gravity):
            part = replace(part, weight=np.append(part.weight, 0.0))
        parts.append(part)
    return System(table, tuple(parts))


def second_tension(new: np.ndarray, ends: HeldPoints) -> Contribution:
    return Targets(new, ReactionTension(ends.multipliers[:1], ends.direction[:1]), np.array([TENSION]))


def names(model: WireAlone) -> list[tuple[str, np.ndarray]]:
    size = model.system.size
    return [
        ("the contact wire", model.hung.wire.nodes),
        ("the pull at its end", model.hung.pull),
        ("the pull at its start", np.array([size])),
    ]


def guess(model: WireAlone) -> np.ndarray:
    z = model.guess()
    return np.append(z, z[model.hung.pull])


def fitting(system: System, z: np.ndarray) -> System:
    return system.relocate(z) or system


@pytest.mark.parametrize("count", [1, 3, 30])
def test_two_tensions_on_a_wire_that_slides_are_refused_by_name(line: Line, count: int) -> None:
    model = contact_wire(spans(line, count))
    z = guess(model)
    system = fitting(with_two_pulls(model, second_tension), z)
    with pytest.raises(SingularError) as caught:
        find_rest(system, z, names=names(model))
    message = str(caught.value)
    assert "the contact wire at" in message
    assert "moves along x and slides through its joints" in message
    both = "(the pull at its (end|start)(, )?){2}"
    assert re.search(f"go with it: {both}; targets that do not hold it: those of {both}", message)
    motion = caught.value.partial
    assert isinstance(motion, FreeMotion)
    x = motion.motion[model.hung.wire.nodes[:, 0]]
    np.testing.assert_allclose(x, x[0], rtol=0.1)  # as one


def test_one_tension_and_one_held_end_are_solved(line: Line) -> None:
    model = contact_wire(spans(line, 3))
    z = guess(model)
    held = with_two_pulls(model, lambda new, _: Given(new, z[-1:]))
    y = find_rest(fitting(held, z), z, names=names(model)).y
    np.testing.assert_allclose(y[model.hung.pull], z[-1], atol=1e-4)  # the tension asks for the same pull
    one = find_rest(fitting(model.system, z[:-1]), z[:-1]).y
    np.testing.assert_allclose(y[model.clamp_force], one[model.clamp_force], atol=0.05)


def test_newtons_method_alone_gives_no_name(line: Line) -> None:
    model = contact_wire(spans(line, 3))
    z = guess(model)
    with pytest.raises(NotConvergedError, match="no damping"):
        solve_newton(static_problem(fitting(with_two_pulls(model, second_tension), z)), z)


def looseness(system: System, z: np.ndarray) -> float:
    """Return how far parameters are moved, as `ParameterCheck` judges it."""
    kind, matrix = system.unknowns.kind, static_problem(system).jacobian(z)
    springs = Springs.of(kind, matrix)
    looked_at = np.where(kind == Kind.PARAMETER, springs.looked_at, 0.0)
    return ParameterCheck(system, z).looseness(softest(factorise(matrix), springs.unit_load, looked_at).give)


@pytest.mark.parametrize("count", [1, 3, 30])
def test_lines_are_far_from_the_limit_on_both_sides(line: Line, count: int) -> None:
    model = contact_wire(spans(line, count))
    z = guess(model)
    assert looseness(fitting(model.system, z[:-1]), z[:-1]) < 0.01 * free_motion.LOOSE
    loose = looseness(fitting(with_two_pulls(model, second_tension), z), z)
    assert loose > 10.0 * free_motion.LOOSE


SECTION = Section(EA=1e6, EJ=100.0, rhoA=1.0)


class Beam:
    """A beam of 10 m along x; hinges and slides are added one by one."""

    def __init__(self, tension: float = 1e3) -> None:
        self.builder, self.parts = UnknownsBuilder(), []
        knots = np.linspace(0.0, 10.0, 6)
        factor = float(stretch(tension, SECTION.EA))
        along = np.array([factor, 0.0, 0.0])
        nodes = self.builder.add_nodes(knots[:, None] * along, np.tile(along, (6, 1)))
        self.wire = Chain(nodes, knots, SECTION)
        self.factor = factor

    def hinge(self, node: int, force: float, parameter: int = -1) -> HeldPoints:
        """Hold a node at where it is."""
        X = np.array([[self.factor * self.wire.knots[node], 0.0, 0.0]])
        la = self.builder.add(Kind.MULTIPLIER, np.array([[force, 0.0, 0.0]]))
        at = self.wire.nodes[[node], :3]
        part = HeldPoints(at, la, X, np.array([[1.0, 0.0, 0.0]]), np.array([parameter]))
        self.parts.append(part)
        return part

    def slide(self, s: float) -> None:
        """Let the beam slide through a point of space."""
        at = self.builder.add(Kind.SLIDING, [s])
        la = self.builder.add(Kind.MULTIPLIER, np.zeros((1, 3)))
        X = np.array([[self.factor * s, 0.0, 0.0]])
        self.parts.append(SlidingJoints(self.wire, at, la, self.wire.locate(np.array([s])), X))

    def system(self, g: float = 9.8) -> System:
        """Return all of it with gravity."""
        table, elements = self.builder.build(), CableElements.of([self.wire])
        gravity = Gravity(elements.weight(table.size), g, Ramp(0.0))
        return System(table, (elements, gravity, *self.parts))


def solve(beam: Beam) -> np.ndarray:
    system = beam.system()
    return find_rest(system, system.unknowns.start, names=[("the beam", beam.wire.nodes)]).y


def test_a_beam_between_hinges_is_solved() -> None:
    beam = Beam()
    beam.hinge(0, 1e3)
    beam.hinge(5, -1e3)
    assert solve(beam)[beam.wire.nodes[2, 2]] < -0.01


def test_a_beam_on_slides_alone_is_free_along_itself() -> None:
    beam = Beam(0.0)
    beam.slide(2.0)
    beam.slide(8.0)
    with pytest.raises(SingularError, match=r"the beam at .* moves along x and slides through its joints"):
        solve(beam)
    beam.hinge(0, 0.0)
    system = beam.system()
    held = softest_motion(system, system.unknowns.start)
    assert held.give * held.stiffest < 1e-3 * free_motion.SOFT


def test_a_beam_on_one_hinge_turns() -> None:
    """Held at one end only it may turn about it, a rigid motion; its tension would hold it."""
    slack, taut = Beam(0.0), Beam()
    for beam in (slack, taut):
        beam.hinge(0, 0.0)
    system, called = slack.system(), [("the beam", slack.wire.nodes)]
    states = slack.system().unknowns.start, taut.system().unknowns.start
    with pytest.raises(SingularError, match=r"the beam at \(10.* moves along [yz]"):
        refuse_free_motion(system, states[:1], called)
    refuse_free_motion(system, states, called)


def test_a_point_that_is_held_twice_is_refused() -> None:
    beam = Beam()
    beam.hinge(0, 500.0)
    beam.hinge(5, -1e3)
    beam.hinge(0, 500.0)
    system = beam.system()
    hinges = [("a hinge", np.arange(beam.wire.nodes.size, system.size))]
    with pytest.raises(SingularError, match=r"the force of a hinge may have any size, because .* held twice"):
        find_rest(system, system.unknowns.start, names=hinges)


def test_a_parameter_that_moves_nothing_is_named() -> None:
    beam = Beam()
    beam.hinge(0, 1e3)
    beam.hinge(5, -1e3)
    idle = beam.builder.add(Kind.PARAMETER, [0.0])
    beam.parts.append(Targets(idle, Height(beam.wire.nodes[[2], 2]), np.array([-0.1])))
    system = beam.system()
    with pytest.raises(
        SingularError, match=r"nothing balances the crank; parameters that go with it: the crank"
    ):
        find_rest(system, system.unknowns.start, names=[("the crank", idle)])


def test_a_regular_system_that_does_not_converge_is_not_called_singular(line: Line) -> None:
    model = contact_wire(line)
    z = model.guess()
    z[model.hung.wire.nodes[40, 2]] += 0.5
    with pytest.raises(NotConvergedError, match="1 iterations"):
        find_rest(fitting(model.system, z), z, max_iterations=1)


def test_the_softest_motion_of_a_string_is_that_of_its_middle() -> None:
    """A force in the middle of a taut string moves it by L/(4 T), less what bending takes."""
    beam = Beam()
    beam.hinge(0, 1e3)
    beam.hinge(5, -1e3)
    system = beam.system()
    motion = softest_motion(system, system.unknowns.start)
    assert motion.moved in beam.wire.nodes[2:4, 1:3]
    assert 0.5 * 10.0 / 4e3 < motion.give < 10.0 / 4e3
