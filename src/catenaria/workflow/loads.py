"""From a found line and load cases to what becomes of it."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from catenaria.line import Line
from catenaria.line.load_case import LoadCases, load_cases
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.case import solve_case
from catenaria.loading.check_case import check_cases
from catenaria.loading.read_case import line_state
from catenaria.report.case_tables import write_case_tables
from catenaria.results import FormResult, files_of, replace_folder, save_result
from catenaria.results.case import CaseResult, LoadStudy
from catenaria.workflow.found import found

CaseListener = Callable[[str, int, int], None]


def under_loads(
    source: FormResult | Line | str | os.PathLike[str],
    cases: LoadCases | str | os.PathLike[str],
    progress: CaseListener | None = None,
) -> LoadStudy:
    """Return a found line, built with the lengths that were found, under load cases.

    Parameters
    ----------
    source : FormResult, Line or path
        What was found, the folder in which it was written, or a line or its file, which is solved first.
    cases : LoadCases or path
        The cases, or the file that describes them.
    progress : callable, optional
        Receives the name, number and count before each case.

    Returns
    -------
    LoadStudy

    Raises
    ------
    LineFileError, InconsistentInputError
        If a file cannot be used, or a case names what the line does not have.
    UnsupportedError
        If the result comes from a method without nodes.
    NotConvergedError, InfeasibleError
        If the line does not come to rest under a case; the message names it.
    """
    if not isinstance(cases, LoadCases):
        cases = load_cases(Path(cases))
    line, result = found(source)
    check_cases(cases, result)
    built = BuiltLine.of(line, result)
    before = line_state(line, built.at_rest, np.zeros(built.model.length.size, dtype=np.bool_))
    solved: list[CaseResult] = []
    for number, (name, case) in enumerate(cases.cases.items(), start=1):
        if progress is not None:
            progress(name, number, len(cases.cases))
        solved.append(solve_case(built, name, case, before))
    return LoadStudy(
        line=result.name,
        method=result.method,
        reference_temperature=line.reference_temperature,
        expansion=built.expansion,
        before=before,
        cases=tuple(solved),
        inputs=result.inputs,
    )


def write_loads(study: LoadStudy, folder: str | os.PathLike[str], figures: bool = True) -> tuple[Path, ...]:
    """Write a study of load cases with its tables and figures into a folder, all of it or nothing.

    Parameters
    ----------
    study : LoadStudy
        The cases.
    folder : path
        Where to; an earlier study in it is replaced, anything else is not touched.
    figures : bool
        Whether to draw figures.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    InconsistentInputError
        If the folder holds something that was not written by catenaria.
    """
    with replace_folder(folder) as new:
        save_result(study, new)
        write_case_tables(study, new)
        if figures:
            from catenaria.report.case_figures import write_case_figures  # slow to import

            write_case_figures(study, new)
    return files_of(folder)
