"""The frame in which a formulation of strings is a form-finding method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import NamedTuple

from catenaria.errors import UnsupportedError
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.read_back import form_result
from catenaria.formfinding.strings.task import StringLine, string_line
from catenaria.line import Line
from catenaria.results.form import Counters, FormResult


class Solved(NamedTuple):
    """Strings at rest, and for both wires together iterations and unknowns."""

    found: LineAtRest
    iterations: int
    unknowns: int


@dataclass(frozen=True)
class StringMethod:
    """A form-finding method for wires without bending stiffness.

    Parameters
    ----------
    name : str
        Name of the method.
    neglects : str
        What it neglects, in words.
    solve : callable
        Finds strings at rest.
    listener : callable, optional
        Is told that the computation begins.
    """

    name: str
    neglects: str
    solve: Callable[[StringLine], Solved]
    listener: Listener | None = None

    def find_form(self, line: Line, start: FormResult | None = None) -> FormResult:
        """Find the form of a line of strings.

        Parameters
        ----------
        line : Line
            What the engineer describes.
        start : None
            These methods begin from nothing.

        Raises
        ------
        UnsupportedError
            If the line asks for what strings cannot do, or an earlier result is given.
        InfeasibleError
            If the schedule cannot be built.
        NotConvergedError
            If iterations do not end.
        """
        if start is not None:
            raise UnsupportedError(f"the method {self.name!r} does not begin from an earlier result")
        if self.listener is not None:
            self.listener(Progress("both wires", 1, 1))
        task = string_line(line, self.name)
        begin = perf_counter()
        found, iterations, unknowns = self.solve(task)
        wall = perf_counter() - begin
        work = Counters("both wires", 0.0, wall, iterations, 0, 0, 0, 0, 0, unknowns)
        reason = f"the equations hold to rounding after {iterations} iterations"
        return form_result(line, task, self.name, reason, found, (work,))
