"""The dynamic method with a film of what moves."""

from __future__ import annotations

from catenaria.errors import UnsupportedError
from catenaria.formfinding.dynamic_equilibrium import DynamicEquilibrium
from catenaria.formfinding.progress import Listener
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.results.film import Film


def replay(
    line: Line, progress: Listener | None = None, frames: int = 100
) -> tuple[FormResult, tuple[Film, ...]]:
    """Move a line from its straight start to equilibrium, and film it.

    Parameters
    ----------
    line : Line
        In one plane, with two wires.
    progress : callable, optional
        Receives a `Progress` after every time step.
    frames : int
        How many states each film has at most.

    Returns
    -------
    result : FormResult
        Without audit and rebuild.
    films : tuple of Film
        Of the contact wire, then of the messenger wire.

    Raises
    ------
    UnsupportedError
        If the line does not lie in a plane.
    NotConvergedError
        If it does not come to rest.

    Examples
    --------
    >>> from catenaria.line import load_line
    >>> _, films = replay(load_line("examples/yang2017_three_span.yaml"), frames=5)
    >>> [(film.step, film.time.size) for film in films]
    [('contact wire', 5), ('messenger wire', 5)]
    """
    if not line.plane:
        raise UnsupportedError("a replay is of lines in one plane with two wires: this one lies in space")
    films: list[Film] = []
    result = DynamicEquilibrium(progress, films.append, frames).find_form(line)
    return result, tuple(films)
