"""Where a wire will lie when it is tensioned, before anything is solved: for its mesh and the first guess."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.catenary.taut_wire import Points, TautWire
from catenaria.discretise.wire_setup import WireSetup
from catenaria.errors import InfeasibleError

FloatArray = NDArray[np.float64]

_PASSES = 2  # of a fixed point that gains three digits in each


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
        EA, laid = setup.section.EA, setup.support_x[[0, -1]] + np.array([-setup.tail, setup.tail])
        length = laid[1] - laid[0]
        factor = float(stretch(setup.tension.force, EA))
        longer = 0.5 * length * (factor - 1.0)
        shape = _shape(setup, laid + np.array([-longer, longer]), setup.section.rhoA * setup.g / factor)
        factor, gain = float(stretch(shape.H, EA)), 1.0 - shape.H / EA
        pull = 0.5 * (length * (factor - 1.0) - gain * float(shape.arc_excess(shape.x[-1:])[0]))
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


def _shape(setup: WireSetup, ends: FloatArray, w: float) -> TautWire:
    """Return heights and slopes of a wire with weight w per stretched length; ends as if it were straight."""
    H, EJ, droppers = setup.tension.force, setup.section.EJ, setup.droppers
    if droppers.up:
        x = np.concatenate((ends[:1], setup.support_x, ends[1:], droppers.x))
        height = np.concatenate((np.full(setup.support_x.size + 2, setup.height), droppers.target))
        order = np.argsort(x, kind="stable")
        return TautWire.held((x[order], height[order]), H, w, EJ)
    light = TautWire.held(_held(setup, ends), H, w, 0.0, (droppers.x, droppers.target))
    shorter = 0.5 * light.arc_excess(ends[1:])
    held = _held(setup, ends + np.concatenate((shorter, -shorter)))
    return TautWire.held(held, _horizontal(setup, light), w, EJ, _with_droppers(setup, light))


def _held(setup: WireSetup, ends: FloatArray) -> Points:
    """Return places and heights of ends and supports."""
    x = np.concatenate((ends[:1], setup.support_x, ends[1:]))
    return x, np.full_like(x, setup.height)


def _horizontal(setup: WireSetup, shape: TautWire) -> float:
    """Return the mean horizontal tension of all spans [N].

    A frictionless support keeps the tension H sqrt(1 + z'^2) and thereby takes half of H (z'^2 behind it -
    z'^2 before it) from H.
    """
    before, behind = shape.kink_slopes(setup.support_x[:-1])
    left = 1.0 - float(np.mean(np.cumsum(0.5 * (behind**2 - before**2))))
    if left <= 0.0:
        raise InfeasibleError(
            f"is so slack under {shape.H:.4g} N that it would leave its end supports steeply; more tension, "
            "shorter spans or lighter droppers would help"
        )
    return shape.H * left


def _with_droppers(setup: WireSetup, shape: TautWire) -> Points:
    """Return the messenger's loads: T_cd and the weight of droppers up to that shape, eq. (23)."""
    droppers = setup.droppers
    length = shape.height(droppers.x) - droppers.foot_height
    weight = setup.g * (droppers.section.rhoA * length + droppers.clamps_mass)
    return droppers.x, droppers.target + weight
