"""From a found line and measured heights to corrected dropper lengths."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from catenaria.line import Line
from catenaria.line.measured import MeasuredHeights, load_measured
from catenaria.loading import adjust as adjusting
from catenaria.loading.adjustment_limits import AdjustmentLimits
from catenaria.loading.built_line import BuiltLine
from catenaria.report.adjustment_tables import write_adjustment_tables
from catenaria.results import FormResult, files_of, load_result, replace_folder, save_result
from catenaria.results.adjustment import Adjustment


def adjust(
    result: FormResult | str | os.PathLike[str],
    measured: MeasuredHeights | str | os.PathLike[str],
    limits: AdjustmentLimits | None = None,
    progress: Callable[[str], None] | None = None,
) -> Adjustment:
    """Return which droppers of a built line to adjust, and by how much.

    Parameters
    ----------
    result : FormResult or path
        What was found before the line was built, or the folder in which it was written.
    measured : MeasuredHeights or path
        Heights of the contact wire as built, or the CSV file with them.
    limits : AdjustmentLimits, optional
        What is to be reached: 5 mm in steps of 5 mm by default.
    progress : callable, optional
        Is told what is being done.

    Raises
    ------
    LineFileError, InconsistentInputError
        If a file cannot be used, or a height is measured of nothing that the line has.
    InfeasibleError
        If the heights cannot be reached like that; the message says what would do.
    NotConvergedError
        If no lengths explain what was measured.
    UnsupportedError
        If the result comes from a method without nodes, or has slack droppers.
    """
    if not isinstance(result, FormResult):
        result = load_result(result)
    if not isinstance(measured, MeasuredHeights):
        measured = load_measured(Path(measured))
    line = Line.model_validate(result.inputs)
    return adjusting.adjust(BuiltLine.of(line, result), measured, limits or AdjustmentLimits(), progress)


def write_adjustment(
    study: Adjustment, folder: str | os.PathLike[str], figures: bool = True
) -> tuple[Path, ...]:
    """Write an adjustment with tables and a figure into a folder, all of it or nothing.

    Parameters
    ----------
    study : Adjustment
        What is to be done.
    folder : path
        Where to; an earlier adjustment in it is replaced, anything else is not touched.
    figures : bool
        Whether to draw the figure.

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
        write_adjustment_tables(study, new)
        if figures:
            from catenaria.report import adjustment_figure, style  # slow to import

            style.save(adjustment_figure.adjustment_figure(study), new / "adjust.png")
    return files_of(folder)
