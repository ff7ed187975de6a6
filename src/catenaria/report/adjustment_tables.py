"""The tables of an adjustment of dropper lengths."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from catenaria.report.columns import Columns
from catenaria.report.tables import write_csv
from catenaria.results.adjustment import Adjustment

_DIGITS = 6  # of changes in millimetres, which are whole steps


def adjust_columns(study: Adjustment) -> Columns:
    """Return the columns of ``adjust.csv``: one row for each dropper that is to be adjusted."""
    droppers, only = study.droppers, study.droppers.adjusted
    change = np.round(1e3 * droppers.change[only], _DIGITS)
    return {
        "span": droppers.span[only],
        "dropper": droppers.number[only],
        "chainage_m": droppers.chainage[only],
        "action": ["lengthen" if longer else "shorten" for longer in change > 0.0],
        "change_mm": change,
        "new_length_m": droppers.new_length[only],
        "new_cut_length_m": droppers.new_cut_length[only],
        "slack_before": droppers.slack_before[only],
        "height_before_m": droppers.height_before[only],
        "height_after_m": droppers.height_after[only],
        "wanted_height_m": droppers.wanted_height[only],
        "force_before_N": droppers.force_before[only],
        "force_after_N": droppers.force_after[only],
        "upper_wire": _of(droppers.upper_wire, only),
        "lower_wire": _of(droppers.lower_wire, only),
    }


def height_columns(study: Adjustment) -> Columns:
    """Return the columns of ``heights.csv``: one row for each dropper."""
    droppers = study.droppers
    return {
        "span": droppers.span,
        "dropper": droppers.number,
        "chainage_m": droppers.chainage,
        "wanted_height_m": droppers.wanted_height,
        "height_before_m": droppers.height_before,
        "before_error_m": droppers.height_before - droppers.wanted_height,
        "height_after_m": droppers.height_after,
        "after_error_m": droppers.height_after - droppers.wanted_height,
        "linear_error_m": droppers.height_predicted - droppers.height_after,
        "force_before_N": droppers.force_before,
        "force_after_N": droppers.force_after,
        "scheduled_length_m": droppers.scheduled_length,
        "present_length_m": droppers.present_length,
        "change_mm": np.round(1e3 * droppers.change, _DIGITS),
        "new_length_m": droppers.new_length,
        "checked": droppers.checked,
        "lower_wire": droppers.lower_wire,
    }


def measured_columns(study: Adjustment) -> Columns:
    """Return the columns of ``measured.csv``: one row for each measured height."""
    points = study.points
    return {
        "wire": points.wire,
        "span": [str(span) if span else "" for span in points.span.tolist()],
        "dropper": [str(number) if number else "" for number in points.number.tolist()],
        "chainage_m": points.chainage,
        "height_m": points.height,
        "explained_height_m": points.explained,
        "unexplained_error_m": points.height - points.explained,
    }


def write_adjustment_tables(study: Adjustment, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write all tables as CSV files; ``adjust.csv`` has no rows if nothing is to be done.

    Parameters
    ----------
    study : Adjustment
        What is to be done.
    folder : path
        An existing folder.

    Returns
    -------
    tuple of Path
        The files.
    """
    contents = {
        "adjust": adjust_columns(study),
        "heights": height_columns(study),
        "measured": measured_columns(study),
    }
    return tuple(write_csv(Path(folder) / f"{name}.csv", content) for name, content in contents.items())


def _of(names: tuple[str, ...], only: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> list[str]:
    return [name for name, taken in zip(names, only.tolist(), strict=True) if taken]
