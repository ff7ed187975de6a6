"""One step of the paper's method as a system: a wire, its supports, dropper cables and controls.

The contact wire with the lower dropper cables (first step) and the messenger wire with the upper ones (second
step) are the same model with other numbers; `WireSetup` holds the numbers, `build_wire_model` makes the
system of section 3.1.3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import Grading, graded_knots, material_coordinate
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.control import Controls, Measure
from catenaria.mechanics.controls.measures import DropperForce, Height, ReactionTension, StrainTension
from catenaria.mechanics.controls.velocity_law import VelocityLaw
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


@dataclass(frozen=True)
class TensionSetup:
    """Tension control of a wire, eqs. (19)-(20): `force` [N], how and where it is measured, the law."""

    force: float
    measure: str
    at_end: bool
    law: VelocityLaw


@dataclass(frozen=True)
class DropperSetup:
    """The dropper cables of one step and what controls them.

    Attributes
    ----------
    x : FloatArray, shape (n,)
        Positions along the track [m].
    up : bool
        True for the lower cables, which stand up from the contact wire and are raised; False for the upper
        ones, which hang from the messenger and are pulled down.
    length, elements, section
        Guessed length [m], number of elements and cross-section of each cable.
    clamp_mass : float
        Mass at the wire's end [kg].
    guided : bool
        Guided joint with the wire; False for the frictionless joint (15).
    target : FloatArray, shape (n,)
        Wanted heights [m] for the lower cables, forces T_cd [N] for the upper ones.
    law : VelocityLaw
        Law (21), or the similar one for (23).
    foot_height : FloatArray, shape (n,)
        Heights of P_cd [m]; used by the upper cables for the weight G of (23).
    clamp_weight : float
        Mass of both clamps [kg]; used by the upper cables for G.
    """

    x: FloatArray
    up: bool
    length: float
    elements: int
    section: Section
    clamp_mass: float
    guided: bool
    target: FloatArray
    law: VelocityLaw
    foot_height: FloatArray
    clamp_weight: float


@dataclass(frozen=True)
class WireSetup:
    """Everything that one step needs, in SI units.

    Attributes
    ----------
    name : str
        Name of the wire.
    section : Section
        Cross-section of the wire.
    support_x : FloatArray, shape (m,)
        Where the wire is held, ascending [m].
    height : float
        Height of its supports [m].
    tail : float
        How far the wire runs on beyond its first and last support [m].
    tension, droppers
        The controls.
    grading, gauss_points
        The mesh.
    g, gravity_ramp : float, Ramp
        Gravity [m/s^2] and its ramp (31).
    control_ramp : Ramp
        Brings the control velocities in.
    damping : tuple of float
        Rayleigh's alpha [1/s] and beta [s].
    """

    name: str
    section: Section
    support_x: FloatArray
    height: float
    tail: float
    tension: TensionSetup
    droppers: DropperSetup
    grading: Grading
    gauss_points: int
    g: float
    gravity_ramp: Ramp
    control_ramp: Ramp
    damping: tuple[float, float]


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
    pull: IntArray
    dropper_travel: IntArray

    @property
    def multipliers(self) -> IntArray:
        """Indices of all multipliers: supports, clamps, free dropper ends, wire ends."""
        return np.flatnonzero(self.system.unknowns.where(Kind.MULTIPLIER))

    def controls(self, system: System) -> tuple[Controls, Controls]:
        """Return the tension control and the dropper controls with the discrete state of the given system."""
        tension, droppers = (part for part in system.contributions if isinstance(part, Controls))
        return tension, droppers


def build_wire_model(setup: WireSetup) -> WireModel:
    """Return the starting configuration of Fig. 5(b) with all joints, loads and controls."""
    unknowns = UnknownsBuilder()
    wire = _straight_wire(setup, unknowns)
    cables = _dropper_cables(setup.droppers, setup.height, unknowns)
    n, m = setup.droppers.x.size, setup.support_x.size
    start_x = setup.support_x[0] - setup.tail

    support_s = unknowns.add(Kind.SLIDING, setup.support_x - start_x)
    support_force = unknowns.add(Kind.MULTIPLIER, np.zeros((m, 3)))
    clamp_s = unknowns.add(Kind.SLIDING, setup.droppers.x - start_x)
    clamp_force = unknowns.add(Kind.MULTIPLIER, np.zeros((n, 3)))
    free_force = unknowns.add(Kind.MULTIPLIER, np.zeros((n, 3)))
    end_force = unknowns.add(Kind.MULTIPLIER, np.zeros((2, 3)))
    pull = unknowns.add(Kind.PARAMETER, np.zeros(1))
    travel = unknowns.add(Kind.PARAMETER, np.zeros(n))
    table = unknowns.build()
    z = table.start

    inner = np.array([cable.nodes[0, :3] for cable in cables]).reshape(n, 3)
    outer = np.array([cable.nodes[-1, :3] for cable in cables]).reshape(n, 3)
    ends = wire.nodes[[0, -1], :3]
    outwards = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    travel_direction = np.tile([0.0, 0.0, 1.0 if setup.droppers.up else -1.0], (n, 1))

    support_x = np.column_stack((setup.support_x, np.zeros(m), np.full(m, setup.height)))
    supports = SlidingJoints(wire, support_s, support_force, wire.locate(z[support_s]), support_x)
    held_ends = HeldPoints(ends, end_force, z[ends], outwards, np.repeat(pull, 2))
    held_droppers = HeldPoints(outer, free_force, z[outer], travel_direction, travel)
    clamps = _clamps(setup.droppers, wire, clamp_s, clamp_force, inner, wire.locate(z[clamp_s]))
    elements = CableElements.of([wire, *cables], setup.gauss_points)
    inertia, damping, gravity = _loads(setup, elements, inner, z)

    tension = Controls(
        pull,
        _tension_measure(setup, supports, end_force, outwards),
        np.array([setup.tension.force]),
        setup.tension.law,
        setup.control_ramp,
        Ramp(0.0),
    )
    heights = _dropper_controls(setup, travel, clamp_force, inner)
    parts = (
        elements,
        inertia,
        *damping,
        gravity,
        supports,
        held_ends,
        held_droppers,
        clamps,
        tension,
        heights,
    )
    return WireModel(
        setup,
        System(table, parts),
        wire,
        cables,
        elements,
        inertia,
        end_force,
        support_s,
        support_force,
        clamp_s,
        clamp_force,
        pull,
        travel,
    )


def _straight_wire(setup: WireSetup, unknowns: UnknownsBuilder) -> Chain:
    """Return the wire as laid out: straight, level, without strain, a tail beyond each end support."""
    first, last = setup.support_x[0], setup.support_x[-1]
    length = last - first + 2.0 * setup.tail
    will_be_held = np.concatenate((setup.support_x, setup.droppers.x))
    strain = setup.tension.force / setup.section.EA
    centres = material_coordinate(will_be_held, 0.5 * (first + last), length, strain)
    knots = graded_knots(length, centres, setup.grading)
    along = np.array([1.0, 0.0, 0.0])
    position = np.column_stack(
        (first - setup.tail + knots, np.zeros_like(knots), np.full_like(knots, setup.height))
    )
    nodes = np.array([unknowns.add_node(r, along) for r in position])
    return Chain(nodes, knots, setup.section)


def _dropper_cables(setup: DropperSetup, height: float, unknowns: UnknownsBuilder) -> tuple[Chain, ...]:
    """Return one straight vertical cable for each dropper, from the wire up or down."""
    knots = np.linspace(0.0, setup.length, setup.elements + 1)
    along = np.array([0.0, 0.0, 1.0 if setup.up else -1.0])
    return tuple(
        Chain(
            np.array([unknowns.add_node(np.array([x, 0.0, height]) + s * along, along) for s in knots]),
            knots,
            setup.section,
        )
        for x in setup.x
    )


def _clamps(
    setup: DropperSetup, wire: Chain, s: IntArray, force: IntArray, inner: IntArray, element: IntArray
) -> GuidedJoints | SlidingJoints:
    if setup.guided:
        return GuidedJoints(wire, s, force, element, setup.x, inner)
    return SlidingJoints(wire, s, force, element, np.zeros((setup.x.size, 3)), inner)


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


def _tension_measure(
    setup: WireSetup, supports: SlidingJoints, end_force: IntArray, outwards: FloatArray
) -> Measure:
    end = slice(-1, None) if setup.tension.at_end else slice(0, 1)
    if setup.tension.measure == "strain":
        return StrainTension(supports.wire, supports.s[end], supports.element[end])
    return ReactionTension(end_force[end], outwards[end])


def _dropper_controls(setup: WireSetup, travel: IntArray, clamp_force: IntArray, inner: IntArray) -> Controls:
    """Return the height controls (21)-(22) of lower cables, or the force controls (23) of upper ones.

    The forces grow with gravity, so that no upper cable has to push its end of the messenger up while that
    falls: a cable that pushes buckles.
    """
    droppers = setup.droppers
    if droppers.up:
        measure = Height(inner[:, 2])
        return Controls(travel, measure, droppers.target, droppers.law, setup.control_ramp, Ramp(0.0))
    measure = DropperForce(
        clamp_force[:, 2],
        inner[:, 2],
        droppers.foot_height,
        droppers.section.rhoA,
        np.full(droppers.x.size, droppers.clamp_weight),
        setup.g,
        setup.gravity_ramp,
    )
    return Controls(travel, measure, droppers.target, droppers.law, Ramp(0.0), setup.gravity_ramp)
