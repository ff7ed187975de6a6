"""From a line, or the file that describes it, to a result."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from catenaria.audit import audit_result
from catenaria.errors import UnsupportedError
from catenaria.formfinding.direct import Direct
from catenaria.formfinding.dynamic_equilibrium import DynamicEquilibrium
from catenaria.formfinding.progress import Listener, Progress
from catenaria.line import Line, load_line, refuse_unsupported
from catenaria.mechanics.kernels.warm_up import need_compiling, warm_up
from catenaria.results.form import FormResult

METHODS = {"direct": Direct, "dynamic": DynamicEquilibrium}


def solve(
    line: Line | str | Path,
    method: str = "direct",
    start: FormResult | None = None,
    progress: Listener | None = None,
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

    Returns
    -------
    FormResult
        With the outcome of its audit.

    Raises
    ------
    LineFileError
        If the file cannot be used; the error lists every fault with its place.
    UnsupportedError
        If the method does not exist or cannot do what the line asks for.
    NotConvergedError
        If the computation does not come to rest.
    """
    if method not in METHODS:
        raise UnsupportedError(f"there is no method {method!r}; there is {', '.join(METHODS)}")
    if not isinstance(line, Line):
        line = load_line(line)
    refuse_unsupported(line)
    if progress is not None and need_compiling():
        progress(Progress("compiling", 1, 3))
        warm_up()
    result = METHODS[method](progress).find_form(line, start)
    return replace(result, audit=audit_result(result))
