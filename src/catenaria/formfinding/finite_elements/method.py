"""The frame in which an objective over the finite elements is a form-finding method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

from catenaria.formfinding.finite_elements.found import Found
from catenaria.formfinding.finite_elements.read_back import element_result
from catenaria.formfinding.finite_elements.wire import refuse_beyond_core
from catenaria.formfinding.progress import Listener, Progress
from catenaria.line import Line
from catenaria.results.form import FormResult

Search = Callable[[Line, FormResult | None], Found]


@dataclass(frozen=True)
class ElementMethod:
    """A form-finding method for wires of tensioned beams.

    Parameters
    ----------
    name : str
        Name of the method.
    neglects : str
        What it neglects, in words.
    search : callable
        Finds the form.
    listener : callable, optional
        Is told that the computation begins.
    """

    name: str
    neglects: str
    search: Search
    listener: Listener | None = None

    def find_form(self, line: Line, start: FormResult | None = None) -> FormResult:
        """Find the form of a line.

        Parameters
        ----------
        line : Line
            What the engineer describes.
        start : FormResult, optional
            An earlier result, of any method, to begin from.

        Raises
        ------
        UnsupportedError
            If the line asks for what these elements cannot do.
        InfeasibleError
            If the schedule cannot be built.
        NotConvergedError
            If iterations do not end.
        """
        if self.listener is not None:
            self.listener(Progress("both wires", 1, 1))
        refuse_beyond_core(line, self.name)
        begin = perf_counter()
        found = self.search(line, start)
        return element_result(line, self.name, found, perf_counter() - begin)
