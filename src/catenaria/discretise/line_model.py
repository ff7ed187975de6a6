"""The whole line as one system: both wires, and droppers as bars between them.

Two uses: to find the form all at once (tensions and heights are targets, lengths and pulls unknown), and to
build what was found (lengths, clamps and pulls are given, tensions and heights follow).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.hung_wire import HungWire
from catenaria.discretise.wire_setup import WireSetup
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.measures import WireHeight
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.elements.dropper import Droppers
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, Unknowns, UnknownsBuilder

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class LineModel:
    """The line laid out, and where its unknowns are.

    Attributes
    ----------
    unknowns : Unknowns
        All unknowns, numbered along the line.
    contact, messenger : HungWire
        The two wires.
    length : IntArray, shape (n,)
        Unstressed lengths of the droppers.
    """

    unknowns: Unknowns
    contact: HungWire
    messenger: HungWire
    length: IntArray

    def droppers(self, z: FloatArray, clamped: bool, may_push: bool = False) -> Droppers:
        """Return the droppers, guided along the track, or clamped where z has them."""
        setup = self.contact.setup.droppers
        lower, upper = self.contact, self.messenger
        s = z[lower.clamp_s], z[upper.clamp_s]
        return Droppers(
            lower.wire,
            upper.wire,
            lower.clamp_s,
            upper.clamp_s,
            lower.wire.locate(s[0]),
            upper.wire.locate(s[1]),
            self.length,
            setup.x,
            setup.section.EA,
            setup.section.rhoA,
            setup.clamp_mass,
            self.messenger.setup.droppers.clamp_mass,
            self.contact.setup.g,
            s if clamped else None,
            may_push,
        )

    def to_find(self, z: FloatArray) -> System:
        """Return the system in which tensions and heights are targets, with joints that fit z."""
        lower = self.contact
        heights = WireHeight(lower.wire, lower.clamp_s, lower.wire.locate(z[lower.clamp_s]))
        targets: list[Contribution] = [Targets(self.length, heights, lower.setup.droppers.target)]
        for hung in (self.contact, self.messenger):
            targets.append(Targets.of(hung.tension_control(*hung.joints(self.unknowns.start))))
        return self._system(z, targets, self.droppers(z, False))

    def as_built(self, z: FloatArray, may_push: bool = False) -> System:
        """Return the system in which lengths, pulls and clamps are those of z: no targets, no guides."""
        given = np.concatenate((self.length, self.contact.pull, self.messenger.pull))
        return self._system(z, [Given(given, z[given])], self.droppers(z, True, may_push))

    def _system(self, z: FloatArray, targets: list[Contribution], droppers: Droppers) -> System:
        setup = self.contact.setup
        elements = CableElements.of([self.contact.wire, self.messenger.wire], setup.gauss_points)
        gravity = Gravity(elements.weight(z.size), setup.g, Ramp(0.0))
        start = self.unknowns.start
        joints = (*self.contact.joints(start), *self.messenger.joints(start))
        system = System(self.unknowns, (elements, gravity, *joints, droppers, *targets))
        return system.relocate(z) or system


def build_line_model(contact: WireSetup, messenger: WireSetup) -> LineModel:
    """Return both wires laid out straight, with droppers between them."""
    unknowns = UnknownsBuilder()
    lower, upper = HungWire.of(contact, unknowns), HungWire.of(messenger, unknowns)
    height = messenger.height - contact.height
    length = unknowns.add(Kind.PARAMETER, np.full(contact.droppers.x.size, height), contact.droppers.x)
    table, number = unknowns.build_along_line()
    return LineModel(table, lower.renumbered(number), upper.renumbered(number), number[length])
