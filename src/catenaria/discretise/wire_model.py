"""One step of the paper's method as a system: a wire, its supports, dropper cables and controls.

The contact wire with the lower dropper cables (first step) and the messenger wire with the upper ones (second
step) are the same model with other numbers; `WireSetup` holds the numbers, `build_wire_model` makes the
system of section 3.1.3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.hung_wire import HungWire
from catenaria.discretise.wire_setup import DropperSetup, WireSetup
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.measures import DropperForce, Height
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

_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class DropperCables:
    """The dropper cables of one step and where their unknowns are.

    Attributes
    ----------
    chains : tuple of Chain
        The cables from the wire outwards.
    clamp_force : IntArray, shape (n, 3)
        Forces of the wire on them (la of the joints).
    free_force : IntArray, shape (n, 3)
        Forces of their far ends on what moves these.
    travel : IntArray, shape (n,)
        Control parameters: how far the far ends have been moved.
    """

    chains: tuple[Chain, ...]
    clamp_force: IntArray
    free_force: IntArray
    travel: IntArray

    @classmethod
    def of(cls, setup: DropperSetup, height: float, unknowns: UnknownsBuilder) -> DropperCables:
        """Lay out one straight vertical cable for each dropper, from the wire up or down."""
        knots, x = np.linspace(0.0, setup.length, setup.elements + 1), setup.x
        slope = np.tile(_UP if setup.up else -_UP, (knots.size, 1))
        along = knots[:, None] * slope
        return cls(
            tuple(
                Chain(unknowns.add_nodes(np.array([at, 0.0, height]) + along, slope), knots, setup.section)
                for at in x
            ),
            unknowns.add(Kind.MULTIPLIER, np.zeros((x.size, 3)), x),
            unknowns.add(Kind.MULTIPLIER, np.zeros((x.size, 3)), x),
            unknowns.add(Kind.PARAMETER, np.zeros(x.size), x),
        )

    def renumbered(self, number: IntArray) -> DropperCables:
        """Return the same with final numbers."""
        batches = (self.clamp_force, self.free_force, self.travel)
        chains = tuple(chain.renumbered(number) for chain in self.chains)
        return DropperCables(chains, *(number[batch] for batch in batches))

    @property
    def inner(self) -> IntArray:
        """Indices of the positions of the ends at the wire, shape (n, 3)."""
        return np.array([chain.nodes[0, :3] for chain in self.chains])

    @property
    def outer(self) -> IntArray:
        """Indices of the positions of the far ends, shape (n, 3)."""
        return np.array([chain.nodes[-1, :3] for chain in self.chains])


@dataclass(frozen=True)
class WireModel(HungWire):
    """The system of one step and where to find things in it; see also `HungWire`.

    Attributes
    ----------
    system : System
        At its starting configuration: straight, free of strain, at rest.
    droppers : DropperCables
        The dropper cables.
    elements, inertia : CableElements, Inertia
        Contributions that know the energies.
    """

    system: System
    droppers: DropperCables
    elements: CableElements
    inertia: Inertia

    @property
    def name(self) -> str:
        """Name of the wire."""
        return self.setup.name

    @property
    def ramp_time(self) -> float:
        """Until when gravity and control velocities grow [s]."""
        return max(self.setup.gravity_ramp.duration, self.setup.control_ramp.duration)

    @property
    def multipliers(self) -> IntArray:
        """Indices of all multipliers: supports, clamps, free dropper ends, wire ends."""
        droppers = self.droppers
        batches = (self.support_force, droppers.clamp_force, droppers.free_force, self.end_force)
        return np.concatenate([batch.ravel() for batch in batches])

    def controls(self, system: System) -> tuple[Controls, Controls]:
        """Return the tension control and the dropper controls with the discrete state of the given system."""
        tension, droppers = (part for part in system.contributions if isinstance(part, Controls))
        return tension, droppers


def build_wire_model(setup: WireSetup) -> WireModel:
    """Return the starting configuration of Fig. 5(b) with all joints, loads and controls."""
    unknowns = UnknownsBuilder()
    hung = HungWire.of(setup, unknowns)
    droppers = DropperCables.of(setup.droppers, setup.height, unknowns)
    table, number = unknowns.build_along_line()
    hung, droppers, start = hung.renumbered(number), droppers.renumbered(number), table.start
    elements = CableElements.of([hung.wire, *droppers.chains], setup.gauss_points)
    inertia, damping, gravity = _loads(setup, elements, droppers.inner, start)
    supports, held_ends = hung.joints(start)
    joints = (supports, held_ends, *_dropper_joints(hung, droppers, start))
    tension = hung.tension_control(supports, held_ends)
    controls = (tension, _dropper_controls(setup, droppers))
    return WireModel(
        hung.setup,
        hung.tensioned,
        hung.wire,
        hung.support_s,
        hung.support_force,
        hung.end_force,
        hung.clamp_s,
        hung.pull,
        System(table, (elements, inertia, *damping, gravity, *joints, *controls)),
        droppers,
        elements,
        inertia,
    )


def _dropper_joints(
    hung: HungWire, droppers: DropperCables, z: FloatArray
) -> tuple[HeldPoints, SlidingJoints | GuidedJoints]:
    """Return the driven far ends of the cables, and the clamps between wire and cables."""
    setup, inner, outer = hung.setup.droppers, droppers.inner, droppers.outer
    moved = np.tile(_UP if setup.up else -_UP, (setup.x.size, 1))
    far_ends = HeldPoints(outer, droppers.free_force, z[outer], moved, droppers.travel)
    element = hung.wire.locate(z[hung.clamp_s])
    s, force = hung.clamp_s, droppers.clamp_force
    if setup.guided:
        return far_ends, GuidedJoints(hung.wire, s, force, element, setup.x, inner)
    return far_ends, SlidingJoints(hung.wire, s, force, element, np.zeros_like(z[inner]), inner)


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


def _dropper_controls(setup: WireSetup, cables: DropperCables) -> Controls:
    """Return the height controls (21)-(22) of lower cables, or the force controls (23) of upper ones.

    The forces grow with gravity, so that no upper cable has to push its end of the messenger up while that
    falls: a cable that pushes buckles.
    """
    droppers, inner, travel = setup.droppers, cables.inner, cables.travel
    if droppers.up:
        measure = Height(inner[:, 2])
        return Controls(travel, measure, droppers.target, droppers.law, setup.control_ramp, Ramp(0.0))
    measure = DropperForce(
        cables.clamp_force[:, 2],
        inner,
        np.column_stack((droppers.foot_x, np.zeros_like(droppers.foot_x), droppers.foot_height)),
        droppers.section.rhoA,
        np.full(droppers.x.size, droppers.clamps_mass),
        setup.g,
        setup.gravity_ramp,
    )
    return Controls(travel, measure, droppers.target, droppers.law, Ramp(0.0), setup.gravity_ramp)
