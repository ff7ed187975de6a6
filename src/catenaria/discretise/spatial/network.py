"""The line as a net: points across the track, the wires that run through them, and what acts where.

A *knot* is a point of the line that strings share: a clamp, a support, an anchored end. A *station* is a knot
as one wire passes it: where a wire is tied to another one, both have a station at the same knot.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout, across
from catenaria.errors import InconsistentInputError
from catenaria.line.alignment import Frames

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]

_NEAR = 1e-6  # what acts on a wire within so much of chainage acts at one knot [m]


@dataclass(frozen=True)
class Network:
    """Knots, stations and bays of all wires.

    Attributes
    ----------
    P, along, left : FloatArray, shape (n_knots, 3)
        Origins of the track frames at the knots and horizontal unit vectors along the track and to the left.
        Anchored ends come last; their vectors are zero and their origins are the anchors.
    anchors : int
        Number of the first anchored end.
    knot : IntArray, shape (n_stations,)
        Knot of every station; stations are in order of wires, then from a wire's start to its end.
    first : IntArray, shape (n_wires + 1,)
        Where the stations of each wire begin.
    bay : IntArray, shape (n_bays,)
        Stations at which bays begin: all but the last one of each wire. Each bay ends at the next station.
    bay_wire : IntArray, shape (n_bays,)
        Wires of the bays.
    inner, after : IntArray, shape (n_stations - 2 n_wires,)
        Stations that are not ends, and the bays behind them; the bays before are one less.
    hold, lower, upper, tie, mass : IntArray, shape (n,)
        Stations of supports, of droppers' lower and upper clamps, of ties on their hosts, of point masses.
    tied : IntArray, shape (n_ties,)
        Stations of the tied ends on their own wires.
    """

    P: FloatArray
    along: FloatArray
    left: FloatArray
    anchors: int
    knot: IntArray
    first: IntArray
    bay: IntArray
    bay_wire: IntArray
    inner: IntArray
    after: IntArray
    hold: IntArray
    lower: IntArray
    upper: IntArray
    tie: IntArray
    mass: IntArray
    tied: IntArray

    @classmethod
    def of(cls, layout: Layout) -> Network:
        """Return the net of a line.

        Raises
        ------
        InconsistentInputError
            If a tied wire does not have both of its ends tied, or ends where something else acts on it.
        """
        clamps = _Clamps.of(layout)
        runs = tuple(_runs(layout, clamps))
        knot, first = np.concatenate(runs), np.cumsum([0, *(run.size for run in runs)])
        every = np.arange(knot.size)
        inner = np.delete(every, np.concatenate((first[:-1], first[1:] - 1)))
        bay = np.delete(every, first[1:] - 1)
        station = np.empty(clamps.wire.size, dtype=np.int64)
        station[knot[inner]] = inner
        hold, lower, upper, tie, mass = (station[group] for group in clamps.groups)
        wire, end = layout.ties.wire, layout.ties.end
        anchors = np.concatenate([np.zeros((0, 3)), *(own.ends for own in layout.wires if not own.tied)])
        none = np.zeros_like(anchors)
        return cls(
            P=np.concatenate((clamps.frame.origin, anchors)),
            along=np.concatenate((clamps.frame.along, none)),
            left=np.concatenate((across(clamps.frame), none)),
            anchors=clamps.wire.size,
            knot=knot,
            first=first,
            bay=bay,
            bay_wire=np.repeat(np.arange(len(runs)), np.diff(first) - 1),
            inner=inner,
            after=np.searchsorted(bay, inner),
            hold=hold,
            lower=lower,
            upper=upper,
            tie=tie,
            mass=mass,
            tied=np.where(end == 0, first[wire], first[wire + 1] - 1),
        )

    def stations(self, wire: int) -> slice:
        """Return where the stations of a wire are."""
        return slice(int(self.first[wire]), int(self.first[wire + 1]))

    def bays(self, wire: int) -> slice:
        """Return where the bays of a wire are."""
        return slice(int(self.first[wire]) - wire, int(self.first[wire + 1]) - wire - 1)

    def sum_at_knots(self, station: IntArray, values: FloatArray) -> FloatArray:
        """Return for every knot the sum of vectors that belong to stations, shape (n_knots, 3)."""
        total = np.zeros_like(self.P)
        np.add.at(total, self.knot[station], values)
        return total


@dataclass(frozen=True)
class _Clamps:
    """Knots at which something acts on a wire, in order of wires and chainages.

    `groups` has the knots of supports, lower and upper ends of droppers, ties on hosts, and masses.
    """

    wire: IntArray
    frame: Frames
    groups: tuple[IntArray, ...]

    @classmethod
    def of(cls, layout: Layout) -> _Clamps:
        """Return the knots of a line; what acts on a wire at the same chainage is at the same knot."""
        holds, droppers, ties, masses = layout.holds, layout.droppers, layout.ties, layout.masses
        parts = (
            (holds.wire, holds.frame),
            (droppers.lower, droppers.frame),
            (droppers.upper, droppers.frame),
            (ties.host, ties.frame),
            (masses.wire, masses.frame),
        )
        wire = np.concatenate([part[0] for part in parts])
        frame = Frames.concatenate([part[1] for part in parts])
        order = np.lexsort((frame.chainage, wire))
        apart = np.diff(frame.chainage[order], prepend=-np.inf) > _NEAR
        begins = apart | (np.diff(wire[order], prepend=-1) != 0)
        knot = np.empty(wire.size, dtype=np.int64)
        knot[order] = np.cumsum(begins) - 1
        one = order[begins]
        sizes = np.cumsum([part[0].size for part in parts])[:-1]
        return cls(wire[one], frame.take(one), tuple(np.split(knot, sizes)))


def _runs(layout: Layout, clamps: _Clamps) -> Iterator[IntArray]:
    """Yield the knots of each wire from its start to its end."""
    anchored = clamps.wire.size
    for k, wire in enumerate(layout.wires):
        inner = np.flatnonzero(clamps.wire == k)
        if not wire.tied:
            ends = anchored, anchored + 1
            anchored += 2
        else:
            ends = _tied_ends(layout, clamps, k)
            chainage = clamps.frame.chainage
            if chainage[ends[0]] > chainage[ends[1]]:
                inner = inner[::-1]
        yield np.array([ends[0], *inner, ends[1]], dtype=np.int64)


def _tied_ends(layout: Layout, clamps: _Clamps, wire: int) -> tuple[int, int]:
    ties, knots = layout.ties, clamps.groups[3]
    start, end = (np.flatnonzero((ties.wire == wire) & (ties.end == which)) for which in (0, 1))
    if start.size != 1 or end.size != 1:
        raise InconsistentInputError(f"the {layout.wires[wire].name} must have each of its ends tied once")
    return int(knots[start[0]]), int(knots[end[0]])
