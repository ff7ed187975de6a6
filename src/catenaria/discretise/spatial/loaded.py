"""A found line under loads: warmer, with wind and ice, pushed, with broken droppers and moved supports.

All unstressed lengths are kept, clamps stay at their material points, and the tensioning devices act by their
own laws. Everything else is the line in space that was found; see `found_model`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.demands import tension_demands
from catenaria.discretise.spatial.model import FULL, SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.discretise.spatial.numbering import NONE
from catenaria.errors import InconsistentInputError
from catenaria.line.alignment import Alignment
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.controls.sprung import Sprung
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.loads.dead import DeadLoads
from catenaria.mechanics.system import System

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_PASSES = 4  # of Newton's method, which has all digits after three
_LONGER = 100.0  # a dropper that is so many times as long as the one that was found is slack anywhere


@dataclass(frozen=True)
class Devices:
    """What holds the ends of wires after they have been tensioned.

    Attributes
    ----------
    moves : tuple of bool
        Whether each wire has a device whose travel follows the loads; else its ends stay where they are.
    stiffness : FloatArray, shape (n_wires,)
        Stiffness of devices that are springs [N/m]; 0 of weights and hydraulic ones.
    """

    moves: tuple[bool, ...]
    stiffness: FloatArray


def loaded_system(
    model: SpatialModel, z: FloatArray, load: FloatArray, devices: Devices, *, may_push: bool = False
) -> System:
    """Return the built line under a load, with tensions as devices had them in the model's start.

    Parameters
    ----------
    model : SpatialModel
        The line as it was found, or what `warmed` and others made of it.
    z : FloatArray, shape (n,)
        Unknowns that joints shall fit; lengths and clamps are those of z.
    load : FloatArray, shape (n,)
        Dead forces on the unknowns [N].
    devices : Devices
        What holds the ends of the wires.
    may_push : bool
        Whether droppers push instead of going slack.
    """
    held = list(_held_tensions(model, z, devices))
    return model.system(z, [*held, DeadLoads(load)], FULL, built=True, only_pull=not may_push)


def _held_tensions(model: SpatialModel, z: FloatArray, devices: Devices) -> Iterator[Targets]:
    start = model.unknowns.start
    for demand, moves, stiffness in zip(
        tension_demands(model, z), devices.moves, devices.stiffness, strict=True
    ):
        if moves and model.pull[demand.wire] != NONE:
            measure = Sprung(demand.measure, demand.parameter, np.array([stiffness]))
            fits = measure.relocate(start) or measure
            yield Targets(demand.parameter, measure, fits.value(0.0, start))


def warmed(
    model: SpatialModel, warming: float, expansion: Sequence[float], dropper_expansion: float
) -> SpatialModel:
    """Return a line whose wires and droppers are longer without stress; masses stay what they are.

    Parameters
    ----------
    model : SpatialModel
        The line.
    warming : float
        Change of temperature [K].
    expansion, dropper_expansion : sequence of float, float
        Coefficients of thermal expansion of each wire, and of droppers [1/K].
    """
    factor = 1.0 + warming * np.array(expansion)
    start = model.unknowns.start.copy()
    start[model.length] *= 1.0 + warming * dropper_expansion
    for at, on, _ in Natural(model, start).attached():
        start[at] *= factor[on]
    wires: list[Chain] = []
    for chain, longer in zip(model.wires, factor, strict=True):
        section = replace(chain.section, rhoA=chain.section.rhoA / longer)
        wires.append(Chain(chain.nodes, chain.knots * longer, section))
        start[chain.nodes[:, 3:]] /= longer
    return replace(model, wires=tuple(wires), unknowns=replace(model.unknowns, start=start))


def without_droppers(model: SpatialModel, broken: NDArray[np.bool_]) -> SpatialModel:
    """Return a line of which some droppers, shape (n,), are missing: they carry nothing and weigh nothing."""
    start, droppers, there = model.unknowns.start.copy(), model.layout.droppers, ~broken
    start[model.length[broken]] *= _LONGER
    start[model.density[broken]] = 0.0
    light = replace(
        droppers,
        rhoA=droppers.rhoA * there,
        mass_bottom=droppers.mass_bottom * there,
        mass_top=droppers.mass_top * there,
    )
    layout = replace(model.layout, droppers=light)
    return replace(model, layout=layout, unknowns=replace(model.unknowns, start=start))


def with_dropper_lengths(model: SpatialModel, length: FloatArray) -> SpatialModel:
    """Return a line with droppers of other unstressed lengths, shape (n,) [m]."""
    start = model.unknowns.start.copy()
    start[model.length] = length
    return replace(model, unknowns=replace(model.unknowns, start=start))


def with_moved_supports(model: SpatialModel, shift: FloatArray) -> SpatialModel:
    """Return a line whose supports and hinges are elsewhere by the given shifts, shape (n_holds, 3) [m].

    Cantilevers move with their roots.
    """
    layout, holds, start = model.layout, model.layout.holds, model.unknowns.start.copy()
    for part, chain in zip(layout.cantilevers, model.cantilevers, strict=True):
        start[chain.nodes[:, :3]] += shift[part.hold]
    roots = tuple(replace(part, root=part.root + shift[part.hold]) for part in layout.cantilevers)
    moved = replace(holds, X=holds.X + shift, hinge=holds.hinge + shift)
    return replace(
        model,
        layout=replace(layout, holds=moved, cantilevers=roots),
        unknowns=replace(model.unknowns, start=start),
    )


def line_load(model: SpatialModel, per_metre: Sequence[FloatArray]) -> FloatArray:
    r"""Return the generalised forces of loads on wires.

    Parameters
    ----------
    model : SpatialModel
        The line.
    per_metre : sequence of FloatArray, shape (n_elements, 3)
        For each wire, the force on every element per metre of its unstressed length [N/m].

    Notes
    -----
    .. math:: \int_0^L S^T n\,dl = L [\tfrac12, \tfrac{L}{12}, \tfrac12, -\tfrac{L}{12}] \otimes n,
        as eq. (17).
    """
    load = np.zeros(model.unknowns.size)
    for chain, force in zip(model.wires, per_metre, strict=True):
        L, half = chain.L[:, None], np.full((chain.L.size, 1), 0.5)
        share = L * np.concatenate((half, L / 12.0, half, -L / 12.0), axis=1)
        np.add.at(load, chain.dofs.reshape(-1, 4, 3), share[:, :, None] * force[:, None, :])
    return load


def clamp_load(model: SpatialModel, at_bottom: FloatArray, at_top: FloatArray) -> FloatArray:
    """Return the generalised forces of loads at the lower and upper clamps of droppers, (n, 3) each [N]."""
    load, z = np.zeros(model.unknowns.size), model.unknowns.start
    for carrier, s, force in (
        (model.lower_carrier, model.lower_s, at_bottom),
        (model.upper_carrier, model.upper_s, at_top),
    ):
        point = carrier.evaluate(z, z[s])
        np.add.at(load, point.dofs, point.N[:, :, None] * force[:, None, :])
    return load


def point_load(model: SpatialModel, wire: int, s: FloatArray, force: FloatArray) -> FloatArray:
    """Return the generalised force of each of some point loads, shape (n_points, n_unknowns).

    Parameters
    ----------
    model : SpatialModel
        The line.
    wire : int
        On which wire they act.
    s : FloatArray, shape (n_points,)
        Material coordinates [m].
    force : FloatArray, shape (n_points, 3)
        Forces [N].
    """
    point = model.wires[wire].evaluate(model.unknowns.start, s)
    load = np.zeros((s.size, model.unknowns.size))
    rows = np.arange(s.size)[:, None, None]
    np.add.at(load, (rows, point.dofs), point.N[:, :, None] * force[:, None, :])
    return load


def material_at(model: SpatialModel, wire: int, alignment: Alignment, chainage: FloatArray) -> FloatArray:
    """Return the material coordinates of a wire's points that lie at given chainages in the model's start.

    Parameters
    ----------
    model : SpatialModel
        The line.
    wire : int
        Which wire.
    alignment : Alignment
        Course of the track.
    chainage : FloatArray, shape (n,)
        Chainages between the wire's ends [m].

    Raises
    ------
    InconsistentInputError
        If the wire does not reach as far.
    """
    chain, z = model.wires[wire], model.unknowns.start
    known = Natural(model, z).stations(wire)
    nodes = alignment.locate(z[chain.nodes[:, :3]], np.interp(chain.knots, *known))
    outside = (chainage < nodes[0]) | (chainage > nodes[-1])
    if outside.any():
        raise InconsistentInputError(
            f"the {model.layout.wires[wire].name} reaches from {nodes[0]:.6g} to {nodes[-1]:.6g} m of "
            f"chainage, not to {chainage[outside][0]:.6g} m"
        )
    frames, s = alignment.frames(chainage), np.interp(chainage, nodes, chain.knots)
    for _ in range(_PASSES):
        point = chain.evaluate(z, s)
        ahead = np.einsum("ni,ni->n", frames.along, point.r - frames.origin)
        s = np.clip(s - ahead / np.einsum("ni,ni->n", frames.along, point.r1), 0.0, chain.knots[-1])
    return s
