"""Dynamic relaxation: the equilibrium f(y) = 0 of a structure as the rest of a damped, fictitious motion.

No matrix is stored and none is solved with; what it costs is thousands of residuals. It shares nothing with
Newton's method but the equations, and finds its way from starts where Newton's method does not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf, isfinite

import numpy as np

from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.solvers.problem import FloatArray
from catenaria.solvers.relaxation_motion import (
    STABILITY_LIMIT,
    Motion,
    advance_kinetically,
    advance_viscously,
)
from catenaria.solvers.relaxation_values import (
    Damping,
    Relaxation,
    RelaxationOptions,
    RelaxationProblem,
    RelaxationStep,
)

Observer = Callable[[RelaxationStep], None]

_ADVANCE: dict[Damping, Callable[[Motion], float | None]] = {
    "kinetic": advance_kinetically,
    "viscous": advance_viscously,
}


class _Log:
    """What the result will tell about the course of a relaxation."""

    def __init__(self, interval: int, observers: Sequence[Observer]) -> None:
        self.interval, self.observers = interval, observers
        self.recorded: list[int] = []
        self.residual: list[float] = []
        self.peaks: list[float] = []
        self.iterations = self.mass_updates = self.restarts = 0
        self.worst = inf

    def note(self, motion: Motion, worst: float) -> None:
        """Count an iteration, and record it if its turn has come or it is the last one."""
        if not isfinite(worst):
            raise self.failure(motion, "A force is not finite", "a start nearer to the equilibrium")
        if self.iterations % self.interval == 0 or worst <= 1.0:
            self._record(motion, worst)
        self.iterations += 1
        self.worst = worst

    def _record(self, motion: Motion, worst: float) -> None:
        self.recorded.append(self.iterations)
        self.residual.append(worst)
        for observe in self.observers:
            observe(RelaxationStep(self.iterations, motion.y.copy(), worst, 0.5 * motion.twice_energy))

    def result(self, motion: Motion, converged: bool) -> Relaxation:
        """Return everything as a value."""
        return Relaxation(
            y=motion.y.copy(),
            converged=converged,
            iterations=self.iterations,
            recorded=np.array(self.recorded, dtype=np.int64),
            residual=np.array(self.residual),
            peaks=np.array(self.peaks),
            mass_updates=self.mass_updates,
            restarts=self.restarts,
        )

    def failure(self, motion: Motion, reason: str, advice: str) -> NotConvergedError:
        """Return the error that carries what has been reached."""
        return NotConvergedError(reason, advice, self.result(motion, False))


def relax(
    problem: RelaxationProblem,
    y: FloatArray,
    options: RelaxationOptions | None = None,
    observers: Sequence[Observer] = (),
) -> Relaxation:
    """Find an equilibrium from a start, which may be far away.

    Parameters
    ----------
    problem : RelaxationProblem
        Forces, their negligible size, and a bound of the stiffness.
    y : FloatArray, shape (n,)
        Start; it is not changed.
    options : RelaxationOptions, optional
        Damping, masses and limits.
    observers : sequence of callable
        Called with every record.

    Returns
    -------
    Relaxation
        With every |f_i| <= force_scale_i.

    Raises
    ------
    InconsistentInputError
        If shapes do not fit, or a force scale or stiffness bound is not positive and finite.
    NotConvergedError
        If the motion shows more stiffness than the bound, a force is not finite or the iterations run out;
        `partial` is the `Relaxation` so far.

    Notes
    -----
    Leapfrog with step 1 on M y'' + c M y' + f(y) = 0 is stable if all eigenvalues of M^{-1} K are below 4,
    which m_i > sum_j |K_ij| / 4 ensures (Gershgorin 1931). Convergence is a matter of forces alone: where
    masses are large or damping strong, everything looks steady far from equilibrium.

    Examples
    --------
    Two springs in a row, pulled by 1 N at the end:

    >>> K = np.array([[300.0, -100.0], [-100.0, 100.0]])
    >>> class Springs:
    ...     size, force_scale = 2, np.full(2, 1e-9)
    ...
    ...     def residual(self, y):
    ...         return K @ y - np.array([0.0, 1.0])
    ...
    ...     def stiffness_bound(self, y):
    ...         return np.abs(K).sum(axis=1)
    >>> relax(Springs(), np.zeros(2)).y.round(9)
    array([0.005, 0.015])

    References
    ----------
    Barnes 1999, Form finding and analysis of tension structures by dynamic relaxation, Int. J. Space Struct.
    14, 89-104.
    Underwood 1983, Dynamic relaxation, in: Computational Methods for Transient Analysis, chapter 5.
    """
    options = options or RelaxationOptions()
    _check(problem, y)
    motion = Motion(y, _masses(problem, y, options))
    advance, weight = _ADVANCE[options.damping], 1.0 / problem.force_scale
    log = _Log(options.record_interval, observers)
    while log.iterations < options.max_iterations:
        force = problem.residual(motion.y)
        log.note(motion, float(np.abs(force * weight).max()))
        if log.worst <= 1.0:
            return log.result(motion, True)
        motion.observe(force)
        if motion.is_unstable(problem.force_scale):
            _begin_anew(problem, motion, options, log)
        elif log.iterations % options.mass_interval == 0:
            motion.change_mass(_masses(problem, motion.y, options))
            log.mass_updates += 1
        peak = advance(motion)
        if peak is not None:
            log.peaks.append(peak)
    reason = (
        f"After {log.iterations} iterations of dynamic relaxation a force is {log.worst:.3g} times too large"
    )
    raise log.failure(motion, reason, "more iterations, the other damping, a start nearer to the equilibrium")


def _check(problem: RelaxationProblem, y: FloatArray) -> None:
    shape = (problem.size,)
    if y.shape != shape or problem.force_scale.shape != shape or problem.size == 0:
        raise InconsistentInputError(
            f"the shape of the start is {y.shape}, that of the force scale {problem.force_scale.shape}; "
            f"both must be {shape}, and not empty"
        )
    _require_positive(problem.force_scale, "force scale")


def _masses(problem: RelaxationProblem, y: FloatArray, options: RelaxationOptions) -> FloatArray:
    """Return the fictitious masses that the stiffness at y asks for."""
    bound = problem.stiffness_bound(y)
    _require_positive(bound, "stiffness bound")
    return options.mass_factor / STABILITY_LIMIT * bound


def _require_positive(values: FloatArray, what: str) -> None:
    bad = np.flatnonzero(~((values > 0.0) & np.isfinite(values)))
    if bad.size:
        raise InconsistentInputError(
            f"the {what} of unknown {bad[0]} is {values[bad[0]]}; it must be positive and finite"
        )


def _begin_anew(problem: RelaxationProblem, motion: Motion, options: RelaxationOptions, log: _Log) -> None:
    """Rest with masses for the present stiffness, unless they would not hold the motion seen either."""
    seen = motion.omega2 * motion.twice_energy
    motion.change_mass(np.maximum(motion.mass, _masses(problem, motion.y, options)))
    if seen > STABILITY_LIMIT * motion.twice_energy:
        reason = (
            f"After {log.iterations} iterations the motion grows: the stiffness that it shows needs masses "
            f"{seen / (STABILITY_LIMIT * motion.twice_energy):.3g} times as large"
        )
        advice = "a stiffness bound that covers all of the stiffness, a larger mass factor"
        raise log.failure(motion, reason, advice)
    motion.stop()
    log.mass_updates += 1
    log.restarts += 1
