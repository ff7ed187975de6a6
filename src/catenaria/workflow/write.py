"""From a result to a folder of files."""

from __future__ import annotations

import os
from pathlib import Path

from catenaria.report.tables import write_tables
from catenaria.results import FormResult, files_of, replace_folder, save_result
from catenaria.workflow.elasticity import ElasticityListener
from catenaria.workflow.report import report as page_of

REPORT_NAME = "report.html"


def write(
    result: FormResult,
    folder: str | os.PathLike[str],
    figures: bool = True,
    report: bool = False,
    progress: ElasticityListener | None = None,
) -> tuple[Path, ...]:
    """Write a result with its tables and figures into a folder, all of it or nothing.

    Parameters
    ----------
    result : FormResult
        What was found.
    folder : path
        Where to; an earlier result in it is replaced, anything else is not touched.
    figures : bool
        Whether to draw figures.
    report : bool
        Whether to write ``report.html`` as well, with the elasticity of the result.
    progress : callable, optional
        Receives what is done for that elasticity, how many points of it are done, and of how many.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    InconsistentInputError
        If the folder holds something that is not an earlier result.
    """
    with replace_folder(folder) as new:
        fill(result, new, figures)
        if report:
            (new / REPORT_NAME).write_text(page_of(result, progress=progress), encoding="utf-8")
    return files_of(folder)


def fill(result: FormResult, folder: Path, figures: bool) -> None:
    """Write a result with its tables and figures into a folder that is nobody else's."""
    save_result(result, folder)
    write_tables(result, folder)
    if figures:
        from catenaria.report.figures import write_figures  # slow to import

        write_figures(result, folder / "figures")
