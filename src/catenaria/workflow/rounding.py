"""From a found line to the same line with rounded dropper lengths."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from catenaria.line import Line
from catenaria.loading.rounding import round_droppers
from catenaria.report.tolerance_tables import write_rounding_tables
from catenaria.results import FormResult, files_of, replace_folder, save_result
from catenaria.results.rounding import RoundingStudy
from catenaria.workflow.found import found


def rounding(source: FormResult | Line | str | os.PathLike[str], steps: Sequence[float]) -> RoundingStudy:
    """Return a found line at rest with dropper lengths rounded to some steps.

    Parameters
    ----------
    source : FormResult, Line or path
        What was found, the folder in which it was written, or a line or its file, which is solved first.
    steps : sequence of float
        Steps [m].

    Raises
    ------
    LineFileError, InconsistentInputError, UnsupportedError
        If a file cannot be used, a step is not positive, or the result comes from a method without nodes.
    NotConvergedError, InfeasibleError
        If the line does not come to rest.
    """
    return round_droppers(*found(source), steps)


def write_rounding(
    study: RoundingStudy, folder: str | os.PathLike[str], figures: bool = True
) -> tuple[Path, ...]:
    """Write rounded lengths with tables and a figure into a folder, all of it or nothing.

    Parameters
    ----------
    study : RoundingStudy
        The lengths and what follows from them.
    folder : path
        Where to; an earlier study in it is replaced, anything else is not touched.
    figures : bool
        Whether to draw the figure.

    Raises
    ------
    InconsistentInputError
        If the folder holds something that was not written by catenaria.
    """
    with replace_folder(folder) as new:
        save_result(study, new)
        write_rounding_tables(study, new)
        if figures:
            from catenaria.report import style, tolerance_figures  # slow to import

            style.save(tolerance_figures.rounding_figure(study), new / "rounding.png")
    return files_of(folder)
