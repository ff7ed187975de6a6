"""The configuration as a VTK file of lines in space, for ParaView."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.export.libraries import library
from catenaria.line import Line
from catenaria.line.alignment import Alignment
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]

WIRE, DROPPER, ARM, CANTILEVER = range(4)
_POINT = ("s_m", "tension_N", "moment_Nm", "curvature_per_m", "chainage_m", "lateral_m", "height_m")


@dataclass(frozen=True)
class Strand:
    """A polyline of one kind: points (n, 3), values at them (n, 7), and what its cells bear [N]."""

    kind: int
    wire: int
    number: int
    points: FloatArray
    values: FloatArray
    force: FloatArray


def write_vtu(result: FormResult, file: Path) -> None:
    """Write wires, droppers, arms and cantilevers as cells of two points each.

    Parameters
    ----------
    result : FormResult
        What was found.
    file : path
        With suffix ``.vtu``.

    Notes
    -----
    Cell data: ``kind`` (0 wire, 1 dropper, 2 steady arm, 3 cantilever), ``wire`` (number in the order of
    wires.csv from 0, of droppers that of their lower wire), ``number`` (of the dropper or arm in its table,
    from 0) and ``force_N``: tension in wires, droppers' pull on the lower wire, axial force in arms. Point
    data: s_m, tension_N, moment_Nm, curvature_per_m, chainage_m, lateral_m, height_m; droppers and arms do
    not bend. Forces along cantilevers are not known: they are NaN.

    Raises
    ------
    UnsupportedError
        If meshio is not installed.
    """
    meshio = library("meshio", "meshio", "VTK")
    strands = list(_strands(result))
    counts = np.array([strand.points.shape[0] for strand in strands])
    first = np.concatenate(([0], np.cumsum(counts)[:-1]))
    own = zip(first.tolist(), counts.tolist(), strict=True)
    starts = np.concatenate([np.arange(start, start + n - 1, dtype=np.int64) for start, n in own])
    values = np.concatenate([strand.values for strand in strands])
    cell = {
        "kind": np.repeat([strand.kind for strand in strands], counts - 1).astype(np.int32),
        "wire": np.repeat([strand.wire for strand in strands], counts - 1).astype(np.int32),
        "number": np.repeat([strand.number for strand in strands], counts - 1).astype(np.int32),
        "force_N": np.concatenate([strand.force for strand in strands]),
    }
    mesh = meshio.Mesh(
        np.concatenate([strand.points for strand in strands]),
        [("line", np.column_stack((starts, starts + 1)))],
        point_data={name: np.ascontiguousarray(values[:, i]) for i, name in enumerate(_POINT)},
        cell_data={name: [data] for name, data in cell.items()},
    )
    mesh.write(file, file_format="vtu")


def _strands(result: FormResult) -> Iterator[Strand]:
    line = Line.model_validate(result.inputs)
    index = {wire.name: k for k, wire in enumerate(result.wires)}
    for k, (form, wire) in enumerate(zip(result.wires, lay_out(line).wires, strict=True)):
        profile = form.profile
        EJ = wire.section.EJ
        curvature = profile.moment / EJ if EJ > 0.0 else np.full_like(profile.moment, np.nan)
        track = (profile.chainage, profile.lateral, profile.height)
        values = np.column_stack((profile.s, profile.tension, profile.moment, curvature, *track))
        points = np.column_stack((profile.x, profile.y, profile.z))
        yield Strand(WIRE, k, k, points, values, 0.5 * (profile.tension[1:] + profile.tension[:-1]))
    droppers, arms, beams = result.droppers, result.arms, result.cantilevers
    start = dict(zip(result.supports.support, result.supports.chainage.tolist(), strict=True))
    for kind, wires, starts, ends, guess in (
        (DROPPER, droppers.lower_wire, droppers.position_bottom, droppers.position_top, droppers.x),
        (ARM, arms.wire, arms.hinge, arms.tip, arms.chainage),
        (CANTILEVER, None, beams.root, beams.tip, np.array([start[name] for name in beams.support])),
    ):
        places = [(points, _in_track(line.alignment, points, guess)) for points in (starts, ends)]
        for i in range(starts.shape[0]):
            values = np.column_stack((_inner(result, kind, i), np.stack([track[i] for _, track in places])))
            wire = -1 if wires is None else index[wires[i]]
            points = np.stack([points[i] for points, _ in places])
            yield Strand(kind, wire, i, points, values, values[:1, _POINT.index("tension_N")])


def _inner(result: FormResult, kind: int, i: int) -> FloatArray:
    """Return s, tension, moment and curvature at both ends of a dropper, arm or cantilever, shape (2, 4)."""
    values = np.zeros((2, 4))
    if kind == DROPPER:
        droppers = result.droppers
        values[1, 0] = droppers.unstressed_length[i]
        values[:, 1] = droppers.force_bottom[i], droppers.force_top[i]
    elif kind == ARM:
        values[1, 0] = result.arms.length[i]
        values[:, 1] = result.arms.axial[i]
    else:
        values[1, 0] = np.linalg.norm(result.cantilevers.tip[i] - result.cantilevers.root[i])
        values[:, 1:] = np.nan
    return values


def _in_track(alignment: Alignment, points: FloatArray, guess: FloatArray) -> FloatArray:
    """Return chainages, lateral offsets and heights of points, shape (n, 3)."""
    frames = alignment.frames(alignment.locate(points, guess))
    return np.column_stack((frames.chainage, frames.lateral(points), frames.height(points)))
