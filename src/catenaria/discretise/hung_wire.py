"""A wire in a system: laid out straight, held by supports and by driven ends, with places for its droppers.

What hangs at the droppers' places is added by the models that contain the wire: cables of a guessed length
(`wire_model`), bars to the other wire (`line_model`) or nothing but a force (`wire_alone`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import graded_knots
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.discretise.wire_setup import WireSetup
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.measures import ReactionTension, StrainTension
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.sliding import SlidingJoints
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_DIGITS = 3  # of where nodes stand [m]: the mesh does not change with the last digits of a force
_ALONG = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True)
class HungWire:
    """A wire and where its unknowns are.

    Attributes
    ----------
    setup : WireSetup
        What was modelled.
    tensioned : TensionedWire
        Where it will lie.
    wire : Chain
        The wire.
    support_s, support_force : IntArray, shape (m,), (m, 3)
        Sliding coordinates at the supports, and forces of the wire on them.
    end_force : IntArray, shape (2, 3)
        Multipliers: forces of the wire's start and end on the tensioning devices.
    clamp_s : IntArray, shape (n,)
        Sliding coordinates at the droppers.
    pull : IntArray, shape (1,)
        Control parameter of the tension: how far both ends are pulled outwards.
    """

    setup: WireSetup
    tensioned: TensionedWire
    wire: Chain
    support_s: IntArray
    support_force: IntArray
    end_force: IntArray
    clamp_s: IntArray
    pull: IntArray

    @classmethod
    def of(cls, setup: WireSetup, unknowns: UnknownsBuilder) -> HungWire:
        """Lay the wire out straight, level and without strain, with a tail beyond each end support."""
        held, hung = setup.support_x, setup.droppers.x
        ends = held[[0, -1]] + [-setup.tail, setup.tail]
        tensioned = TensionedWire.of(setup)
        return cls(
            setup,
            tensioned,
            _straight_wire(setup, tensioned, unknowns),
            unknowns.add(Kind.SLIDING, held - ends[0], held),
            unknowns.add(Kind.MULTIPLIER, np.zeros((held.size, 3)), held),
            unknowns.add(Kind.MULTIPLIER, np.zeros((2, 3)), ends),
            unknowns.add(Kind.SLIDING, hung - ends[0], hung),
            unknowns.add(Kind.PARAMETER, np.zeros(1), ends[1]),
        )

    def renumbered(self, number: IntArray) -> HungWire:
        """Return the same with final numbers."""
        batches = (self.support_s, self.support_force, self.end_force, self.clamp_s, self.pull)
        return HungWire(
            self.setup,
            self.tensioned,
            self.wire.renumbered(number),
            *(number[batch] for batch in batches),
        )

    def joints(self, start: FloatArray) -> tuple[SlidingJoints, HeldPoints]:
        """Return supports and driven ends; pulls count from the starting values."""
        setup, level = self.setup, np.zeros_like(self.setup.support_x)
        X = np.column_stack((setup.support_x, level, level + setup.height))
        element = self.wire.locate(start[self.support_s])
        nodes = self.wire.nodes[[0, -1], :3]
        outwards, pull = np.outer([-1.0, 1.0], _ALONG), np.repeat(self.pull, 2)
        return (
            SlidingJoints(self.wire, self.support_s, self.support_force, element, X),
            HeldPoints(nodes, self.end_force, start[nodes], outwards, pull),
        )

    def tension_control(self, supports: SlidingJoints, ends: HeldPoints) -> Controls:
        """Return the control (19)-(20): one velocity moves both ends apart, one end is measured."""
        tension = self.setup.tension
        end = slice(-1, None) if tension.at_end else slice(0, 1)
        if tension.measure == "strain":
            measure = StrainTension(supports.wire, supports.s[end], supports.element[end])
        else:
            measure = ReactionTension(ends.multipliers[end], ends.direction[end])
        target, ramp = np.array([tension.force]), self.setup.control_ramp
        return Controls(self.pull, measure, target, tension.law, ramp, Ramp(0.0))


def copy_wire(target: HungWire, source: HungWire, z_source: FloatArray, z_target: FloatArray) -> None:
    """Write the state of a wire in one system into the unknowns of another system with the same mesh."""
    for name in ("support_s", "support_force", "end_force", "clamp_s", "pull"):
        z_target[getattr(target, name)] = z_source[getattr(source, name)]
    z_target[target.wire.nodes] = z_source[source.wire.nodes]


def _straight_wire(setup: WireSetup, tensioned: TensionedWire, unknowns: UnknownsBuilder) -> Chain:
    first, last = setup.support_x[0], setup.support_x[-1]
    centres = tensioned.material(np.concatenate((setup.support_x, setup.droppers.x)))
    knots = graded_knots(last - first + 2.0 * setup.tail, np.round(centres, _DIGITS), setup.grading)
    position = np.column_stack(
        (first - setup.tail + knots, np.zeros_like(knots), np.full_like(knots, setup.height))
    )
    nodes = unknowns.add_nodes(position, np.tile(_ALONG, (knots.size, 1)))
    return Chain(nodes, knots, setup.section)
