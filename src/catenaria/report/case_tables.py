"""The tables of load cases, as CSV files."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from catenaria.report import case_columns
from catenaria.report.columns import Columns
from catenaria.report.tables import write_csv
from catenaria.results.case import CaseResult, LoadStudy

CASE_TABLES: dict[str, Callable[[LoadStudy, CaseResult], Columns]] = {
    "droppers": case_columns.dropper_columns,
    "wires": case_columns.wire_columns,
    "supports": case_columns.support_columns,
    "arms": case_columns.arm_columns,
    "spans": case_columns.span_columns,
    "blow_off": case_columns.blow_off_columns,
    "pushes": case_columns.push_columns,
    "configuration": case_columns.configuration_columns,
}


def write_case_tables(study: LoadStudy, folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write ``cases.csv``, and the tables of every case that have rows into a folder of its name.

    Parameters
    ----------
    study : LoadStudy
        The cases.
    folder : path
        An existing folder.

    Returns
    -------
    tuple of Path
        The files.
    """
    folder = Path(folder)
    files = [write_csv(folder / "cases.csv", case_columns.case_columns(study))]
    for case in study.cases:
        own = folder / case.name
        own.mkdir()
        for name, build in CASE_TABLES.items():
            content = build(study, case)
            if len(next(iter(content.values()))):
                files.append(write_csv(own / f"{name}.csv", content))
    return tuple(files)
