"""Where the wires of a line in space are along its track: all their points are located at once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.read_back import profile, samples
from catenaria.discretise.spatial.natural import Natural
from catenaria.line.alignment import Alignment, Frames
from catenaria.results.form import Profile

FloatArray = NDArray[np.float64]


def track_profiles(state: Natural, alignment: Alignment) -> list[Profile]:
    """Return the profiles of all wires, with chainages, lateral offsets and heights by the track."""
    frames, _ = located(state, alignment, [samples(wire) for wire in state.wires])
    return [profile(wire, state.z, planes) for wire, planes in zip(state.wires, frames, strict=True)]


def located(
    state: Natural, alignment: Alignment, s: Sequence[FloatArray]
) -> tuple[list[Frames], list[FloatArray]]:
    """Return the track frames at which points of the wires are, and their positions.

    Parameters
    ----------
    state : Natural
        The state of the line.
    alignment : Alignment
        The track axis.
    s : sequence of FloatArray
        Material coordinates of the points on each wire [m].

    Returns
    -------
    list of Frames, list of FloatArray
        For each wire; positions of shape (n, 3) [m].
    """
    r = [wire.evaluate(state.z, at).r for wire, at in zip(state.wires, s, strict=True)]
    guess = [np.interp(at, *state.stations(k)) for k, at in enumerate(s)]
    frames = alignment.frames(alignment.locate(np.concatenate(r), np.concatenate(guess)))
    ends: list[int] = np.cumsum([at.size for at in s]).tolist()
    return [frames.take(slice(end - at.size, end)) for end, at in zip(ends, s, strict=True)], r
