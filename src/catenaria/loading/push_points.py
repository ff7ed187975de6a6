"""Where a contact wire is pushed: at an even spacing, and at all supports, droppers and middles of spans."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array  # pyright: ignore[reportMissingTypeStubs]

from catenaria.discretise.spatial.loaded import material_at
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.errors import InconsistentInputError
from catenaria.line import Line

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Matrix = Any  # SciPy's csr_array

_SAME = 1e-6  # m: points that are nearer are one
_MOST = 100_000  # points: one for every 15 mm of a long line; more fill the memory


@dataclass(frozen=True)
class Stretch:
    """A span of the line, from 1, between its supports at two chainages [m]."""

    span: int
    start: float
    end: float

    @property
    def middle(self) -> float:
        """Chainage of its middle [m]."""
        return 0.5 * (self.start + self.end)


@dataclass(frozen=True)
class PushPoints:
    """Points at which contact wires are pushed, along the line.

    Attributes
    ----------
    chainage : FloatArray, shape (n,)
        [m].
    span : IntArray, shape (n,)
        Index of the stretch; a support belongs to the span that it begins.
    place : tuple of str
        ``support S3``, ``dropper 2``, ``mid span``, two of them with a comma between, or empty.
    wires : tuple of int
        The contact wires.
    s : tuple of FloatArray, shape (n,)
        Material coordinates of the points on each of them [m].
    forces : csr_array, shape (n, n_unknowns)
        Generalised unit forces, up across the track, in equal shares on all contact wires.
    """

    chainage: FloatArray
    span: IntArray
    place: tuple[str, ...]
    wires: tuple[int, ...]
    s: tuple[FloatArray, ...]
    forces: Matrix


def stretches(line: Line, model: SpatialModel) -> tuple[Stretch, ...]:
    """Return the spans between the first and the last support that hold the first contact wire."""
    holds = model.layout.holds
    held = holds.frame.chainage[holds.wire == 0]
    first, last = held.min() - _SAME, held.max() + _SAME
    ends = enumerate(pairwise(line.support_x), start=1)
    return tuple(Stretch(i, a, b) for i, (a, b) in ends if first <= a and b <= last)


def push_points(
    line: Line, model: SpatialModel, spacing: float, start: float | None = None, end: float | None = None
) -> PushPoints:
    """Return where a line is pushed.

    Parameters
    ----------
    line : Line
        The line.
    model : SpatialModel
        Its model, whose unknowns start where it rests.
    spacing : float
        Of points, without those at supports, droppers and middles of spans [m].
    start, end : float, optional
        First and last chainage [m]; by default the first and the last support of the contact wire.

    Raises
    ------
    InconsistentInputError
        If the spacing is not positive or makes too many points, or nothing is between start and end.
    """
    spans = stretches(line, model)
    first, last = spans[0].start, spans[-1].end
    begin, stop = (first if start is None else start), (last if end is None else end)
    if not (np.isfinite(spacing) and spacing > 0.0):
        raise InconsistentInputError(f"the spacing is {spacing:g} m; it must be positive")
    if not first <= begin < stop <= last:
        raise InconsistentInputError(
            f"nothing to push from {begin:g} to {stop:g} m; supports hold the contact wire from {first:g} "
            f"to {last:g} m"
        )
    if stop - begin > _MOST * spacing:
        raise InconsistentInputError(
            f"a spacing of {spacing:g} m from {begin:g} to {stop:g} m makes more than {_MOST} points"
        )
    places = _places(line, model, spans, begin, stop)
    known = np.array(sorted(places), dtype=np.float64)
    even = np.append(np.arange(begin, stop - _SAME, spacing), stop)
    near = np.searchsorted(known, even - _SAME) < np.searchsorted(known, even + _SAME)
    chainage = np.sort(np.concatenate((known, even[~near])))
    wires = contact_wires(model)
    s = tuple(material_at(model, k, line.alignment, chainage) for k in wires)
    ends = np.array([span.start for span in spans[1:]], dtype=np.float64)
    return PushPoints(
        chainage=chainage,
        span=np.searchsorted(ends, chainage, side="right").astype(np.int64),
        place=tuple(places.get(x, "") for x in chainage.tolist()),
        wires=wires,
        s=s,
        forces=_unit_forces(model, wires, s, line.alignment.frames(chainage).up),
    )


def _places(
    line: Line, model: SpatialModel, spans: tuple[Stretch, ...], begin: float, stop: float
) -> dict[float, str]:
    """Return the names of all chainages that have one."""
    droppers = model.layout.droppers
    on_contact = np.isin(droppers.lower, contact_wires(model))
    hung = zip(droppers.frame.chainage[on_contact], droppers.number[on_contact], strict=True)
    named = [
        *((span.middle, "mid span") for span in spans),
        *((float(x), f"dropper {int(number)}") for x, number in hung),
        *((x, f"support {support.name}") for x, support in zip(line.support_x, line.supports, strict=True)),
    ]
    places: dict[float, str] = {}
    for x, name in sorted(pair for pair in named if begin - _SAME <= pair[0] <= stop + _SAME):
        last = next(reversed(places), -np.inf)
        at = last if x - last < _SAME else x
        places[at] = f"{places[at]}, {name}" if at in places else name
    return places


def contact_wires(model: SpatialModel) -> tuple[int, ...]:
    """Return the indices of the contact wires."""
    return tuple(k for k, wire in enumerate(model.layout.wires) if wire.role == "contact wire")


def _unit_forces(
    model: SpatialModel, wires: tuple[int, ...], s: tuple[FloatArray, ...], up: FloatArray
) -> Matrix:
    shape = (up.shape[0], model.unknowns.size)
    forces: Matrix = csr_array(shape)
    for k, at in zip(wires, s, strict=True):
        point = model.wires[k].evaluate(model.unknowns.start, at)
        value = point.N[:, :, None] * up[:, None, :] / len(wires)
        row = np.broadcast_to(np.arange(at.size)[:, None, None], value.shape)
        forces = forces + csr_array((value.ravel(), (row.ravel(), point.dofs.ravel())), shape=shape)
    return forces
