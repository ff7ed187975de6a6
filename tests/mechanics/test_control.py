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
    control = Controls(p, measure, np.array([500.0]), VelocityLaw(0.02, 5.0, 100.0), Ramp(5.0))
    elements = CableElements.of([wire])
    gravity = Gravity(elements.weight(table.size), 9.8, Ramp(5.0))
    start = table.start.copy()
    start[wire.nodes[:, [0, 3]]] *= 1.02
    start[wire.nodes[:, 0]] -= 0.1
    return Loop(System(table, (elements, gravity, supports, ends, control)), int(p[0]), start)


def dropper_loop(lay_wire: Lay, up: bool) -> Loop:
    """Return one vertical cable: a lower one raised to a height of its foot, or an upper one pulled down to a force.

    The lower cable carries a soft weight, a second wire to the ground, so that its foot's height depends on p.
    """
    builder = UnknownsBuilder()
    section = Section(2e4, 1.0, 0.2)
    top, bottom = ([0, 0, 2], [0, 0, 0.5])
    cable = lay_wire(builder, bottom, top, np.linspace(0.0, 1.5, 3), section) if up else lay_wire(
        builder, top, bottom, np.linspace(0.0, 1.5, 3), section
    )
    anchor = lay_wire(builder, [0, 0, -1], [0, 0, 0.5], np.linspace(0.0, 1.5, 3), Section(2e2, 1.0, 0.2))
    la = builder.add(Kind.MULTIPLIER, np.zeros((3, 3)))
    p = builder.add(Kind.PARAMETER, np.array([0.01]))
    table = builder.build()
    one = np.array([-1])
    if up:
        joints = (
            HeldPoints(cable.nodes[-1:, :3], la[:1], np.array([top]), np.array([[0.0, 0.0, 1.0]]), p),
            HeldPoints(anchor.nodes[:1, :3], la[1:2], np.array([[0.0, 0.0, -1.0]]), np.zeros((1, 3)), one),
        )
        measure: Height | DropperForce = Height(cable.nodes[:1, 2])
        target, law = 0.52, VelocityLaw(0.02, 1e-4, 1e-2)
    else:
        joints = (
            HeldPoints(cable.nodes[:1, :3], la[:1], np.array([top]), np.zeros((1, 3)), one),
            HeldPoints(cable.nodes[-1:, :3], la[1:2], np.array([bottom]), np.array([[0.0, 0.0, -1.0]]), p),
            HeldPoints(anchor.nodes[:1, :3], la[2:], np.array([[0.0, 0.0, -1.0]]), np.zeros((1, 3)), one),
        )
        force = np.array([la[0, 2]])
        measure = DropperForce(force, cable.nodes[:1, 2], np.array([0.5]), 0.2, np.zeros(1), 9.8, Ramp(5.0))
        target, law = 80.0, VelocityLaw(1e-3, 0.1, 20.0)
    control = Controls(p, measure, np.array([target]), law, Ramp(5.0))
    return _dropper_system(builder, cable, anchor, joints, control, up)


def _dropper_system(
    builder: UnknownsBuilder,
    cable: Chain,
    anchor: Chain,
    joints: tuple[HeldPoints, ...],
    control: Controls,
    up: bool,
) -> Loop:
    raise NotImplementedError
