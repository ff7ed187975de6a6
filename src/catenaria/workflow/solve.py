"""From a line, or the file that describes it, to a result."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Literal, get_args

from catenaria.audit import audit_result
from catenaria.errors import NotConvergedError, UnsupportedError
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.rebuild import Way
from catenaria.formfinding.rebuild import rebuild as rebuild_line
from catenaria.line import Line, Mesh, load_line, refuse_for_method, with_mesh
from catenaria.mechanics.kernels.warm_up import need_compiling, warm_up
from catenaria.results.form import FormResult
from catenaria.workflow.methods import METHODS, SPATIAL

Rebuild = Literal["static", "relaxation", "none"]
REBUILT = ("direct", "dynamic")


def solve(
    line: Line | str | Path,
    method: str = "direct",
    start: FormResult | None = None,
    progress: Listener | None = None,
    rebuild: Rebuild = "static",
    mesh: Mesh | None = None,
) -> FormResult:
    """Find the form of an overhead contact line.

    Parameters
    ----------
    line : Line or path
        The line, or the YAML or JSON file that describes it.
    method : str
        Name of the method; one of `METHODS`.
    start : FormResult, optional
        An earlier result of the same line to begin from.
    progress : callable, optional
        Receives a `Progress` after every time step.
    rebuild : {"static", "relaxation", "none"}
        Whether a line is built from the found lengths, and how it is brought to rest. The line that is built
        has wires as in `mechanics`; results with other wires than these have no rebuild.
    mesh : Mesh, optional
        The fields that are given in it replace those of the line, as in `Mesh(refine=2)`.

    Returns
    -------
    FormResult
        With the outcome of its audit and of its rebuild.

    Raises
    ------
    LineFileError
        If the file cannot be used; the error lists every fault with its place.
    UnsupportedError
        If the method does not exist or cannot do what the line asks for.
    NotConvergedError
        If the computation or the rebuilt line does not come to rest; in the latter case, `partial` is the
        result without a rebuild.
    """
    refuse_choice(method, rebuild)
    begin = perf_counter()
    if not isinstance(line, Line):
        line = load_line(line)
    if mesh is not None:
        line = with_mesh(line, mesh)
    result = audited(find(line, method, start, progress))
    if rebuild == "none" or result.physics != "bending":
        return result
    if progress is not None:
        progress(Progress("rebuild", 3, 3, elapsed=perf_counter() - begin))
    return _rebuilt(line, result, rebuild)


def find(
    line: Line, method: str = "direct", start: FormResult | None = None, progress: Listener | None = None
) -> FormResult:
    """Find the form of a line, and no more, for those who cannot wait for the audit that `solve` adds.

    Parameters
    ----------
    line : Line
        The line.
    method, start, progress
        As of `solve`.

    Returns
    -------
    FormResult
        Without audit and rebuild.

    Raises
    ------
    UnsupportedError, NotConvergedError
        As `solve`.
    """
    refuse_choice(method, "none")
    refuse_for_method(line, method, spatial=method in SPATIAL)
    if progress is not None and need_compiling():
        progress(Progress("compiling", 1, 3))
        warm_up()
    return METHODS[method](progress).find_form(line, start)


def audited(result: FormResult) -> FormResult:
    """Return a result with its audit."""
    return replace(result, audit=audit_result(result))


def refuse_choice(method: str, rebuild: str) -> None:
    """Refuse a method or a rebuild that does not exist, or both together.

    Raises
    ------
    UnsupportedError
        With the names that there are.
    """
    if method not in METHODS:
        raise UnsupportedError(f"there is no method {method!r}; there is {', '.join(METHODS)}")
    if rebuild not in get_args(Rebuild):
        raise UnsupportedError(f"there is no rebuild {rebuild!r}; there is {', '.join(get_args(Rebuild))}")
    if rebuild == "relaxation" and method not in REBUILT:
        raise UnsupportedError(f"only forms by {' and '.join(REBUILT)} are rebuilt, not by {method!r}")


def _rebuilt(line: Line, result: FormResult, way: Way) -> FormResult:
    """Return the result with its rebuild; a rebuild that fails hands the result on."""
    try:
        return replace(result, rebuilt=rebuild_line(line, result, way))
    except NotConvergedError as error:
        raise NotConvergedError(error.reason, error.advice, result) from error
