"""The tables of a study of elasticity."""

from __future__ import annotations

import os
from pathlib import Path

from catenaria.report.columns import Columns
from catenaria.report.tables import write_csv
from catenaria.results.elasticity import ElasticityStudy

HAND_FACTORS = (
    3.5,
    4.0,
)  # k of the hand formula: simple lines, and those with stitch wires (Kiessling et al.)


def point_columns(study: ElasticityStudy) -> Columns:
    """Return the columns of ``elasticity.csv``: one row for each point."""
    points = study.points
    return {
        "chainage_m": points.chainage,
        "span": points.span,
        "place": points.place,
        "elasticity_mm_per_N": 1e3 * points.elasticity,
        "uplift_mm": 1e3 * study.force * points.elasticity,
        "slack_droppers": points.slack,
    }


def span_columns(study: ElasticityStudy) -> Columns:
    """Return the columns of ``spans.csv``: one row for each whole span."""
    spans = study.spans
    columns: Columns = {
        "span": spans.span,
        "start_m": spans.start,
        "end_m": spans.end,
        "largest_mm_per_N": 1e3 * spans.largest,
        "largest_chainage_m": spans.largest_chainage,
        "smallest_mm_per_N": 1e3 * spans.smallest,
        "smallest_chainage_m": spans.smallest_chainage,
        "at_start_mm_per_N": 1e3 * spans.at_start,
        "mid_span_mm_per_N": 1e3 * spans.at_middle,
        "at_end_mm_per_N": 1e3 * spans.at_end,
        "nonuniformity": spans.nonuniformity,
        "tension_N": spans.tension,
        "inner": spans.inner,
    }
    for k in HAND_FACTORS:
        columns[f"by_hand_k_{k:g}_mm_per_N"] = 1e3 * spans.textbook(k)
    return columns


def comparison_columns(study: ElasticityStudy) -> Columns:
    """Return the columns of ``comparison.csv``: the linearised line beside the nonlinear one."""
    compared = study.compared
    return {
        "chainage_m": compared.chainage,
        "why": compared.why,
        "linearised_mm_per_N": 1e3 * compared.linearised,
        "nonlinear_mm_per_N": 1e3 * compared.nonlinear,
        "error": compared.error,
        "linearised_slack_droppers": compared.linearised_slack,
        "nonlinear_slack_droppers": compared.nonlinear_slack,
        "same_slack": compared.same_slack,
    }


def write_elasticity_tables(study: ElasticityStudy, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write the tables that have rows as CSV files.

    Parameters
    ----------
    study : ElasticityStudy
        The study.
    folder : path
        An existing folder.
    """
    contents = {
        "elasticity": point_columns(study),
        "spans": span_columns(study),
        "comparison": comparison_columns(study),
    }
    return tuple(
        write_csv(Path(folder) / f"{name}.csv", content)
        for name, content in contents.items()
        if len(next(iter(content.values())))
    )
