"""The dropper schedule, with the lengths to which droppers are cut rounded to steps of a rule."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.numerics.rounding import rounded_half_up
from catenaria.report.columns import Columns
from catenaria.report.names import are_hangers
from catenaria.report.tables import write_csv
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]


def rounded_lengths(length: FloatArray, step: float) -> FloatArray:
    """Return lengths rounded to whole steps, halves upwards.

    Raises
    ------
    InconsistentInputError
        If the step is not positive, or nothing is left of a length.

    Examples
    --------
    >>> rounded_lengths(np.array([1.0024, 1.0025, 1.0075]), 0.005).tolist()
    [1.0, 1.005, 1.01]
    """
    if not step > 0.0:
        raise InconsistentInputError(f"dropper lengths are rounded to a step above 0 m, not to {step:g} m")
    rounded = rounded_half_up(length, step)
    if length.size and not rounded.min() > 0.0:
        raise InconsistentInputError(
            f"rounded to {step:g} m, nothing is left of a dropper that is cut to {length.min():.4g} m"
        )
    return rounded


def schedule_columns(result: FormResult, step: float) -> Columns:
    """Return the dropper schedule, one row for each dropper in the order of the line.

    Parameters
    ----------
    result : FormResult
        What was found.
    step : float
        Cut lengths are also given rounded to whole steps [m].
    """
    droppers = result.droppers
    rounded = rounded_lengths(droppers.cut_length, step)
    return {
        "span": droppers.span,
        "dropper": droppers.number,
        "chainage_m": droppers.x,
        "upper_wire": droppers.upper_wire,
        "lower_wire": droppers.lower_wire,
        "cut_length_rounded_m": rounded,
        "cut_length_m": droppers.cut_length,
        "rounding_mm": 1e3 * (rounded - droppers.cut_length),
        "unstressed_length_m": droppers.unstressed_length,
        "length_m": droppers.length,
        "force_bottom_N": droppers.force_bottom,
        "force_top_N": droppers.force_top,
        "height_m": droppers.height,
        "height_error_mm": 1e3 * droppers.height_error,
        "stagger_m": droppers.stagger_bottom,
        "inclination_deg": np.degrees(droppers.inclination),
        "reference_temperature_degC": np.full(rounded.size, reference_temperature(result)),
    }


def reference_temperature(result: FormResult) -> float:
    """Return the temperature at which unstressed and cut lengths hold [°C]."""
    return float(result.inputs["reference_temperature"])


def dropper_labels(result: FormResult) -> list[str]:
    """Return names for drawings: 2.3 is the third dropper of the second span, H2.3 its third hanger."""
    droppers = result.droppers
    named = zip(are_hangers(result).tolist(), droppers.span.tolist(), droppers.number.tolist(), strict=True)
    return [f"{'H' if hangs else ''}{span}.{number}" for hangs, span, number in named]


def write_schedule(result: FormResult, file: Path, step: float) -> None:
    """Write the dropper schedule as CSV, with the unit in every column name."""
    write_csv(file, schedule_columns(result, step))
