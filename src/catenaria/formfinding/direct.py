"""The direct method: equilibrium together with all targets, in one Newton iteration for each wire.

The same systems as those of the dynamic equilibrium method, without inertia and with controls as equations:
the fixed point of the controlled motion with dead bands of zero, staged like the paper's three steps.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.guess import guess_equilibrium
from catenaria.discretise.restart import stage_of, start_from
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.discretise.wire_setup import WireSetup
from catenaria.errors import (
    CatenariaError,
    InconsistentInputError,
    InfeasibleError,
    NotConvergedError,
    SingularError,
)
from catenaria.formfinding.free_motion import Names
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.slacken import slacken
from catenaria.formfinding.static_problem import find_rest, statics
from catenaria.formfinding.third_step import (
    Rest,
    clamp_height,
    dropper_names,
    foot_force,
    gather,
    refuse_compression,
)
from catenaria.line import Line
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.results.form import Counters, FormResult
from catenaria.solvers.newton import Root

FloatArray = NDArray[np.float64]

_BAND = (1e-3, 1e-6)  # N and m, within which targets count as met in the result


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
            An earlier result to begin from instead of a taut string.

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
        contact = _solve(contact_wire_setup(line), start, names)
        force = foot_force(contact.rest)
        refuse_compression(line, force, contact.rest)
        self._tell("messenger wire", 2, begin)
        messenger = _solve(messenger_wire_setup(line, force, clamp_height(contact.rest)), start, names)
        self._tell("lengths", 3, begin)
        work = contact.work, messenger.work
        reason = f"Newton's method converged in {work[0].steps} and {work[1].steps} iterations"
        return gather(
            line, "direct", reason + contact.how + messenger.how, contact.rest, messenger.rest, work
        )

    def _tell(self, stage: str, number: int, begin: float) -> None:
        if self.listener is not None:
            self.listener(Progress(stage, number, 3, elapsed=perf_counter() - begin))


@dataclass(frozen=True)
class _Found:
    """Where a wire is at rest, the work, and how it was found."""

    rest: Rest
    work: Counters
    how: str


def _solve(setup: WireSetup, start: FormResult | None, names: tuple[str, ...]) -> _Found:
    begin = perf_counter()
    try:
        model = build_wire_model(replace(setup, gravity_ramp=Ramp(0.0)))
    except InconsistentInputError as error:
        raise InconsistentInputError(
            f"the {setup.name}: {error}, as slack as its tension of {setup.tension.force:.4g} N makes it; a "
            f"tail longer than {setup.tail:g} m or more tension would help"
        ) from error
    if start is None:
        z = guess_equilibrium(model)
    else:
        z = start_from(model, stage_of(start, setup.name)).system.unknowns.start
    z, iterations, how = _find(model, z, names)
    wall = perf_counter() - begin
    work = Counters(setup.name, 0.0, wall, iterations, 0, 0, 2 * iterations, iterations, iterations, z.size)
    tension, droppers = _BAND[0], _BAND[1] if setup.droppers.up else _BAND[0]
    return _Found(Rest(model, 0.0, z, (tension, droppers)), work, how)


def _find(model: WireModel, z: FloatArray, names: tuple[str, ...]) -> tuple[FloatArray, int, str]:
    """Return where a wire is at rest, the iterations, and how it was found."""
    parts = _parts(model, names)
    try:
        root = find_rest(statics(model.system, z), z, names=parts)
        return root.y, root.corrections.size, ""
    except (NotConvergedError, InfeasibleError, SingularError) as error:
        plain = error
    try:
        found = slacken(model, model.system, guess_equilibrium)
    except (NotConvergedError, InfeasibleError) as error:
        raise _failure(model, z, names, plain, error) from error
    root = find_rest(statics(model.system, found.z), found.z, names=parts)  # unless something is free there
    steps, iterations = found.released.parts.size, found.iterations + root.corrections.size
    return root.y, iterations, f" (the {model.setup.name} slackened in {steps} load steps)"


def _failure(
    model: WireModel,
    z: FloatArray,
    names: tuple[str, ...],
    plain: NotConvergedError | InfeasibleError | SingularError,
    stepping: NotConvergedError | InfeasibleError,
) -> CatenariaError:
    """Return the error that says most about why neither Newton's method nor load stepping found a rest."""
    wire = model.setup.name
    if isinstance(plain, SingularError):
        return plain
    if isinstance(stepping, InfeasibleError):
        return InfeasibleError(f"the {wire}: {stepping}", stepping.partial)
    partial = stepping.partial or plain.partial
    reason = f"the {wire}: {stepping.reason}"
    if isinstance(partial, Root) or partial is None:
        reason += f"; {_farthest(model, z if partial is None else partial.y, names)}"
    advice = f"{stepping.advice}; --method dynamic; or --start from the result of a line that is not far away"
    return NotConvergedError(reason, advice, partial)


def _farthest(model: WireModel, z: FloatArray, names: tuple[str, ...]) -> str:
    """Return which dropper is farthest from its target."""
    error = Rest(model, 0.0, z, _BAND).controls[1].error(0.0, z)
    worst = int(np.argmax(np.abs(error)))
    what, unit = ("height", "m") if model.setup.droppers.up else ("force", "N")
    return (
        f"farthest from its target in the end was the {what} of {names[worst]}, by {error[worst]:.3g} {unit}"
    )


def _parts(model: WireModel, names: tuple[str, ...]) -> Names:
    """Return the names of the parts of a wire, for messages."""
    wire, droppers = model.setup.name, model.droppers
    clamps = np.concatenate((model.clamp_s, droppers.clamp_force.ravel()))
    supports = np.concatenate((model.support_s, model.support_force.ravel()))
    return [
        (f"the {wire}", model.wire.nodes),
        (f"the pull at the ends of the {wire}", model.pull),
        (f"a support of the {wire}", supports),
        (f"an end of the {wire}", model.end_force),
        *((f"the travel of {name}", index) for name, index in zip(names, droppers.travel, strict=True)),
        *((name, chain.nodes) for name, chain in zip(names, droppers.chains, strict=True)),
        ("a dropper clamp", clamps),
        ("the far end of a dropper", droppers.free_force),
    ]
