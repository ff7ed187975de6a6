"""One dynamic step of the method: move a model under its controls until it rests, eqs. (18)-(27)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.wire_model import WireModel
from catenaria.errors import InconsistentInputError, InfeasibleError, NotConvergedError
from catenaria.formfinding.motion_problem import MotionProblem, Tolerances
from catenaria.formfinding.settling import Settled, largest_error, largest_speed, remaining_travel
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind
from catenaria.solvers.bdf import integrate
from catenaria.solvers.outcome import Options, Solution, Start, Status, Step

FloatArray = NDArray[np.float64]
Observer = Callable[[Step], None]

_OPEN = 1e-6  # m by which joints may be open at the start
_ADVICE = (
    "a larger max_time or max_steps of the integrator, wider dead bands, a larger ramp_time, a larger "
    "saturation of dropper forces, damping; a mistaken unit in the file has the same effect"
)
_RESOLVED = 0.02  # part of the width of a velocity law by which a control may err in one time step
_NEGLIGIBLE = 0.05  # part of a dead band that a Newton correction may leave undone
_LARGEST_FORCE = 1e-2  # N: forces are wanted to a tenth of a newton even with wide bands
_SOON = 1.0  # s, in which nothing may gather speed at rest
_CHECK_EVERY = 10  # accepted steps between two looks at the remaining travel, which costs a factorisation


class Movable(Protocol):
    """What can be moved: the wire of one step, or a free structure."""

    @property
    def name(self) -> str:
        """Name, for messages."""
        ...

    @property
    def system(self) -> System:
        """The system at its starting configuration."""
        ...

    @property
    def ramp_time(self) -> float:
        """Until when loads and control velocities grow [s]."""
        ...

    def controls(self, system: System) -> tuple[Controls, ...]:
        """Return the controls with the discrete state of the given system."""
        ...


Model = TypeVar("Model", bound=Movable)


@dataclass(frozen=True)
class Motion(Generic[Model]):
    """A finished step.

    Attributes
    ----------
    model : Movable
        What moved.
    system : System
        Its system with the final discrete state.
    solution : Solution
        All accepted time steps.
    wall_time : float
        Time it took [s].
    """

    model: Model
    system: System
    solution: Solution
    wall_time: float

    @property
    def t(self) -> float:
        """Final time [s]."""
        return float(self.solution.t[-1])

    @property
    def z(self) -> FloatArray:
        """Final unknowns."""
        return self.solution.y[-1]

    @property
    def controls(self) -> tuple[Controls, ...]:
        """The controls in their final discrete state."""
        return self.model.controls(self.system)


def tolerances(model: WireModel, position: float) -> Tolerances:
    """Return tolerances at which Newton's method leaves no control in doubt about its dead band.

    Parameters
    ----------
    model : WireModel
        What moves.
    position : float
        Error of positions in one time step [m].

    Notes
    -----
    A wire or cable of length L turns a correction of d metres into EA d/L newtons, so corrections must be
    far smaller than positions are wanted: 0.02 N is 25 nm of a dropper.
    """
    tension, droppers = (control.law.e0 for control in model.controls(model.system))
    bands = (tension,) if model.setup.droppers.up else (tension, droppers)
    force = min(_LARGEST_FORCE, _NEGLIGIBLE * min(bands))
    compliance = min(chain.knots[-1] / chain.section.EA for chain in (model.wire, *model.droppers.chains))
    return Tolerances(position, _parameter_errors(model, position), force * float(compliance), force)


def _parameter_errors(model: WireModel, position: float) -> FloatArray:
    """Return the error of each control parameter that leaves its law resolved [m].

    A step that errs by more than the width of the law would jump across the dead band; both ends of a wire of
    length L turn a parameter error d into 2 EA d/L newtons.
    """
    tension, droppers = (control.law for control in model.controls(model.system))
    errors = np.full(model.system.size, position)
    stiffness = 2.0 * model.wire.section.EA / model.wire.knots[-1]
    errors[model.pull] = min(position, _RESOLVED * (tension.e1 - tension.e0) / stiffness)
    if model.setup.droppers.up:
        errors[model.droppers.travel] = min(position, _RESOLVED * (droppers.e1 - droppers.e0))
    return errors[model.system.unknowns.where(Kind.PARAMETER)]


class _Rest:
    """Stop function of the integrator: looks at speeds, control errors and remaining travel."""

    def __init__(self, model: Movable, settled: Settled) -> None:
        self._model = model
        self._settled = settled

    def __call__(self, step: Step) -> str | None:
        """Return why the motion counts as settled, or None while it does not."""
        settled = self._settled
        if step.t < self._model.ramp_time:
            return None
        system = system_of(step)
        if largest_speed(system, step.yd) > settled.velocity:
            return None
        controls = self._model.controls(system)
        if not controls:  # nothing but speed tells a turning point of a free oscillation from rest
            soon = largest_speed(system, step.yd + _SOON * step.ydd) <= settled.velocity
            return "at rest, with no acceleration to speak of" if soon else None
        if largest_error(controls, step.t, step.y)[0] <= settled.dead_bands:
            return f"at rest, and every control error is within {settled.dead_bands:g} dead bands"
        if step.number % _CHECK_EVERY == 0:
            travel = remaining_travel(system, controls, step.t, step.y)
            if travel <= settled.remaining_travel:
                return f"at rest, and no control would travel farther than {1e3 * travel:.2g} mm"
        return None


def system_of(step: Step) -> System:
    """Return the system behind a time step."""
    problem = step.problem
    if not isinstance(problem, MotionProblem):
        raise TypeError("the step does not belong to a MotionProblem")
    return problem.system


def move(
    model: Model,
    tolerances: Tolerances,
    options: Options,
    settled: Settled,
    max_time: float,
    observers: tuple[Observer, ...] = (),
) -> Motion[Model]:
    """Integrate a model from its starting configuration until it is settled.

    Raises
    ------
    NotConvergedError
        If the integrator fails or the motion is not settled at `max_time`; `partial` is the `Solution` so
        far.
    """
    begin = perf_counter()
    z = model.system.unknowns.start
    start = Start(0.0, z, np.zeros_like(z))
    problem = MotionProblem(model.system, tolerances)
    _refuse_inconsistent(model, problem, z)
    try:
        solution = integrate(problem, start, max_time, options, observers, _Rest(model, settled))
    except NotConvergedError as error:
        raise NotConvergedError(f"the {model.name}: {error.reason}", _ADVICE, error.partial) from error
    except InfeasibleError as error:
        raise InfeasibleError(f"the {model.name}: {error}") from error
    final = solution.problem
    if solution.status is not Status.STOPPED or not isinstance(final, MotionProblem):
        raise NotConvergedError(
            f"the {model.name} is not at rest after {solution.t[-1]:.4g} s of simulated time",
            _ADVICE,
            solution,
        )
    return Motion(model, final.system, solution, perf_counter() - begin)


def _refuse_inconsistent(model: Movable, problem: MotionProblem, z: FloatArray) -> None:
    """Refuse a start in which joints are open."""
    rest = np.zeros_like(z)
    gap = np.abs(problem.residual(0.0, z, rest, rest)[problem.constraint])
    if gap.max() > _OPEN:
        raise InconsistentInputError(
            f"the {model.name} does not fit its joints at the start: one is open by {gap.max():.4g} m. "
            "An earlier result can only start a line with the same supports, droppers and wire lengths"
        )
