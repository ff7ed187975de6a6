"""The wires of a line in space cut free, each with all forces on it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.curve import Curve
from catenaria.audit.free_wire import FreeWire
from catenaria.audit.spatial.stated import StatedLine
from catenaria.audit.spatial.stated_wires import SpatialWire
from catenaria.errors import InconsistentInputError
from catenaria.results.form import FormResult, Stage, WireForm

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class FreeSpatialWire(FreeWire):
    """A wire in space as a free body; `clamp_s` and `clamp_force` are of all that is clamped to it.

    Attributes
    ----------
    stated : SpatialWire
        What the line file says of it.
    support_row : IntArray, shape (m,)
        Its rows in the table of supports.
    clamp_name : tuple of str
        Names of droppers, ties and masses, in the order of `clamp_s`.
    weighs : NDArray[np.bool_]
        Which of these are loads on the line, as masses are, and not forces between its parts.
    """

    stated: SpatialWire
    support_row: IntArray
    clamp_name: tuple[str, ...]
    weighs: NDArray[np.bool_]

    @cached_property
    def joint_name(self) -> tuple[str, ...]:
        """Names of supports, clamps, start and end."""
        supports = (f"support {name}" for name in self.stated.support_name)
        return (*supports, *self.clamp_name, "its start", "its end")

    @cached_property
    def outer_force(self) -> FloatArray:
        """Forces on it at all its joints that come from outside of the line, shape (m + n + 2, 3) [N]."""
        outer = self.joint_force.copy()
        outer[self.support_s.size : -2][~self.weighs] = 0.0
        if self.stated.tied:
            outer[-2:] = 0.0
        return outer


def positions(wires: tuple[FreeSpatialWire, ...], names: tuple[str, ...], s: FloatArray) -> FloatArray:
    """Return where wires with given names are at given material coordinates, shape (n, 3) [m]."""
    r = np.full((s.size, 3), np.nan)
    for wire in wires:
        own = np.array([name == wire.stated.name for name in names], dtype=np.bool_)
        if own.any():
            r[own] = wire.curve.at(s[own]).r
    return r


class _Clamp(NamedTuple):
    name: str
    s: float
    force: FloatArray
    weighs: bool


def free_spatial_wires(result: FormResult, stated: StatedLine) -> tuple[FreeSpatialWire, ...]:
    """Cut all wires of a line in space free.

    Parameters
    ----------
    result, stated
        What was found and what was asked for.

    Raises
    ------
    InconsistentInputError
        If the result does not have one entry for each wire, support, dropper, tie and mass of its line.
    """
    _compare(result, stated)
    curves = curves_of(result.stages[0])
    clamps: dict[str, list[_Clamp]] = {wire.name: [] for wire in stated.wires}
    for wire, clamp in _clamps(result, stated.gravity):
        clamps[wire].append(clamp)
    return tuple(
        _cut(result, wire, form, curves[wire.name], clamps[wire.name], stated)
        for wire, form in zip(stated.wires, result.wires, strict=True)
    )


def _cut(
    result: FormResult,
    wire: SpatialWire,
    form: WireForm,
    curve: Curve,
    clamps: list[_Clamp],
    stated: StatedLine,
) -> FreeSpatialWire:
    table = result.supports
    held = np.array([i for i, name in enumerate(table.wire) if name == wire.name], dtype=np.int64)
    return FreeSpatialWire(
        stated=wire,
        form=form,
        support_s=table.sliding_coordinate[held],
        support_force=-np.column_stack((table.force_x, table.force_y, table.force_z))[held],
        clamp_s=np.array([clamp.s for clamp in clamps], dtype=np.float64),
        clamp_force=np.array([clamp.force for clamp in clamps], dtype=np.float64).reshape(-1, 3),
        gravity=stated.gravity,
        largest_tension=stated.largest_tension,
        curve=curve,
        support_row=held,
        clamp_name=tuple(clamp.name for clamp in clamps),
        weighs=np.array([clamp.weighs for clamp in clamps], dtype=np.bool_),
    )


def _clamps(result: FormResult, gravity: float) -> Iterator[tuple[str, _Clamp]]:
    """Yield everything that is clamped to wires, with the name of the wire."""
    droppers, ties, masses = result.droppers, result.ties, result.masses
    lower = zip(droppers.lower_wire, droppers.contact_coordinate.tolist(), droppers.on_contact, strict=True)
    upper = zip(
        droppers.upper_wire, droppers.messenger_coordinate.tolist(), droppers.on_messenger, strict=True
    )
    for ends in (lower, upper):
        for i, (wire, s, force) in enumerate(ends, start=1):
            yield wire, _Clamp(f"dropper {i}", s, force, weighs=False)
    for wire, host, end, s, force in zip(
        ties.wire, ties.host, ties.end.tolist(), ties.coordinate.tolist(), ties.force, strict=True
    ):
        yield host, _Clamp(f"{('start', 'end')[end]} of the {wire}", s, force, weighs=False)
    for name, wire, s, mass in zip(
        masses.name, masses.wire, masses.coordinate.tolist(), masses.mass.tolist(), strict=True
    ):
        yield wire, _Clamp(name, s, np.array([0.0, 0.0, -gravity * mass]), weighs=True)


def curves_of(stage: Stage) -> dict[str, Curve]:
    """Return the curves of all wires and cantilevers by name."""
    last = np.cumsum(stage.node_count).tolist()
    nodes = [slice(end - int(count), end) for end, count in zip(last, stage.node_count, strict=True)]
    return {
        name: Curve(stage.s[part], stage.position[part], stage.slope[part])
        for name, part in zip(stage.chain, nodes, strict=True)
    }


def _compare(result: FormResult, stated: StatedLine) -> None:
    """Refuse a result that is not of its line."""
    supports = tuple((wire.name, name) for wire in stated.wires for name in wire.support_name)
    measures = tuple(wire.measure for wire in stated.wires)
    kinds = tuple(kind for wire in stated.wires for kind in wire.holds.kind)
    droppers, ties, masses = stated.droppers, stated.ties, stated.masses
    names = tuple(wire.name for wire in stated.wires)
    tied = tuple(zip(ties.wire, ties.end, strict=True))
    hung = tuple(zip(masses.name, masses.wire, strict=True))
    for what, found, wanted in (
        ("wires", tuple(form.name for form in result.wires), names),
        ("nodes of the wires", result.stages[0].chain[: len(names)], names),
        ("supports", tuple(zip(result.supports.wire, result.supports.support, strict=True)), supports),
        ("measures of tension", tuple(form.measure for form in result.wires), measures),
        ("kinds of supports", result.supports.kind, kinds),
        ("spans of droppers", tuple(result.droppers.span.tolist()), droppers.span),
        ("numbers of droppers", tuple(result.droppers.number.tolist()), droppers.number),
        ("lower wires of droppers", result.droppers.lower_wire, droppers.lower),
        ("upper wires of droppers", result.droppers.upper_wire, droppers.upper),
        ("tied wires", tuple(zip(result.ties.wire, result.ties.end.tolist(), strict=True)), tied),
        ("hosts of tied wires", result.ties.host, ties.host),
        ("masses", tuple(zip(result.masses.name, result.masses.wire, strict=True)), hung),
    ):
        if found != wanted:
            raise InconsistentInputError(f"the result does not have the {what} of its line in order")
