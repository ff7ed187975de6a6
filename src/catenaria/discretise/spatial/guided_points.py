"""All points of wires that are taken along: guided across the track, or clamped in a line that is built."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.numbering import Numbering
from catenaria.mechanics.carrier import Strands

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class GuidedPoints:
    """Points of wires: what carries them, their sliding coordinates, origins and directions of the track."""

    carrier: Strands
    s: IntArray
    P: FloatArray
    along: FloatArray


def guided(numbers: Numbering, layout: Layout, *, built: bool) -> GuidedPoints:
    """Return the clamps of droppers, ties and masses, of brackets and arms, and of clamped messengers.

    Parameters
    ----------
    numbers : Numbering
        Where the unknowns are.
    layout : Layout
        What is modelled.
    built : bool
        Whether clamps at supports are closed; while a form is found, wires run through them as over rollers.
    """
    taken = layout.holds.guided
    if built:
        taken = taken | (np.array(layout.holds.kind, dtype=np.str_) == "clamped")
    frames = (layout.droppers.frame, layout.droppers.frame, layout.ties.frame, layout.masses.frame)
    wires = (layout.droppers.lower, layout.droppers.upper, layout.ties.host, layout.masses.wire)
    s = (numbers.lower_s, numbers.upper_s, numbers.tie_s, numbers.mass_s)
    held = layout.holds.frame.take(taken)
    return GuidedPoints(
        Strands.on(numbers.wires, np.concatenate((*wires, layout.holds.wire[taken]))),
        np.concatenate((*s, numbers.hold_s[taken])),
        np.concatenate([frame.origin for frame in (*frames, held)]),
        np.concatenate([frame.along for frame in (*frames, held)]),
    )
