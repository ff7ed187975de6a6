"""One wire at rest with all targets met, and droppers that are nothing but vertical forces.

The same equilibrium as that of `wire_model` with guided droppers, without the dropper cables: in the plane
their length, which is a guess, does not matter.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.guess import dropper_forces, guess_wire
from catenaria.discretise.hung_wire import HungWire
from catenaria.discretise.wire_setup import WireSetup
from catenaria.mechanics.controls.measures import HungForce, WireHeight
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.joints.hung_point import HungPoints
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class WireAlone:
    """The wire, its system and where the droppers' forces are.

    Attributes
    ----------
    hung : HungWire
        The wire.
    clamp_force : IntArray, shape (n,)
        Vertical forces of the wire on droppers and clamps [N].
    system : System
        Tension and heights (contact wire) or dropper forces (messenger) are targets.
    dropper_targets : Targets
        Those of the droppers.
    """

    hung: HungWire
    clamp_force: IntArray
    system: System
    dropper_targets: Targets

    def dropper_error(self, z: FloatArray) -> FloatArray:
        """Return by how much heights [m] or forces [N] miss their targets, shape (n,)."""
        targets = self.dropper_targets.relocate(z) or self.dropper_targets
        return targets.measure.value(0.0, z) - targets.target

    def guess(self) -> FloatArray:
        """Return unknowns near the equilibrium, shape (n,)."""
        z = self.system.unknowns.start.copy()
        guess_wire(self.hung, z)
        upwards = 1.0 if self.hung.setup.droppers.up else -1.0
        z[self.clamp_force] = -upwards * dropper_forces(self.hung)
        return z


def build_wire_alone(setup: WireSetup) -> WireAlone:
    """Return the wire laid out straight, with full weight."""
    unknowns = UnknownsBuilder()
    hung, x = HungWire.of(setup, unknowns), setup.droppers.x
    force = unknowns.add(Kind.MULTIPLIER, np.zeros(x.size), x)
    table, number = unknowns.build_along_line()
    hung, force = hung.renumbered(number), number[force]
    elements = CableElements.of([hung.wire], setup.gauss_points)
    gravity = Gravity(elements.weight(table.size), setup.g, Ramp(0.0))
    supports, ends = hung.joints(table.start)
    points = HungPoints(hung.wire, hung.clamp_s, force, hung.wire.locate(table.start[hung.clamp_s]), x)
    tension = Targets.of(hung.tension_control(supports, ends))
    targets = _dropper_targets(setup, points)
    parts = (elements, gravity, supports, ends, points, tension, targets)
    return WireAlone(hung, force, System(table, parts), targets)


def _dropper_targets(setup: WireSetup, points: HungPoints) -> Targets:
    droppers = setup.droppers
    height = WireHeight(points.wire, points.s, points.element)
    if droppers.up:
        return Targets(points.force, height, droppers.target)
    clamps = np.full(droppers.x.size, droppers.clamps_mass)
    measure = HungForce(points.force, height, droppers.foot_height, droppers.section.rhoA, clamps, setup.g)
    return Targets(points.force, measure, droppers.target)
