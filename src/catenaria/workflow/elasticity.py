"""From a found line to its elasticity."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from catenaria.line import Line
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.elasticity import Wanted, elasticity_of
from catenaria.report.elasticity_tables import write_elasticity_tables
from catenaria.results import FormResult, files_of, replace_folder, save_result
from catenaria.results.elasticity import ElasticityStudy
from catenaria.workflow.found import found

ElasticityListener = Callable[[str, int, int], None]


def elasticity(
    source: FormResult | Line | str | os.PathLike[str],
    force: float = 100.0,
    spacing: float = 0.5,
    *,
    nonlinear: bool = False,
    start: float | None = None,
    end: float | None = None,
    elasticity_limit: float | None = None,
    nonuniformity_limit: float | None = None,
    progress: ElasticityListener | None = None,
) -> ElasticityStudy:
    """Return how far the contact wire of a found line rises where a static force pushes it.

    Parameters
    ----------
    source : FormResult, Line or path
        What was found, the folder in which it was written, or a line or its file, which is solved first.
    force : float
        Force on all contact wires together [N]; 0 for the limit of a small force.
    spacing : float
        Of the points [m]; supports, droppers and middles of spans are added.
    nonlinear : bool
        Whether to solve every point with all nonlinearities, instead of with geometry linearised about the
        line at rest and droppers that go slack.
    start, end : float, optional
        First and last chainage [m]; by default the first and the last support of the contact wire.
    elasticity_limit, nonuniformity_limit : float, optional
        What they may be [m/N], [-].
    progress : callable, optional
        Receives what is done, how many points of it are done, and of how many.

    Raises
    ------
    LineFileError, InconsistentInputError, UnsupportedError
        If a file cannot be used, force or points make no sense, or the result has no nodes.
    NotConvergedError, InfeasibleError
        If the line does not come to rest.
    """
    wanted = Wanted(
        force,
        spacing,
        nonlinear,
        start,
        end,
        () if elasticity_limit is None else (elasticity_limit,),
        () if nonuniformity_limit is None else (nonuniformity_limit,),
    )
    return elasticity_as(source, wanted, progress)


def elasticity_as(
    source: FormResult | Line | str | os.PathLike[str],
    wanted: Wanted,
    progress: ElasticityListener | None = None,
) -> ElasticityStudy:
    """Return the elasticity of a found line as it is wanted; see `elasticity`."""
    line, result = found(source)
    return elasticity_of(BuiltLine.of(line, result), wanted, progress)


def write_elasticity(
    study: ElasticityStudy, folder: str | os.PathLike[str], figures: bool = True
) -> tuple[Path, ...]:
    """Write a study of elasticity with its tables and its figure into a folder, all of it or nothing.

    Parameters
    ----------
    study : ElasticityStudy
        The study.
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
        write_elasticity_tables(study, new)
        if figures:
            from catenaria.report import elasticity_figure, style  # slow to import

            style.save(elasticity_figure.elasticity_figure(study), new / "elasticity.png")
    return files_of(folder)
