"""The direct method: equilibrium together with all targets, in one Newton iteration for each wire.

The same systems as those of the dynamic equilibrium method, without inertia and with controls as equations:
the fixed point of the controlled motion with dead bands of zero, staged like the paper's three steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.restart import stage_of, start_from
from catenaria.discretise.wire_model import WireModel
from catenaria.discretise.wire_setup import WireSetup
from catenaria.errors import InconsistentInputError, InfeasibleError, NotConvergedError
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.refusals import dropper_names, refuse_compression
from catenaria.formfinding.rest import Clamped
from catenaria.formfinding.slacken import slacken
from catenaria.formfinding.static_problem import find_rest
from catenaria.formfinding.third_step import gather
from catenaria.formfinding.wire_task import WireTask, wire_alone_task, wire_with_cables_task
from catenaria.line import Line
from catenaria.results.form import Counters, FormResult
from catenaria.solvers.newton import Root

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Direct:
    """The method, ready to be run on lines.

    Parameters
    ----------
    listener : callable, optional
        Is told which stage begins.
    """

    listener: Listener | None = None

    def find_form(self, line: Line, start: FormResult | None = None) -> FormResult:
        """Find the form of a line.

        Parameters
        ----------
        line : Line
            What the engineer describes.
        start : FormResult, optional
            An earlier result to begin from instead of a taut wire.

        Returns
        -------
        FormResult

        Raises
        ------
        NotConvergedError
            If neither Newton's method nor load stepping finds a wire at rest; the error says how far it came.
        InfeasibleError
            If the schedule cannot be built.
        SingularError
            If what is prescribed leaves a motion free.
        """
        begin = perf_counter()
        self._tell("contact wire", 1, begin)
        names = dropper_names(line)
        contact = find_wire(contact_wire_setup(line), names, start)
        below = contact.clamped
        refuse_compression(line, below)
        self._tell("messenger wire", 2, begin)
        messenger = find_wire(messenger_wire_setup(line, below.lift, below.height), names, start)
        self._tell("lengths", 3, begin)
        found = contact, messenger
        work = contact.work, messenger.work
        reason = f"Newton's method converged in {work[0].steps} and {work[1].steps} iterations"
        rests = tuple(wire.task.rest(wire.z) for wire in found)
        return gather(line, "direct", reason + contact.how + messenger.how, rests[0], rests[1], work)

    def _tell(self, stage: str, number: int, begin: float) -> None:
        if self.listener is not None:
            self.listener(Progress(stage, number, 3, elapsed=perf_counter() - begin))


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
        See `Direct.find_form`.
    """
    begin = perf_counter()
    task, z = _begin(setup, names, start)
    z, iterations, factorisations, how = _find(task, z, names)
    wall = perf_counter() - begin
    clamped = task.clamped(z)
    work = Counters(
        setup.name, 0.0, wall, iterations, 0, 0, 2 * iterations, factorisations, factorisations, z.size
    )
    return FoundWire(task, z, clamped, work, how)


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
    if start is None or not isinstance(task.hung, WireModel):
        return task, task.guess(task.hung)
    return task, start_from(task.hung, stage_of(start, setup.name)).system.unknowns.start


def _find(task: WireTask, z: FloatArray, names: tuple[str, ...]) -> tuple[FloatArray, int, int, str]:
    """Return where a wire is at rest, iterations, factorisations, and how it was found."""
    wire = task.hung.setup.name
    try:
        root = find_rest(task.system.relocate(z) or task.system, z, names=task.parts)
        factorisations = root.corrections.size
        return root.y, factorisations + root.simplified, factorisations, ""
    except (NotConvergedError, InfeasibleError) as error:
        plain = error
    try:
        found = slacken(task.hung, task.system, task.guess)
    except NotConvergedError as error:
        last = plain.partial.y if isinstance(plain.partial, Root) else z
        reason = error.reason if error.partial else f"{error.reason}; {_farthest(task.clamped(last), names)}"
        raise NotConvergedError(
            f"the {wire}: {reason}",
            f"{error.advice}; --method dynamic; or --start from the result of a line that is not far away",
            error.partial or plain.partial,
        ) from error
    except InfeasibleError as error:
        raise InfeasibleError(f"the {wire}: {error}", error.partial) from error
    how = f" (the {wire} slackened in {found.released.parts.size} load steps)"
    return found.z, found.iterations, found.iterations, how


def _farthest(clamped: Clamped, names: tuple[str, ...]) -> str:
    """Return which dropper is farthest from its target."""
    worst = int(np.argmax(np.abs(clamped.error)))
    what, unit = ("height", "m") if clamped.setup.droppers.up else ("force", "N")
    error = clamped.error[worst]
    return f"farthest from its target in the end was the {what} of {names[worst]}, by {error:.3g} {unit}"
