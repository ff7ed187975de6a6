"""The direct method in space: the whole line at once, with all targets as equations."""

from __future__ import annotations

from time import perf_counter

from catenaria.discretise.spatial.lay_out import lay_out
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.spatial.at_rest import find_line_at_rest
from catenaria.formfinding.spatial.gather import gather
from catenaria.line import Line
from catenaria.results.form import FormResult


def find_directly(line: Line, listener: Listener | None, start: FormResult | None = None) -> FormResult:
    """Find the form of a line in space by Newton's method.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    listener : callable or None
        Is told which stage begins.
    start : FormResult, optional
        An earlier result to begin from instead of taut strings.

    Raises
    ------
    NotConvergedError, InfeasibleError, SingularError, InconsistentInputError
        See `catenaria.formfinding.direct.Direct.find_form`.
    """
    begin = perf_counter()
    if listener is not None:
        listener(Progress("line", 1, 2))
    found = find_line_at_rest(lay_out(line), start)
    if listener is not None:
        listener(Progress("lengths", 2, 2, elapsed=perf_counter() - begin))
    reason = f"Newton's method converged in {found.work.steps} iterations{found.how}"
    return gather(line, found.model, found.z, "direct", reason, (found.work,))
