"""From a found line and errors of its installation to how it scatters."""

from __future__ import annotations

import os
from pathlib import Path

from catenaria.line import Line
from catenaria.line.installation import Installation, usual_installation
from catenaria.line.load_installation import load_installation
from catenaria.loading.samples import Tell
from catenaria.loading.tolerance import Options, study_tolerances, with_seed
from catenaria.mechanics.kernels.warm_up import warm_up
from catenaria.report.tolerance_tables import write_tolerance_tables
from catenaria.results import FormResult, files_of, replace_folder, save_result
from catenaria.results.tolerance import ToleranceStudy
from catenaria.workflow.found import found


def tolerances(
    source: FormResult | Line | str | os.PathLike[str],
    errors: Installation | str | os.PathLike[str] | None = None,
    options: Options | None = None,
    seed: int | None = None,
    progress: Tell = lambda done, of: None,
) -> ToleranceStudy:
    """Return how a line scatters under errors of its installation.

    Parameters
    ----------
    source : FormResult, Line or path
        What was found, the folder in which it was written, or a line or its file, which is solved first.
    errors : Installation or path, optional
        The errors, or the file that describes them. If left out, those of the line's section `installation`;
        if it has none, those of `usual_installation`.
    options : Options, optional
        How many samples, and how.
    seed : int, optional
        Instead of that of the errors.
    progress : callable
        Is told how many samples are done, and of how many.

    Raises
    ------
    LineFileError, InconsistentInputError
        If a file cannot be used, or errors are those of something that the line does not have.
    UnsupportedError
        If the result comes from a method without nodes.
    NotConvergedError, InfeasibleError
        If the line is not found or does not rest where it was found, or if no sample comes to rest.
    """
    line, result = found(source)
    warm_up()
    if errors is None:
        errors = line.installation or usual_installation()
    elif not isinstance(errors, Installation):
        errors = load_installation(Path(errors), line)
    return study_tolerances(line, result, with_seed(errors, seed), options or Options(), progress)


def write_tolerances(
    study: ToleranceStudy, folder: str | os.PathLike[str], figures: bool = True
) -> tuple[Path, ...]:
    """Write a tolerance study with its tables and figures into a folder, all of it or nothing.

    Parameters
    ----------
    study : ToleranceStudy
        The study.
    folder : path
        Where to; an earlier study in it is replaced, anything else is not touched.
    figures : bool
        Whether to draw figures.

    Raises
    ------
    InconsistentInputError
        If the folder holds something that was not written by catenaria.
    """
    with replace_folder(folder) as new:
        save_result(study, new)
        write_tolerance_tables(study, new)
        if figures:
            from catenaria.report.tolerance_figures import write_tolerance_figures  # slow to import

            write_tolerance_figures(study, new / "figures")
    return files_of(folder)
