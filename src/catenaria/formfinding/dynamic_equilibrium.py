"""The dynamic equilibrium method of Yang et al. 2017: three steps to the form of a catenary, section 3.2.3.

First step: the contact wire alone, carried by the lower cables of the droppers, is pulled to its tension
while the droppers lift it to the wanted heights; the forces T_cd that they need are read. Second step: the
messenger wire alone is pulled to its tension while the upper cables of the droppers are drawn down until each
carries T_cd and the dropper's weight, eq. (23). Third step: the length of each dropper is the difference in
height of its two clamps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

from catenaria.discretise.film import film
from catenaria.discretise.from_line import contact_wire_setup, messenger_wire_setup
from catenaria.discretise.history import control_names, history
from catenaria.discretise.restart import stage_of, start_from, with_full_gravity
from catenaria.discretise.wire_model import WireModel, build_wire_model
from catenaria.discretise.wire_setup import WireSetup
from catenaria.formfinding.controlled_motion import Motion, move, system_of, tolerances
from catenaria.formfinding.progress import Listener, Progress
from catenaria.formfinding.refusals import refuse_compression
from catenaria.formfinding.rest import Rest
from catenaria.formfinding.settling import Settled, largest_error
from catenaria.formfinding.spatial.dynamic import find_by_motion
from catenaria.formfinding.third_step import gather, support_names
from catenaria.line import Line
from catenaria.results.film import Film
from catenaria.results.form import Counters, FormResult, History
from catenaria.solvers.outcome import Options, Step

_STAGES = 3
_FIRST_STEP = 0.01  # part of the ramp in which next to nothing happens


@dataclass(frozen=True)
class DynamicEquilibrium:
    """The method, ready to be run on lines.

    Parameters
    ----------
    listener : callable, optional
        Is told after every time step how far the motion is.
    filmed : callable, optional
        Receives a film of each step when the step is over: of a plane line one of the contact wire and one of
        the messenger wire; of a line in space one of all wires for each decision which droppers hang slack.
    frames : int
        How many states a film has at most.
    """

    listener: Listener | None = None
    filmed: Callable[[Film], None] | None = None
    frames: int = 100

    def find_form(self, line: Line, start: FormResult | None = None) -> FormResult:
        """Find the form of a line.

        Parameters
        ----------
        line : Line
            What the engineer describes.
        start : FormResult, optional
            An earlier result from which both steps begin instead of straight, unstrained wires (Fig. 2).

        Returns
        -------
        FormResult

        Raises
        ------
        NotConvergedError
            If a step does not come to rest.
        InconsistentInputError
            If `start` does not fit the line.
        InfeasibleError
            If the schedule cannot be built.
        """
        if not line.plane:
            return find_by_motion(line, self.listener, start, self.filmed, self.frames)
        begin = perf_counter()
        contact = self._step(line, contact_wire_setup(line), 1, start, begin)
        below = _rest(contact).clamped
        refuse_compression(line, below)
        setup = messenger_wire_setup(line, below.lift, below.height, below.position[:, 0])
        messenger = self._step(line, setup, 2, start, begin)
        self._tell(Progress("lengths", 3, _STAGES, elapsed=perf_counter() - begin))
        motions = (contact, messenger)
        return gather(
            line,
            "dynamic",
            "; ".join(f"{motion.model.setup.name}: {motion.solution.reason}" for motion in motions),
            _rest(contact),
            _rest(messenger),
            tuple(_counters(motion) for motion in motions),
            tuple(map(_history, motions, support_names(line))),
        )

    def _step(
        self, line: Line, setup: WireSetup, number: int, start: FormResult | None, begin: float
    ) -> Motion[WireModel]:
        self._tell(Progress(setup.name, number, _STAGES, elapsed=perf_counter() - begin))
        if start is None:
            model = build_wire_model(setup)
        else:
            earlier = stage_of(start, setup.name)
            model = start_from(build_wire_model(with_full_gravity(setup)), earlier)
        options = line.solver.dynamic
        motion = move(
            model,
            tolerances(model, options.integrator.position_tolerance),
            Options(
                max_order=options.integrator.max_order,
                initial_step=_FIRST_STEP * options.ramp_time,
                max_steps=options.integrator.max_steps,
                permc_spec="NATURAL",
            ),
            Settled(options.settle.velocity, options.settle.dead_bands, options.settle.remaining_travel),
            options.integrator.max_time,
            self._observers(model, number, begin),
        )
        if self.filmed is not None:
            self.filmed(film(model, motion.solution, self.frames))
        return motion

    def _observers(self, model: WireModel, number: int, begin: float) -> tuple[Callable[[Step], None], ...]:
        """Return the observer that tells the listener about accepted time steps, if there is a listener."""
        listener = self.listener
        if listener is None:
            return ()
        names = control_names(model)

        def observe(step: Step) -> None:
            bands, batch, place = largest_error(model.controls(system_of(step)), step.t, step.y)
            elapsed = perf_counter() - begin
            worst = names[batch + place]
            listener(
                Progress(
                    model.setup.name,
                    number,
                    _STAGES,
                    step.t,
                    step.h,
                    step.number,
                    step.order,
                    worst,
                    bands,
                    elapsed,
                )
            )

        return (observe,)

    def _tell(self, progress: Progress) -> None:
        if self.listener is not None:
            self.listener(progress)


def _rest(motion: Motion[WireModel]) -> Rest:
    tension, droppers = motion.controls
    return Rest(motion.model, motion.t, motion.z, (tension.law.e0, droppers.law.e0))


def _history(motion: Motion[WireModel], support_names: tuple[str, ...]) -> History:
    return history(motion.model, motion.solution, support_names)


def _counters(motion: Motion[WireModel]) -> Counters:
    work = motion.solution.counters
    return Counters(
        step=motion.model.setup.name,
        simulated_time=motion.t,
        wall_time=motion.wall_time,
        steps=work.steps,
        rejected=work.rejected,
        newton_failures=work.newton_failures,
        residuals=work.residuals,
        jacobians=work.jacobians,
        factorisations=work.factorisations,
        unknowns=motion.system.size,
    )
