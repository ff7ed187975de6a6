"""Load stepping for a wire: found at rest under more tension, then slackened step by step to its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.hung_wire import HungWire
from catenaria.discretise.tensioned_wire import TensionedWire
from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.static_problem import static_problem, statics
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.system import System
from catenaria.solvers.load_stepping import Released, SteppingOptions, solve_by_steps
from catenaria.solvers.newton import NewtonOptions, Root, solve_newton

FloatArray = NDArray[np.float64]

_TIGHTER = (2.0, 4.0, 8.0, 16.0)
_NEWTON = NewtonOptions(max_iterations=30, permc_spec="NATURAL")
_SHORT = 0.5  # part of a tail below which it is too short: what is left has to turn into the wire's slope

W = TypeVar("W", bound=HungWire)


@dataclass(frozen=True)
class Slackened:
    """A wire at rest, and the way there.

    Attributes
    ----------
    hung : HungWire
        The wire.
    tension : float
        The tension that was reached [N], the wanted one unless slackening failed.
    released : Released
        The load steps.
    start : Root
        Where the tighter wire is at rest.
    """

    hung: HungWire
    tension: float
    released: Released
    start: Root

    @property
    def z(self) -> FloatArray:
        """The unknowns."""
        return self.released.root.y

    @property
    def iterations(self) -> int:
        """Newton iterations of the start and of all steps."""
        return self.start.iterations + self.released.iterations


def slacken(hung: W, system: System, guess: Callable[[W], FloatArray]) -> Slackened:
    """Find a wire at rest that is too slack for Newton's method to find it from a guess.

    Parameters
    ----------
    hung : HungWire
        The wire.
    system : System
        All of gravity on it, and controls or targets.
    guess : callable
        Returns unknowns near the rest of a wire with the same unknowns and another tension.

    Returns
    -------
    Slackened

    Raises
    ------
    NotConvergedError
        If no tighter wire is found, or the wire cannot be slackened as far; `partial` is then the `Slackened`
        so far.
    InfeasibleError
        If the wire slides out of its end supports before; with the same `partial`.

    Notes
    -----
    A tighter wire is straighter, so that the first guess is nearer to it. It misses only one equation of the
    wanted one, its tension: the homotopy F(z) - (1 - p) F(z0) = 0 from there lowers the tension and nothing
    else.
    """
    wanted, options = hung.setup.tension.force, SteppingOptions(newton=_NEWTON)
    for factor in _TIGHTER:
        try:
            start = _tightened(hung, system, guess, factor)
        except (NotConvergedError, InfeasibleError):
            continue
        problem = static_problem(statics(system, start.y))
        try:
            released = solve_by_steps(problem, start.y, options)
        except NotConvergedError as error:
            if not isinstance(error.partial, Released):
                raise
            reached = wanted * (factor - (factor - 1.0) * error.partial.part)
            raise _too_slack(Slackened(hung, reached, error.partial, start)) from error
        return Slackened(hung, wanted, released, start)
    raise NotConvergedError(
        "Newton's method finds no rest, not even under 16 times the tension",
        "supports and wanted heights nearer to level",
    )


def _tightened(hung: W, system: System, guess: Callable[[W], FloatArray], factor: float) -> Root:
    """Return where a wire is at rest that is the same but for its tension."""
    tension = hung.setup.tension
    setup = replace(hung.setup, tension=replace(tension, force=factor * tension.force))
    z = guess(replace(hung, setup=setup, tensioned=TensionedWire.of(setup)))
    system = statics(system, z)
    parts = tuple(
        replace(part, target=factor * part.target)
        if isinstance(part, Targets) and np.array_equal(part.parameter, hung.pull)
        else part
        for part in system.contributions
    )
    return solve_newton(static_problem(System(system.unknowns, parts)), z, _NEWTON)


def _too_slack(found: Slackened) -> NotConvergedError | InfeasibleError:
    """Return the error that says how far the wire could be slackened, and what would help."""
    hung, z = found.hung, found.z
    setup, s = hung.setup, z[hung.support_s]
    tail = min(float(s[0]), float(hung.wire.knots[-1] - s[-1]))
    missed = (
        f"its tension of {setup.tension.force:.4g} N is the target that is not met; with all others met "
        f"it comes down to {found.tension:.4g} N"
    )
    if tail < _SHORT * setup.tail:
        return InfeasibleError(
            f"{missed}, where {max(tail, 0.0):.2g} m of its tail of {setup.tail:g} m are left beyond an end "
            "support. A longer tail or more tension would help",
            found,
        )
    sag = setup.height - float(z[hung.wire.nodes[:, 2]].min())
    return NotConvergedError(
        f"{missed}, where it sags by {sag:.3g} m",
        "more tension, shorter spans, or lighter droppers and clamps",
        found,
    )
