"""Where a wire will lie when it is tensioned, before anything is solved: for its mesh and the first guess."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.catenary.taut_wire import Points, TautWire
from catenaria.discretise.wire_setup import WireSetup

FloatArray = NDArray[np.float64]

_PASSES = 3  # of a fixed point that gains three digits in each


@dataclass(frozen=True)
class TensionedWire:
    """A taut wire with its material points, both ends pulled apart by the same way.

    Attributes
    ----------
    shape : TautWire
        Heights and slopes.
    start : float
        Where the wire begins along the track [m].
    factor : float
        Stretch under the horizontal tension.
    gain : float
        1 - H/EA: where a wire is inclined it is also tighter, which takes this much off the arc's excess.
    pull : float
        How far each end has been pulled from where the unstrained wire was laid out [m].
    """

    shape: TautWire
    start: float
    factor: float
    gain: float
    pull: float

    @classmethod
    def of(cls, setup: WireSetup) -> TensionedWire:
        """Return the wire of a setup under its droppers' forces or over the wanted heights."""
        force, EA, x = setup.tension.force, setup.section.EA, setup.support_x
        factor, gain = float(stretch(force, EA)), 1.0 - force / EA
        laid = np.array([x[0] - setup.tail, x[-1] + setup.tail])
        longer = 0.5 * (factor - 1.0) * (laid[1] - laid[0])
        shape = _shape(setup, laid + np.array([-longer, longer]))
        pull = longer - 0.5 * gain * float(shape.arc_excess(shape.x[-1:])[0])
        return cls(shape, laid[0] - pull, factor, gain, pull)

    def material(self, x: FloatArray) -> FloatArray:
        """Return the material coordinates of the points that lie at x [m]."""
        return (x - self.start + self.gain * self.shape.arc_excess(x)) / self.factor

    def place(self, s: FloatArray) -> FloatArray:
        """Return where material points lie along the track [m]."""
        level = self.start + self.factor * s
        x = level
        for _ in range(_PASSES):
            x = level - self.gain * self.shape.arc_excess(x)
        return x


def _shape(setup: WireSetup, ends: FloatArray) -> TautWire:
    """Return heights and slopes of a wire with the given ends."""
    H, w, EJ = setup.tension.force, setup.section.rhoA * setup.g, setup.section.EJ
    at = np.concatenate((ends[:1], setup.support_x, ends[1:]))
    supports = at, np.full_like(at, setup.height)
    droppers = setup.droppers
    if droppers.up:
        x = np.concatenate((supports[0], droppers.x))
        order = np.argsort(x, kind="stable")
        height = np.concatenate((supports[1], droppers.target))
        return TautWire.held((x[order], height[order]), H, w, EJ)
    light = TautWire.held(supports, H, w, EJ, (droppers.x, droppers.target))
    return TautWire.held(supports, H, w, EJ, _with_droppers(setup, light))


def _with_droppers(setup: WireSetup, shape: TautWire) -> Points:
    """Return the loads of the messenger: T_cd and the weight of droppers that end at that shape, eq. (23)."""
    droppers = setup.droppers
    length = shape.height(droppers.x) - droppers.foot_height
    weight = setup.g * (droppers.section.rhoA * length + droppers.clamps_mass)
    return droppers.x, droppers.target + weight
