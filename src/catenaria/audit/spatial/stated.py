"""What the line file of a line in space asked for, read anew from the echo of it that a result holds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.spatial.stated_droppers import StatedDroppers, read_droppers
from catenaria.audit.spatial.stated_joints import StatedMasses, StatedTies, read_masses, read_ties
from catenaria.audit.spatial.stated_wires import SpatialWire, read_wires
from catenaria.audit.spatial.stations import Stations
from catenaria.audit.stated import Inputs
from catenaria.audit.track import Track, read_track

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class StatedLine:
    """The line: gravity [m/s^2], track, wires in order of the result, and all that is clamped to them."""

    gravity: float
    track: Track
    wires: tuple[SpatialWire, ...]
    droppers: StatedDroppers
    ties: StatedTies
    masses: StatedMasses

    @property
    def largest_tension(self) -> float:
        """The largest prescribed tension [N]."""
        return max(wire.tension for wire in self.wires)


def read_line(inputs: Inputs) -> StatedLine:
    """Return what the line file asked for.

    Parameters
    ----------
    inputs : dict
        Echo of the line file in a result, all values in SI.
    """
    track = read_track(inputs)
    stations = Stations.of(inputs, track)
    return StatedLine(
        gravity=float(inputs["gravity"]),
        track=track,
        wires=read_wires(inputs, stations),
        droppers=read_droppers(inputs, stations),
        ties=read_ties(inputs, stations),
        masses=read_masses(inputs, stations),
    )
