"""Where heights of a built line were measured: material points of its wires."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import material_at
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.errors import Fault, LineFileError
from catenaria.line import Line
from catenaria.line.base import closest
from catenaria.line.measured import MeasuredHeight, MeasuredHeights
from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.chain import Points

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_FARTHEST = 0.5  # m: a height that is further off was hardly measured on this line, in metres


@dataclass(frozen=True)
class GaugedPoints:
    """Material points of wires whose heights above the canted track are looked at.

    Attributes
    ----------
    of : IntArray, shape (m,)
        Indices of their wires.
    s : FloatArray, shape (m,)
        Material coordinates [m].
    chainage : FloatArray, shape (m,)
        Where they are along the track [m].
    origin, up : FloatArray, shape (m, 3)
        The middle of the track there [m], and its unit normal.
    """

    of: IntArray
    s: FloatArray
    chainage: FloatArray
    origin: FloatArray
    up: FloatArray

    def points(self, model: SpatialModel, z: FloatArray) -> Points:
        """Return the points where the unknowns are z."""
        return Strands.on(model.wires, self.of).evaluate(z, self.s)

    def height(self, model: SpatialModel, z: FloatArray) -> FloatArray:
        """Return the heights [m]."""
        return np.einsum("ni,ni->n", self.up, self.points(model, z).r - self.origin)


def gauged_points(line: Line, model: SpatialModel, measured: MeasuredHeights) -> GaugedPoints:
    """Return where heights were measured.

    Parameters
    ----------
    line : Line
        What is described.
    model : SpatialModel
        The line as it was found.
    measured : MeasuredHeights
        The rows of a file.

    Raises
    ------
    LineFileError
        If a row names what the line does not have, or two name the same dropper, or a height is far from
        that of the line; with a `Fault` for each.
    """
    find = _Finder(line, model, measured)
    faults = tuple(find.faults())
    if faults:
        raise LineFileError(faults)
    places = [find.place(row) for row in measured.rows]
    of, s, chainage, origin, up = (np.array(field) for field in zip(*places, strict=True))
    return GaugedPoints(of, s, chainage, origin, up)


Place = tuple[int, float, float, FloatArray, FloatArray]  # as the fields of `GaugedPoints`


@dataclass(frozen=True)
class _Finder:
    line: Line
    model: SpatialModel
    measured: MeasuredHeights

    def faults(self) -> Iterator[Fault]:
        known: dict[int, MeasuredHeight] = {}
        for row in self.measured.rows:
            fault = self._fault_of_place(row)
            if fault is not None:
                yield fault
                continue
            if row.at_dropper:
                earlier = known.setdefault(self._dropper(row), row)
                if earlier is not row:
                    found = f"dropper {row.number} of span {row.span} again"
                    line = earlier.marks["height_m"][0]
                    yield self.measured.fault(row, "dropper", found, f"each dropper once; see line {line}")
            height = self._found_height(row)
            if abs(row.height - height) > _FARTHEST:
                allowed = (
                    f"metres above the track, within {_FARTHEST:g} m of the {height:.3f} m that was found"
                )
                yield self.measured.fault(row, "height_m", f"{row.height:g}", allowed)

    def place(self, row: MeasuredHeight) -> Place:
        """Return where a row was measured."""
        if row.at_dropper:
            i, droppers = self._dropper(row), self.model.layout.droppers
            s = self.model.unknowns.start[self.model.lower_s[i]]
            frame, k = droppers.frame, int(droppers.lower[i])
            return k, float(s), float(frame.chainage[i]), frame.origin[i], frame.up[i]
        k, chainage = self._wires[row.wire or self._names[0]], np.array([row.chainage])
        frame = self.line.alignment.frames(chainage)
        s = material_at(self.model, k, self.line.alignment, chainage)
        return k, float(s[0]), row.chainage, frame.origin[0], frame.up[0]

    def _found_height(self, row: MeasuredHeight) -> float:
        point = GaugedPoints(*(np.array([field]) for field in self.place(row)))
        return float(point.height(self.model, self.model.unknowns.start)[0])

    @property
    def _names(self) -> tuple[str, ...]:
        """Wires whose heights may be measured, contact wires first."""
        below = np.unique(self.model.layout.droppers.lower)
        return tuple(self.model.layout.wires[int(k)].name for k in below)

    @property
    def _wires(self) -> dict[str, int]:
        return {wire.name: k for k, wire in enumerate(self.model.layout.wires)}

    def _candidates(self, row: MeasuredHeight) -> NDArray[np.bool_]:
        """Mask of the droppers among which a row may name one: of its wire, else of contact wires."""
        wires = self.model.layout.wires
        fits = [wire.name == row.wire if row.wire else wire.role == "contact wire" for wire in wires]
        return np.array(fits, dtype=np.bool_)[self.model.layout.droppers.lower]

    def _dropper(self, row: MeasuredHeight) -> int:
        droppers = self.model.layout.droppers
        mask = self._candidates(row) & (droppers.span == row.span) & (droppers.number == row.number)
        return int(np.flatnonzero(mask)[0])

    def _fault_of_place(self, row: MeasuredHeight) -> Fault | None:
        fault = self.measured.fault
        if row.wire and row.wire not in self._names:
            allowed = ", ".join(self._names) + closest(row.wire, self._names)
            return fault(row, "lower_wire", f'"{row.wire}"', allowed)
        if not row.at_dropper:
            x = self.line.support_x
            if x[0] <= row.chainage <= x[-1]:
                return None
            return fault(
                row, "chainage_m", f"{row.chainage:g}", f"{x[0]:g} to {x[-1]:g}, between the supports"
            )
        droppers, candidates = self.model.layout.droppers, self._candidates(row)
        spans = droppers.span[candidates]
        if row.span not in spans:
            return fault(row, "span", str(row.span), f"spans with droppers, {spans.min()} to {spans.max()}")
        numbers = droppers.number[candidates & (droppers.span == row.span)]
        if row.number not in numbers:
            return fault(
                row, "dropper", str(row.number), f"{numbers.min()} to {numbers.max()} in span {row.span}"
            )
        return None
