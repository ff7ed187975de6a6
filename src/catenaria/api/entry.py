"""The functions with which work begins: from a file or a mapping to a line, and from a line to its result."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from catenaria import workflow
from catenaria.api.result import Result
from catenaria.formfinding.progress import Listener
from catenaria.line import Line, Mesh, load_line
from catenaria.line.load import model_from
from catenaria.results import load_result as load_form
from catenaria.workflow import Rebuild

METHODS: Final = tuple(workflow.METHODS)

LineSource = str | os.PathLike[str] | Mapping[str, Any]


def load(source: LineSource) -> Line:
    """Read and check a line.

    Parameters
    ----------
    source : path or mapping
        A YAML or JSON file, or what would stand in one.

    Returns
    -------
    Line
        With every quantity in SI.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong, in `faults`.
    UnsupportedError
        If it describes a free structure.

    Examples
    --------
    >>> line = load("examples/yang2017_three_span.yaml")
    >>> line.name, line.contact_wire.tension.force
    ('Yang et al. 2017, three spans', 15000.0)
    """
    if isinstance(source, Mapping):
        return model_from(source, Line)
    return load_line(Path(source))


def solve(
    line: Line | LineSource,
    method: str = "direct",
    *,
    start: Result | None = None,
    rebuild: Rebuild = "static",
    mesh: Mesh | None = None,
    progress: Listener | None = None,
) -> Result:
    """Find the form of a line.

    Parameters
    ----------
    line : Line, path or mapping
        The line, or what `load` makes one of.
    method : str
        One of `METHODS`.
    start : Result, optional
        An earlier result of the same line to begin from.
    rebuild : {"static", "relaxation", "none"}
        Whether a line is built from the found lengths, and how it is brought to rest.
    mesh : Mesh, optional
        The fields that are given in it replace those of the line, as in ``Mesh(refine=2)``.
    progress : callable, optional
        Is told how far the computation is, with attributes `step`, `number`, `of` and others.

    Returns
    -------
    Result
        With the outcome of its audit and of its rebuild.

    Raises
    ------
    LineFileError
        If the line cannot be used; the error lists every fault with its place.
    UnsupportedError
        If the method does not exist or cannot do what the line asks for.
    InfeasibleError
        If no equilibrium meets what is wanted.
    NotConvergedError
        If the computation or the rebuilt line does not come to rest.

    Examples
    --------
    >>> solve("examples/yang2017_three_span.yaml", rebuild="none")
    Result: Yang et al. 2017, three spans
      line      3 spans, 195 m, 2 wires, 21 droppers
      method    direct
      wires     contact wire 15000.0 N, messenger wire 15000.0 N
      droppers  0.966 to 1.379 m long, lift 61.7 to 86.3 N, none slack
      errors    height 0.0000 mm, tension 0.00 N
      audit     passed, 51 checks
      rebuild   none
    """
    found = line if isinstance(line, Line) else load(line)
    begin = None if start is None else start.form
    return Result(workflow.solve(found, method, begin, progress, rebuild, mesh))


def load_result(folder: str | os.PathLike[str]) -> Result:
    """Read a result that `Result.save` or ``catenaria solve --out`` wrote.

    Parameters
    ----------
    folder : path
        The folder.

    Returns
    -------
    Result
        Equal to what was saved.

    Raises
    ------
    InconsistentInputError
        If a file is missing, damaged or of another version.
    """
    return Result(load_form(folder))
