"""One wire at rest with its targets met: by Newton's method, or slackened by load steps where that fails."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.restart import stage_of, start_from
from catenaria.discretise.wire_model import WireModel
from catenaria.discretise.wire_setup import WireSetup
from catenaria.errors import (
    CatenariaError,
    InconsistentInputError,
    InfeasibleError,
    NotConvergedError,
    SingularError,
)
from catenaria.formfinding.rest import Clamped
from catenaria.formfinding.slacken import Slackened, slacken
from catenaria.formfinding.static_problem import find_rest
from catenaria.formfinding.wire_task import WireTask, wire_alone_task, wire_with_cables_task
from catenaria.results.form import Counters, FormResult
from catenaria.solvers.newton import Root

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class FoundWire:
    """A wire at rest.

    Attributes
    ----------
    task : WireTask
        What was to be found.
    z : FloatArray
        Its unknowns.
    clamped : Clamped
        The wire at its droppers.
    work : Counters
        How much work it was.
    how : str
        Empty if Newton's method found it at once.
    """

    task: WireTask
    z: FloatArray
    clamped: Clamped
    work: Counters
    how: str


def find_wire(setup: WireSetup, names: tuple[str, ...], start: FormResult | None = None) -> FoundWire:
    """Find one wire at rest with its targets met.

    Parameters
    ----------
    setup : WireSetup
        The wire.
    names : tuple of str
        Names of the droppers, for messages.
    start : FormResult, optional
        An earlier result to begin from instead of a taut wire.

    Raises
    ------
    NotConvergedError, InfeasibleError, SingularError
        See `catenaria.formfinding.direct.Direct.find_form`.
    """
    begin = perf_counter()
    task, z = _begin(setup, names, start)
    way = _find(task, z, names)
    wall, factorisations = perf_counter() - begin, way.factorisations
    residuals = way.iterations + factorisations
    work = Counters(
        setup.name, 0.0, wall, way.iterations, 0, 0, residuals, factorisations, factorisations, z.size
    )
    return FoundWire(task, way.z, task.clamped(way.z), work, way.how)


def _begin(setup: WireSetup, names: tuple[str, ...], start: FormResult | None) -> tuple[WireTask, FloatArray]:
    """Return the task and the unknowns from which to start; an earlier result has dropper cables."""
    alone = setup.droppers.guided and start is None
    try:
        task = wire_alone_task(setup, names) if alone else wire_with_cables_task(setup, names)
    except InconsistentInputError as error:
        raise InconsistentInputError(
            f"the {setup.name}: {error}, as slack as its tension of {setup.tension.force:.4g} N makes it; a "
            f"tail longer than {setup.tail:g} m or more tension would help"
        ) from error
    except InfeasibleError as error:
        raise InfeasibleError(f"the {setup.name} {error}") from error
    if start is None or not isinstance(task.hung, WireModel):
        return task, task.guess(task.hung)
    return task, start_from(task.hung, stage_of(start, setup.name)).system.unknowns.start


@dataclass(frozen=True)
class _Way:
    """Where a wire is at rest, the work, and how it was found."""

    z: FloatArray
    iterations: int
    factorisations: int
    how: str = ""


def _find(task: WireTask, z: FloatArray, names: tuple[str, ...]) -> _Way:
    try:
        root = find_rest(task.system.relocate(z) or task.system, z, names=task.parts)
        return _Way(root.y, root.iterations, root.corrections.size)
    except (NotConvergedError, InfeasibleError, SingularError) as error:
        plain = error
    try:
        found = slacken(task.hung, task.system, task.guess)
    except (NotConvergedError, InfeasibleError) as error:
        raise _failure(task, z, names, plain, error) from error
    system = task.system.relocate(found.z) or task.system
    root = find_rest(system, found.z, names=task.parts)  # unless something is free there
    how = f" (the {task.hung.setup.name} slackened in {found.released.parts.size} load steps)"
    iterations = found.iterations + root.iterations
    return _Way(root.y, iterations, iterations, how)


def _failure(
    task: WireTask,
    z: FloatArray,
    names: tuple[str, ...],
    plain: NotConvergedError | InfeasibleError | SingularError,
    stepping: NotConvergedError | InfeasibleError,
) -> CatenariaError:
    """Return the error that says most about why neither Newton's method nor load stepping found a rest."""
    wire = task.hung.setup.name
    if isinstance(stepping, InfeasibleError):
        return InfeasibleError(f"the {wire}: {stepping}", stepping.partial)
    if isinstance(plain, SingularError) and not isinstance(stepping.partial, Slackened):
        return plain
    partial = stepping.partial or plain.partial
    reason = f"the {wire}: {stepping.reason}"
    if isinstance(partial, Root) or partial is None:
        reason += f"; {_farthest(task.clamped(z if partial is None else partial.y), names)}"
    advice = f"{stepping.advice}; --method dynamic; or --start from the result of a line that is not far away"
    return NotConvergedError(reason, advice, partial)


def _farthest(clamped: Clamped, names: tuple[str, ...]) -> str:
    """Return which dropper is farthest from its target."""
    worst = int(np.argmax(np.abs(clamped.error)))
    what, unit = ("height", "m") if clamped.setup.droppers.up else ("force", "N")
    error = clamped.error[worst]
    return f"farthest from its target in the end was the {what} of {names[worst]}, by {error:.3g} {unit}"
