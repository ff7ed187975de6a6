"""From an adjusted line at rest to what the fitter asks for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.line.measured import MeasuredHeights
from catenaria.loading.adjustment_limits import AdjustmentLimits
from catenaria.loading.built_line import BuiltLine, LoadedLine
from catenaria.loading.by_lengths import Response
from catenaria.loading.gauged import GaugedPoints
from catenaria.results.adjustment import AdjustedDroppers, Adjustment, MeasuredPoints

FloatArray = NDArray[np.float64]

_DIGITS = 9  # of lengths in metres: changes are whole steps


def measured_points(
    built: BuiltLine, gauged: GaugedPoints, measured: MeasuredHeights, present: Response
) -> MeasuredPoints:
    """Return what was measured, and how the present lengths explain it."""
    wires = built.model.layout.wires
    return MeasuredPoints(
        wire=tuple(wires[int(k)].name for k in gauged.of),
        span=np.array([row.span for row in measured.rows], dtype=np.int64),
        number=np.array([row.number for row in measured.rows], dtype=np.int64),
        chainage=gauged.chainage,
        height=np.array([row.height for row in measured.rows]),
        explained=present.gauged,
    )


def adjusted_droppers(
    built: BuiltLine,
    checked: NDArray[np.bool_],
    present: Response,
    predicted: FloatArray,
    rest: LoadedLine,
) -> AdjustedDroppers:
    """Return all droppers before and after.

    Parameters
    ----------
    built : BuiltLine
        The line as it was to be built.
    checked : NDArray of bool, shape (n,)
        Which droppers hold contact wires.
    present : Response
        The line as it is.
    predicted : FloatArray, shape (n,)
        Heights after adjustment by the last linearisation [m].
    rest : LoadedLine
        The line after adjustment.
    """
    model, found = built.model, built.result.droppers
    laid, wires = model.layout.droppers, model.layout.wires
    new = rest.model.unknowns.start[model.length]
    return AdjustedDroppers(
        lower_wire=tuple(wires[int(k)].name for k in laid.lower),
        upper_wire=tuple(wires[int(k)].name for k in laid.upper),
        span=laid.span,
        number=laid.number,
        chainage=laid.frame.chainage,
        checked=checked,
        scheduled_length=found.unstressed_length,
        present_length=present.length,
        clamps=found.unstressed_length - found.cut_length,
        change=np.round(new - present.length, _DIGITS) + 0.0,
        wanted_height=built.at_rest.height,
        height_before=present.height,
        height_predicted=predicted,
        height_after=rest.height,
        force_before=np.maximum(present.pull, 0.0),
        force_after=np.maximum(rest.dropper_pull, 0.0),
    )


def adjustment(
    built: BuiltLine,
    limits: AdjustmentLimits,
    points: MeasuredPoints,
    droppers: AdjustedDroppers,
    fewest: int,
    passes: int,
) -> Adjustment:
    """Return the whole of an adjustment."""
    return Adjustment(
        line=built.result.name,
        method=built.result.method,
        tolerance=limits.tolerance,
        step=limits.step,
        largest_change=limits.largest_change,
        least_force=limits.least_force,
        noise=limits.noise,
        points=points,
        droppers=droppers,
        supports=tuple(support.name for support in built.line.supports),
        support_chainage=np.array(built.line.support_x),
        fewest=fewest,
        passes=passes,
        inputs=built.result.inputs,
    )
