"""One step of the paper's method as a system: a wire, its supports, dropper cables and controls.

The contact wire with the lower dropper cables (first step) and the messenger wire with the upper ones (second
step) are the same model with other numbers; `WireSetup` holds the numbers, `build_wire_model` makes the
system of section 3.1.3.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import graded_knots
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.discretise.wire_setup import DropperSetup, WireSetup
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.measures import DropperForce, Height, ReactionTension, StrainTension
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.guided import GuidedJoints
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.loads.linear import Inertia, RayleighDamping, assemble, point_masses
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_DIGITS = 3  # of where nodes stand: the mesh does not change with the last digits of a force
_ALONG, _UP = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class WireModel:
    """The system of one step and where to find things in it.

    Attributes
    ----------
    setup : WireSetup
        What was modelled.
    system : System
        At its starting configuration: straight, free of strain, at rest.
    wire, cables : Chain, tuple of Chain
        The wire, and the dropper cables from the wire outwards.
    elements, inertia : CableElements, Inertia
        Contributions that know the energies.
    end_force : IntArray, shape (2, 3)
        Multipliers: forces of the wire's start and end on the tensioning devices.
    support_s, support_force : IntArray, shape (m,), (m, 3)
        Sliding coordinates at the supports, and forces of the wire on them.
    clamp_s, clamp_force : IntArray, shape (n,), (n, 3)
        Sliding coordinates at the droppers, and forces of the wire on them (la of the joints).
    free_force : IntArray, shape (n, 3)
        Forces of the dropper cables' far ends on what moves them.
    pull, dropper_travel : IntArray, shape (1,), (n,)
        Control parameters of the tension control and of the dropper controls.
    """

    setup: WireSetup
    system: System
    wire: Chain
    cables: tuple[Chain, ...]
    elements: CableElements
    inertia: Inertia
    end_force: IntArray
    support_s: IntArray
    support_force: IntArray
    clamp_s: IntArray
    clamp_force: IntArray
    free_force: IntArray
    pull: IntArray
    dropper_travel: IntArray

    @property
    def multipliers(self) -> IntArray:
        """Indices of all multipliers: supports, clamps, free dropper ends, wire ends."""
        batches = (self.support_force, self.clamp_force, self.free_force, self.end_force)
        return np.concatenate([batch.ravel() for batch in batches])

    def controls(self, system: System) -> tuple[Controls, Controls]:
        """Return the tension control and the dropper controls with the discrete state of the given system."""
        tension, droppers = (part for part in system.contributions if isinstance(part, Controls))
        return tension, droppers


@dataclass(frozen=True)
class _Numbers:
    """Indices of the unknowns of joints and controls, named as in `WireModel`."""

    support_s: IntArray
    support_force: IntArray
    clamp_s: IntArray
    clamp_force: IntArray
    free_force: IntArray
    end_force: IntArray
    pull: IntArray
    dropper_travel: IntArray

    @classmethod
    def of(cls, setup: WireSetup, unknowns: UnknownsBuilder) -> _Numbers:
        """Number them."""
        held, hung = setup.support_x, setup.droppers.x
        start_x = held[0] - setup.tail
        ends = held[[0, -1]] + [-setup.tail, setup.tail]
        return cls(
            support_s=unknowns.add(Kind.SLIDING, held - start_x, held),
            support_force=unknowns.add(Kind.MULTIPLIER, np.zeros((held.size, 3)), held),
            clamp_s=unknowns.add(Kind.SLIDING, hung - start_x, hung),
            clamp_force=unknowns.add(Kind.MULTIPLIER, np.zeros((hung.size, 3)), hung),
            free_force=unknowns.add(Kind.MULTIPLIER, np.zeros((hung.size, 3)), hung),
            end_force=unknowns.add(Kind.MULTIPLIER, np.zeros((2, 3)), ends),
            pull=unknowns.add(Kind.PARAMETER, np.zeros(1), ends[1]),
            dropper_travel=unknowns.add(Kind.PARAMETER, np.zeros(hung.size), hung),
        )

    def renumbered(self, number: IntArray) -> _Numbers:
        """Return the same with final numbers."""
        return _Numbers(*(number[getattr(self, item.name)] for item in fields(self)))


def build_wire_model(setup: WireSetup) -> WireModel:
    """Return the starting configuration of Fig. 5(b) with all joints, loads and controls."""
    unknowns = UnknownsBuilder()
    wire = straight_wire(setup, unknowns)
    cables = _dropper_cables(setup.droppers, setup.height, unknowns)
    at = _Numbers.of(setup, unknowns)
    table, number = unknowns.build_along_line()
    wire, cables = wire.renumbered(number), tuple(cable.renumbered(number) for cable in cables)
    at = at.renumbered(number)
    elements = CableElements.of([wire, *cables], setup.gauss_points)
    inner = np.array([cable.nodes[0, :3] for cable in cables])
    inertia, damping, gravity = _loads(setup, elements, inner, table.start)
    supports, held_ends, held_droppers, clamps = _joints(setup, wire, cables, at, table.start)
    tension = tension_control(setup, supports, held_ends, at.pull)
    droppers = _dropper_controls(setup, at, inner)
    joints = (supports, held_ends, held_droppers, clamps)
    return WireModel(
        setup=setup,
        system=System(table, (elements, inertia, *damping, gravity, *joints, tension, droppers)),
        wire=wire,
        cables=cables,
        elements=elements,
        inertia=inertia,
        end_force=at.end_force,
        support_s=at.support_s,
        support_force=at.support_force,
        clamp_s=at.clamp_s,
        clamp_force=at.clamp_force,
        free_force=at.free_force,
        pull=at.pull,
        dropper_travel=at.dropper_travel,
    )


def straight_wire(setup: WireSetup, unknowns: UnknownsBuilder) -> Chain:
    """Return the wire as laid out: straight, level, without strain, a tail beyond each end support."""
    first, last = setup.support_x[0], setup.support_x[-1]
    length = last - first + 2.0 * setup.tail
    will_be_held = np.concatenate((setup.support_x, setup.droppers.x))
    centres = np.round(TensionedWire.of(setup).material(will_be_held), _DIGITS)
    knots = graded_knots(length, centres, setup.grading)
    position = np.column_stack(
        (first - setup.tail + knots, np.zeros_like(knots), np.full_like(knots, setup.height))
    )
    nodes = unknowns.add_nodes(position, np.tile(_ALONG, (knots.size, 1)))
    return Chain(nodes, knots, setup.section)


def _dropper_cables(setup: DropperSetup, height: float, unknowns: UnknownsBuilder) -> tuple[Chain, ...]:
    """Return one straight vertical cable for each dropper, from the wire up or down."""
    knots = np.linspace(0.0, setup.length, setup.elements + 1)
    slope = np.tile(_UP if setup.up else -_UP, (knots.size, 1))
    along = knots[:, None] * slope
    return tuple(
        Chain(unknowns.add_nodes(np.array([x, 0.0, height]) + along, slope), knots, setup.section)
        for x in setup.x
    )


def hold_wire(
    setup: WireSetup,
    wire: Chain,
    z: FloatArray,
    support: tuple[IntArray, IntArray],
    end: tuple[IntArray, IntArray],
) -> tuple[SlidingJoints, HeldPoints]:
    """Return the supports of a wire and its driven ends.

    Parameters
    ----------
    setup, wire, z
        The wire and its starting values.
    support : tuple of IntArray, shape (m,), (m, 3)
        Sliding coordinates and multipliers of the supports.
    end : tuple of IntArray, shape (1,), (2, 3)
        The parameter that pulls both ends apart, and their multipliers.
    """
    level = np.zeros_like(setup.support_x)
    X = np.column_stack((setup.support_x, level, level + setup.height))
    supports = SlidingJoints(wire, *support, wire.locate(z[support[0]]), X)
    nodes, (pull, force) = wire.nodes[[0, -1], :3], end
    return supports, HeldPoints(nodes, force, z[nodes], np.outer([-1.0, 1.0], _ALONG), np.repeat(pull, 2))


def _joints(
    setup: WireSetup, wire: Chain, cables: tuple[Chain, ...], at: _Numbers, z: FloatArray
) -> tuple[SlidingJoints, HeldPoints, HeldPoints, SlidingJoints | GuidedJoints]:
    """Return supports, driven wire ends, driven dropper ends, and the clamps between wire and droppers."""
    droppers = setup.droppers
    support, end = (at.support_s, at.support_force), (at.pull, at.end_force)
    supports, held_ends = hold_wire(setup, wire, z, support, end)
    outer = np.array([cable.nodes[-1, :3] for cable in cables])
    moved = np.tile(_UP if droppers.up else -_UP, (len(cables), 1))
    held_droppers = HeldPoints(outer, at.free_force, z[outer], moved, at.dropper_travel)

    inner = np.array([cable.nodes[0, :3] for cable in cables])
    element = wire.locate(z[at.clamp_s])
    if droppers.guided:
        clamps = GuidedJoints(wire, at.clamp_s, at.clamp_force, element, droppers.x, inner)
    else:
        clamps = SlidingJoints(wire, at.clamp_s, at.clamp_force, element, np.zeros_like(z[inner]), inner)
    return supports, held_ends, held_droppers, clamps


def _loads(
    setup: WireSetup, elements: CableElements, clamps: IntArray, z: FloatArray
) -> tuple[Inertia, tuple[RayleighDamping, ...], Gravity]:
    masses = np.full(clamps.shape[0], setup.droppers.clamp_mass)
    point_mass, point_weight = point_masses(clamps, masses, z.size)
    M = assemble(elements, elements.mass(), z.size) + point_mass
    alpha, beta = setup.damping
    damping = ()
    if alpha or beta:
        damping = (RayleighDamping(alpha * M + beta * assemble(elements, elements.stiffness(z), z.size)),)
    return Inertia(M), damping, Gravity(elements.weight(z.size) + point_weight, setup.g, setup.gravity_ramp)


def tension_control(setup: WireSetup, supports: SlidingJoints, ends: HeldPoints, pull: IntArray) -> Controls:
    """Return the control (19)-(20) of a wire: one velocity moves both ends apart, one end is measured."""
    end = slice(-1, None) if setup.tension.at_end else slice(0, 1)
    if setup.tension.measure == "strain":
        measure = StrainTension(supports.wire, supports.s[end], supports.element[end])
    else:
        measure = ReactionTension(ends.multipliers[end], ends.direction[end])
    target = np.array([setup.tension.force])
    return Controls(pull, measure, target, setup.tension.law, setup.control_ramp, Ramp(0.0))


def _dropper_controls(setup: WireSetup, at: _Numbers, inner: IntArray) -> Controls:
    """Return the height controls (21)-(22) of lower cables, or the force controls (23) of upper ones.

    The forces grow with gravity, so that no upper cable has to push its end of the messenger up while that
    falls: a cable that pushes buckles.
    """
    droppers, travel = setup.droppers, at.dropper_travel
    if droppers.up:
        measure = Height(inner[:, 2])
        return Controls(travel, measure, droppers.target, droppers.law, setup.control_ramp, Ramp(0.0))
    measure = DropperForce(
        at.clamp_force[:, 2],
        inner[:, 2],
        droppers.foot_height,
        droppers.section.rhoA,
        np.full(droppers.x.size, droppers.clamps_mass),
        setup.g,
        setup.gravity_ramp,
    )
    return Controls(travel, measure, droppers.target, droppers.law, Ramp(0.0), setup.gravity_ramp)
