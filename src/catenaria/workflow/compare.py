"""Methods side by side on one line."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

from catenaria.audit import audit_result
from catenaria.errors import CatenariaError, UnsupportedError
from catenaria.line import Line, load_line, refuse_for_method
from catenaria.mechanics.kernels.warm_up import warm_up
from catenaria.report.differences import Differences, differences, write_differences
from catenaria.results import files_of, replace_folder
from catenaria.results.form import FormResult
from catenaria.workflow.methods import METHODS, NEGLECTS, SPATIAL

REFERENCE = "direct"

_AGAIN = 0.5  # s: what is faster than this is timed a second time, warm


@dataclass(frozen=True)
class Compared:
    """What one method found.

    Attributes
    ----------
    method, neglects : str
        Its name, and what it neglects.
    result : FormResult or None
        With its audit; None if the method failed.
    differences : Differences or None
        From the result of the direct method.
    iterations : int
        Of all its steps.
    time : float
        Wall time of the method alone, warm, without its audit [s].
    failure : str
        Why there is no result; empty if there is one.
    refused : bool
        Whether the method said that it cannot do what the line asks for.
    """

    method: str
    neglects: str
    result: FormResult | None
    differences: Differences | None
    iterations: int
    time: float
    failure: str = ""
    refused: bool = False


def compare(
    line: Line | str | Path,
    methods: Sequence[str] | None = None,
    progress: Callable[[str], None] | None = None,
) -> tuple[Compared, ...]:
    """Find the form of a line by several methods.

    Parameters
    ----------
    line : Line or path
        The line, or the file that describes it.
    methods : sequence of str, optional
        Names; all that solve such lines if left out: for a line beyond the plane, `SPATIAL`. The direct
        method, to which all are compared, is always the first.
    progress : callable, optional
        Is told the name of the method that begins.

    Returns
    -------
    tuple of Compared
        In the order of the names. What a method refuses or does not find is told in its entry.

    Raises
    ------
    LineFileError
        If the file cannot be used.
    UnsupportedError
        If there is no such method, or no method can do what the line asks for.
    CatenariaError
        If the direct method fails.
    """
    for name in methods or ():
        if name not in METHODS:
            raise UnsupportedError(f"there is no method {name!r}; there is {', '.join(METHODS)}")
    if not isinstance(line, Line):
        line = load_line(line)
    every = tuple(METHODS) if line.plane else SPATIAL
    chosen = every if methods is None else (REFERENCE, *methods)
    refuse_for_method(line, REFERENCE, spatial=True)
    warm_up()
    compared: list[Compared] = []
    reference: FormResult | None = None
    for name in dict.fromkeys(chosen):
        if progress is not None:
            progress(name)
        compared.append(_run(line, name, reference))
        reference = reference or compared[0].result
    return tuple(compared)


def _run(line: Line, name: str, reference: FormResult | None) -> Compared:
    """Run one method; the first one is the reference and must not fail."""
    try:
        refuse_for_method(line, name, spatial=name in SPATIAL)
        result, time = _timed(line, name)
        result = replace(result, audit=audit_result(result))
    except CatenariaError as error:
        if reference is None:
            raise
        refused = isinstance(error, UnsupportedError)
        return Compared(name, NEGLECTS[name], None, None, 0, 0.0, str(error), refused)
    difference = differences(result, reference or result)
    iterations = sum(work.steps for work in result.counters)
    return Compared(name, NEGLECTS[name], result, difference, iterations, time)


def _timed(line: Line, name: str) -> tuple[FormResult, float]:
    """Return what a method finds, and how long that took: the second time, if it is quick."""
    method = METHODS[name](None)
    begin = perf_counter()
    result = method.find_form(line)
    time = perf_counter() - begin
    if time < _AGAIN:
        begin = perf_counter()
        result = method.find_form(line)
        time = perf_counter() - begin
    return result, time


def write_comparison(
    compared: Sequence[Compared], folder: str | os.PathLike[str], figures: bool = True
) -> tuple[Path, ...]:
    """Write the differences of methods into a folder, all of it or nothing.

    Parameters
    ----------
    compared : sequence of Compared
        The reference first.
    folder : path
        Where to; an earlier comparison in it is replaced, anything else is not touched.
    figures : bool
        Whether to draw the figure.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    InconsistentInputError
        If the folder holds something that this function did not write.
    """
    reference = compared[0]
    found = {each.method: each.differences for each in compared[1:] if each.differences is not None}
    with replace_folder(folder) as new:
        write_differences(found, new / "differences.csv")
        if figures:
            from catenaria.report import style  # slow to import
            from catenaria.report.difference_figure import differences_figure

            name = reference.result.name if reference.result else ""
            figure = differences_figure(name, reference.method, found)
            style.save(figure, new / "differences.png")
    return files_of(folder)
