"""The tables of a page about what becomes of a line with rounded lengths and errors of installation."""

from __future__ import annotations

import numpy as np

from catenaria.report.html.table import Table, column
from catenaria.report.tolerance_tables import step_columns
from catenaria.results.rounding import RoundingStudy
from catenaria.results.tolerance import ToleranceStudy

_LEVELS = (50.0, 95.0, 99.0)  # percentiles that are shown [%]


def step_table(study: RoundingStudy) -> Table:
    """Return a row for each step to which droppers are cut."""
    values = {name: np.asarray(of) for name, of in step_columns(study).items()}
    return Table(
        "",
        (
            column("step", "mm", 1e3 * values["step_m"], "g"),
            column("largest change of a length", "mm", 1e3 * values["largest_change_error_m"], ".2f"),
            column("largest height error", "mm", 1e3 * values["largest_height_error_m"], ".2f"),
            column("its root mean square", "mm", 1e3 * values["rms_height_error_m"], ".2f"),
            column("least dropper force", "N", values["least_force_N"], ".1f"),
        ),
    )


def worst_table(study: ToleranceStudy) -> Table:
    """Return how far the contact wire is off where it is farthest off, in shares of all samples."""
    off = 1e3 * np.percentile(study.worst, _LEVELS)
    return Table(
        "",
        (
            column("share of samples", "%", _LEVELS, "g"),
            column("largest deviation from wanted heights up to", "mm", off, ".1f"),
        ),
    )


def group_table(study: ToleranceStudy) -> Table:
    """Return how much each group of errors matters for the heights of the contact wire."""
    groups = study.importance
    return Table(
        "",
        (
            column("errors of", "", groups.group),
            column("number", "", groups.count),
            column("share of the variance", "%", 100.0 * groups.share, ".1f"),
            column("leaves the tolerance without them", "%", 100.0 * groups.leaving_without, ".1f"),
        ),
    )
