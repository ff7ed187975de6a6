"""The dynamic method with a film of what moves."""

from __future__ import annotations

from catenaria.errors import InconsistentInputError
from catenaria.formfinding.dynamic_equilibrium import DynamicEquilibrium
from catenaria.formfinding.progress import Listener
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.results.film import Film


def replay(
    line: Line, progress: Listener | None = None, frames: int = 100
) -> tuple[FormResult, tuple[Film, ...]]:
    """Move a line from where it rests without weight to equilibrium, and film it.

    Parameters
    ----------
    line : Line
        Any line with two or more wires.
    progress : callable, optional
        Receives a `Progress` after every time step.
    frames : int
        How many states each film has at most, two at least.

    Returns
    -------
    result : FormResult
        Without audit and rebuild.
    films : tuple of Film
        Of a line in the plane one of the contact wire, then one of the messenger wire; of a line in space one
        of all wires, and another one each time that other droppers hang slack.

    Raises
    ------
    InconsistentInputError
        If there shall be fewer than two states.
    NotConvergedError
        If it does not come to rest.

    Examples
    --------
    >>> from catenaria.line import load_line
    >>> _, films = replay(load_line("examples/yang2017_three_span.yaml"), frames=5)
    >>> [(film.step, film.time.size) for film in films]
    [('contact wire', 5), ('messenger wire', 5)]
    """
    if frames < 2:
        raise InconsistentInputError(f"a film has the first and the last state at least: 2, not {frames}")
    films: list[Film] = []
    result = DynamicEquilibrium(progress, films.append, frames).find_form(line)
    return result, tuple(films)
