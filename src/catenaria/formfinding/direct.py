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
from catenaria.errors import NotConvergedError
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.static_problem import find_rest
from catenaria.formfinding.third_step import Rest, clamp_height, foot_force, gather, refuse_compression
from catenaria.line import Line
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.system import System
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
            If Newton's method does not converge.
        InfeasibleError
            If the schedule cannot be built.
        """
        begin = perf_counter()
        self._tell("contact wire", 1, begin)
        contact, contact_work = _solve(contact_wire_setup(line), start)
        force = foot_force(contact)
        refuse_compression(force)
        self._tell("messenger wire", 2, begin)
        messenger_setup = messenger_wire_setup(line, force, clamp_height(contact))
        messenger, messenger_work = _solve(messenger_setup, start)
        self._tell("lengths", 3, begin)
        reason = f"Newton's method converged in {contact_work.steps} and {messenger_work.steps} iterations"
        return gather(line, "direct", reason, contact, messenger, (contact_work, messenger_work))

    def _tell(self, stage: str, number: int, begin: float) -> None:
        if self.listener is not None:
            self.listener(Progress(stage, number, 3, elapsed=perf_counter() - begin))


def _solve(setup: WireSetup, start: FormResult | None) -> tuple[Rest, Counters]:
    begin = perf_counter()
    model = build_wire_model(replace(setup, gravity_ramp=Ramp(0.0)))
    if start is None:
        z = guess_equilibrium(model)
    else:
        z = start_from(model, stage_of(start, setup.name)).system.unknowns.start
    root = _root(model, z)
    iterations = root.corrections.size
    wall = perf_counter() - begin
    work = Counters(setup.name, 0.0, wall, iterations, 0, 0, 2 * iterations, iterations, iterations, z.size)
    tension, droppers = _BAND[0], _BAND[1] if setup.droppers.up else _BAND[0]
    return Rest(model, 0.0, root.y, (tension, droppers)), work


def _root(model: WireModel, z: FloatArray) -> Root:
    try:
        return find_rest(statics(model.system, z), z)
    except NotConvergedError as error:
        raise NotConvergedError(
            f"the {model.setup.name}: {error.reason}",
            "--method dynamic, or --start from the result of a line that is not far from this one",
            error.partial,
        ) from error


def statics(system: System, z: FloatArray) -> System:
    """Return the system with targets in the place of controls, and joints in the elements that fit z."""
    parts = tuple(Targets.of(part) if isinstance(part, Controls) else part for part in system.contributions)
    static = System(system.unknowns, parts)
    return static.relocate(z) or static
