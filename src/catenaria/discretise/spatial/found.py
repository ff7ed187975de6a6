"""A line as it was found, to be built or loaded: a model that starts where a result ended, on the same nodes.

Results in the plane and in space give the same kind of model: bars of the found unstressed lengths between
wires of the found natural lengths, clamped where they were found.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.built import with_found_hinges
from catenaria.discretise.spatial.guess import Guess
from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.model import SpatialModel, build_model
from catenaria.errors import UnsupportedError
from catenaria.line import Line
from catenaria.numerics.hermite import shape, shape_1
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

_UP = np.array([0.0, 0.0, 1.0])
_CLOSE = 0.02  # m between nodes


@dataclass(frozen=True)
class FoundCourse:
    """Where one wire was found.

    Attributes
    ----------
    knots : FloatArray, shape (n_nodes,)
        Natural coordinates of its nodes [m].
    position, slope : FloatArray, shape (n_nodes, 3)
        r [m] and r' there.
    pull : float
        How far pulled ends are outwards of their anchors [m]; 0 of tied wires, which are as long as meshed.
    """

    knots: FloatArray
    position: FloatArray
    slope: FloatArray
    pull: float

    @property
    def length(self) -> float:
        """Unstressed length, end to end [m]."""
        return float(self.knots[-1])

    def place(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return r and r' at natural coordinates, shape (n, 3) each."""
        e = np.clip(np.searchsorted(self.knots, s, side="right") - 1, 0, self.knots.size - 2)
        L = np.diff(self.knots)[e]
        xi = 2.0 * (s - self.knots[e]) / L - 1.0
        nodal = np.stack((self.position[e], self.slope[e], self.position[e + 1], self.slope[e + 1]), axis=1)
        r, r1 = (np.einsum("nk,nki->ni", N(xi, L), nodal) for N in (shape, shape_1))
        return r, r1


def found_model(
    line: Line, result: FormResult, finer: Mapping[int, FloatArray] | None = None
) -> SpatialModel:
    """Return a line with the lengths, clamps and hinges of a result, whose unknowns start where that ended.

    Parameters
    ----------
    line : Line
        The line for which the form was found.
    result : FormResult
        What was found.
    finer : mapping of int to FloatArray, optional
        Natural coordinates of wires at which further nodes stand [m], with loads at points for example.

    Raises
    ------
    UnsupportedError
        If the result says nothing of its nodes, as those of methods for strings.
    """
    if result.physics != "bending":
        raise UnsupportedError(
            f"a result of method {result.method!r} has no nodes to start from; direct's has"
        )
    layout = with_found_hinges(lay_out(line), result)
    start = _start(layout, result)
    more = finer or {}
    meshes = tuple(_finer(course.knots, more.get(k)) for k, course in enumerate(_courses(result)))
    model = build_model(layout, start, meshes)
    return _with_cantilevers(model, result)


def _finer(knots: FloatArray, more: FloatArray | None) -> FloatArray:
    """Return knots and further ones between them, unless these lie close to others."""
    points: list[float] = [] if more is None else more.tolist()
    for s in points:
        if knots[0] < s < knots[-1] and np.abs(knots - s).min() > _CLOSE:
            knots = np.sort(np.concatenate((knots, [s])))
    return knots


def _courses(result: FormResult) -> Iterator[FoundCourse]:
    """Yield where all wires are; a plane result has one stage for each wire, one in space has one for all."""
    travels = {wire.name: (0.0 if _tied(wire.role) else wire.travel) for wire in result.wires}
    for stage in result.stages:
        first = 0
        for name, count in zip(stage.chain, stage.node_count.tolist(), strict=True):
            own = slice(first, first + count)
            first += count
            if name in travels:
                yield FoundCourse(stage.s[own], stage.position[own], stage.slope[own], travels[name])


def _tied(role: str) -> bool:
    return role in ("stitch wire", "mid-point anchor")


def _start(layout: Layout, result: FormResult) -> Guess:
    droppers, supports, laid = result.droppers, result.supports, layout.droppers
    d = droppers.position_top - droppers.position_bottom
    size = np.linalg.norm(d, axis=1)
    weight = layout.g * (0.5 * laid.rhoA * size + laid.mass_bottom)
    pull = np.einsum("ni,ni->n", droppers.on_contact + weight[:, None] * _UP, d) / size
    free = np.array([not _tied(wire.role) for wire in result.wires])
    return Guess(
        courses=tuple(_courses(result)),
        hold_s=supports.sliding_coordinate,
        hold_force=np.column_stack((supports.force_x, supports.force_y, supports.force_z)),
        lower_s=droppers.contact_coordinate,
        upper_s=droppers.messenger_coordinate,
        density=pull / size,
        dropper_length=droppers.unstressed_length,
        tie_s=result.ties.coordinate,
        tie_force=result.ties.force,
        mass_s=result.masses.coordinate,
        end_force=np.where(free[:, None, None], [wire.end_force for wire in result.wires], 0.0),
    )


def _with_cantilevers(model: SpatialModel, result: FormResult) -> SpatialModel:
    """Return the model with its cantilevers bent as they were found."""
    if not model.cantilevers:
        return model
    start, stage = model.unknowns.start.copy(), result.stages[0]
    nodes = np.concatenate([chain.nodes for chain in model.cantilevers])
    last = stage.position.shape[0] - nodes.shape[0]
    start[nodes] = np.hstack((stage.position[last:], stage.slope[last:]))
    return replace(model, unknowns=replace(model.unknowns, start=start))
