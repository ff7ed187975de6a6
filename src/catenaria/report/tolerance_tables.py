"""The tables of tolerance studies and of rounded dropper lengths, as CSV files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from catenaria.report.columns import Columns
from catenaria.report.tables import write_csv
from catenaria.results.rounding import RoundedLine, RoundingStudy
from catenaria.results.tolerance import LEVELS, Scatter, ToleranceStudy

FloatArray = NDArray[np.float64]


def write_tolerance_tables(study: ToleranceStudy, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write heights.csv, forces.csv, tensions.csv, elasticity.csv, groups.csv, errors.csv and events.csv."""
    tables: dict[str, Columns] = {
        "heights": height_columns(study),
        "forces": {**_places(study), **scatter_columns(study.force, "N"), "slack_samples": study.slack},
        "tensions": {"wire_end": study.tension.name, **scatter_columns(study.tension, "N")},
        "elasticity": {
            "span": np.arange(1, len(study.elasticity.name) + 1),
            **scatter_columns(study.elasticity, "mm_per_N", 1e3),
        },
        "groups": group_columns(study),
        "errors": error_columns(study),
        "events": event_columns(study),
    }
    return tuple(write_csv(Path(folder) / f"{name}.csv", content) for name, content in tables.items())


def height_columns(study: ToleranceStudy) -> Columns:
    """Return the columns of ``heights.csv``: one row for each dropper."""
    outside = study.outside
    return {
        **_places(study),
        "wanted_height_m": study.wanted_height,
        **scatter_columns(study.height, "above_wanted_mm", 1e3, study.wanted_height),
        "probability_outside": outside.probability,
        "probability_outside_lower": outside.lower,
        "probability_outside_upper": outside.upper,
        "linear_mean_above_wanted_mm": 1e3 * (study.linear_height.mean - study.wanted_height),
        "linear_deviation_mm": 1e3 * study.linear_height.deviation,
    }


def scatter_columns(
    scatter: Scatter, unit: str, factor: float = 1.0, origin: FloatArray | float = 0.0
) -> Columns:
    """Return the columns that say how quantities scatter, in a unit and counted from an origin."""
    of = {
        "nominal": scatter.nominal,
        "mean": scatter.mean,
        "minimum": scatter.minimum,
        **{f"percentile_{level:g}": scatter.percentile[:, i] for i, level in enumerate(LEVELS)},
        "maximum": scatter.maximum,
    }
    columns: Columns = {f"{name}_{unit}": factor * (values - origin) for name, values in of.items()}
    columns[f"deviation_{unit}"] = factor * scatter.deviation
    return columns


def group_columns(study: ToleranceStudy) -> Columns:
    """Return the columns of ``groups.csv``: one row for each group of errors."""
    of = study.importance
    return {
        "group": of.group,
        "errors": of.count,
        "share_of_variance": of.share,
        "first_order_index": of.sampled_share,
        "rank_correlation": of.rank_correlation,
        "probability_of_leaving_without": of.leaving_without,
    }


def error_columns(study: ToleranceStudy) -> Columns:
    """Return the columns of ``errors.csv``: one row for each error, those that matter most first."""
    errors, order = study.errors, np.argsort(-study.errors.share, kind="stable")
    sensitivity = np.where(study.on_contact_wire[:, None], errors.sensitivity, 0.0)
    most = np.abs(sensitivity).argmax(axis=0) if study.on_contact_wire.size else np.zeros(order.size, int)
    return {
        "group": [errors.group[k] for k in order],
        "of": [errors.name[k] for k in order],
        "unit": [errors.unit[k] for k in order],
        "mean": errors.mean[order],
        "deviation": errors.deviation[order],
        "share_of_variance": errors.share[order],
        "largest_sensitivity_m_per_unit": sensitivity[most, np.arange(order.size)][order],
        "at_dropper": [study.height.name[i] for i in most[order]],
    }


def event_columns(study: ToleranceStudy) -> Columns:
    """Return the columns of ``events.csv``: what happened in how many samples."""
    events, count = study.events, len(study.events.name)
    return {
        "event": events.name,
        "samples": np.full(count, study.samples),
        "count": events.count,
        "probability": events.probability,
        "lower_95": events.lower,
        "upper_95": events.upper,
    }


def write_rounding_tables(study: RoundingStudy, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write rounding.csv, a row for each dropper and step, and steps.csv, a row for each step."""
    folder = Path(folder)
    return (
        write_csv(folder / "rounding.csv", rounding_columns(study)),
        write_csv(folder / "steps.csv", step_columns(study)),
    )


def rounding_columns(study: RoundingStudy) -> Columns:
    """Return the columns of ``rounding.csv``: one row for each dropper, step after step."""
    many = len(study.rounded)

    def every(field: str) -> list[float]:
        return [value for rounded in study.rounded for value in getattr(rounded, field)]

    return {
        "step_m": np.repeat([rounded.step for rounded in study.rounded], study.span.size),
        "span": np.tile(study.span, many),
        "dropper": np.tile(study.number, many),
        "chainage_m": np.tile(study.chainage, many),
        "cut_length_m": np.tile(study.cut_length, many),
        "rounded_cut_length_m": every("cut_length"),
        "change_error_m": every("change"),
        "height_m": every("height"),
        "height_change_error_m": every("height_change"),
        "height_error_m": every("height_error"),
        "force_N": every("force"),
    }


def step_columns(study: RoundingStudy) -> Columns:
    """Return the columns of ``steps.csv``: one row for each step."""
    own = study.on_contact_wire

    def each(field: str) -> list[float]:
        return [float(np.abs(getattr(rounded, field)[own]).max(initial=0.0)) for rounded in study.rounded]

    return {
        "step_m": [rounded.step for rounded in study.rounded],
        "largest_change_error_m": each("change"),
        "largest_height_change_error_m": each("height_change"),
        "largest_height_error_m": each("height_error"),
        "rms_height_error_m": [_rms(rounded, study) for rounded in study.rounded],
        "least_force_N": [float(rounded.force.min()) for rounded in study.rounded],
    }


def _rms(rounded: RoundedLine, study: RoundingStudy) -> float:
    error = rounded.height_error[study.on_contact_wire]
    return float(np.sqrt(np.mean(error**2))) if error.size else 0.0


def _places(study: ToleranceStudy) -> Columns:
    return {"span": study.span, "dropper": study.number, "chainage_m": study.chainage}
