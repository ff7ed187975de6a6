"""Consistent starting values of an index-3 system: rates, accelerations and multipliers.

Positions and velocities are the user's and are checked; what follows from them is computed from the rows of
the system and the constraints differentiated twice.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from scipy.sparse import csc_array, diags_array  # pyright: ignore

from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.solvers.linear import factorise
from catenaria.solvers.outcome import Start
from catenaria.solvers.problem import BoolArray, DaeProblem, FloatArray, SparseMatrix

DIFFERENCE = float(np.cbrt(np.finfo(np.float64).eps))  # best relative step of a central difference
SEPARATION = 2.0**40  # makes F_y' or F_y'' dominate a combined Jacobian; a power of two costs no digits
MAX_ITERATIONS = 20


@dataclass(frozen=True)
class Defects:
    """How far a state is off the constraints, entry by entry, shape (number of constraints,).

    Attributes
    ----------
    position : FloatArray
        g(t, y).
    velocity : FloatArray
        g_y y' + g_t [1/s].
    """

    position: FloatArray
    velocity: FloatArray


@dataclass(frozen=True)
class InitialValues:
    """Consistent state at one time.

    Attributes
    ----------
    t : float
        Time [s].
    y : FloatArray, shape (n,)
        The given unknowns with the multipliers computed.
    yd : FloatArray, shape (n,)
        The given rates with those of first-order unknowns computed.
    ydd : FloatArray, shape (n,)
        Second derivatives of positions and sliding coordinates, zero elsewhere.
    defects : Defects
        What is left of the constraints.
    """

    t: float
    y: FloatArray
    yd: FloatArray
    ydd: FloatArray
    defects: Defects

    @property
    def start(self) -> Start:
        """The same as the start of an integration."""
        return Start(self.t, self.y, self.yd)


def consistent_start(
    problem: DaeProblem,
    t: float,
    y: FloatArray,
    yd: FloatArray,
    tolerance: float = 1e-8,
    time_scale: float = 1.0,
) -> InitialValues:
    """Complete positions and velocities that satisfy the constraints to a consistent state.

    Parameters
    ----------
    problem : DaeProblem
        The system.
    t : float
        Time [s].
    y, yd : FloatArray, shape (n,)
        Unknowns and rates; their multipliers and the rates of first-order unknowns are first guesses.
    tolerance : float
        Largest entry of the defects that is accepted, in the units of the constraints and per second.
    time_scale : float
        Time [s] in which constraints change noticeably; sets the length of numerical differences.

    Returns
    -------
    InitialValues

    Raises
    ------
    InconsistentInputError
        If a constraint is violated at position or velocity level.
    NotConvergedError
        If no multipliers can be found, for example because constraints contradict or repeat each other.

    Notes
    -----
    Unknown are y'' of second-order unknowns and of sliding coordinates, y' of first-order ones and the
    multipliers; they solve all rows that are no constraints, and g_y y'' + gamma = 0, where gamma is what y'
    contributes to the second derivative of g. First-order unknowns are taken to start without acceleration.
    """
    unknown = _Unknown.of(problem)
    values = _solve(problem, unknown, t, y, yd, time_scale)
    defects = constraint_defects(problem, t, values[0], values[1], time_scale)
    for level, defect in (("position", defects.position), ("velocity", defects.velocity)):
        worst = float(np.abs(defect).max(initial=0.0))
        if not worst <= tolerance:
            row = int(np.flatnonzero(problem.constraint)[np.abs(defect).argmax()])
            raise InconsistentInputError(
                f"The start violates constraint row {row} at {level} level by {worst:.3g}; "
                f"allowed: {tolerance:.3g}."
            )
    return InitialValues(t, *values, defects)


def constraint_defects(
    problem: DaeProblem, t: float, y: FloatArray, yd: FloatArray, time_scale: float = 1.0
) -> Defects:
    """Return the constraints and their first derivative by time; parameters as for `consistent_start`."""
    zero = np.zeros_like(y)
    position = problem.residual(t, y, yd, zero)[problem.constraint]
    return Defects(position, _constraint_rate(problem, t, y, yd, DIFFERENCE * time_scale))


def constraint_curvature(
    problem: DaeProblem, t: float, y: FloatArray, yd: FloatArray, time_scale: float = 1.0
) -> FloatArray:
    """Return gamma of g'' = g_y y'' + gamma: the change of g_y y' + g_t along the straight line of slope y'.

    The parameters are those of `consistent_start`.
    """
    tau = DIFFERENCE * time_scale
    after = _constraint_rate(problem, t + tau, y + tau * yd, yd, tau)
    before = _constraint_rate(problem, t - tau, y - tau * yd, yd, tau)
    return (after - before) / (2.0 * tau)


def _constraint_rate(problem: DaeProblem, t: float, y: FloatArray, yd: FloatArray, tau: float) -> FloatArray:
    """Return g_y y' + g_t; g_t by a central difference, which is exactly zero where g does not contain t."""
    zero = np.zeros_like(y)
    by_y = (problem.jacobian(t, y, yd, zero, 0.0, 0.0) @ yd)[problem.constraint]
    after = problem.residual(t + tau, y, yd, zero)[problem.constraint]
    before = problem.residual(t - tau, y, yd, zero)[problem.constraint]
    return by_y + (after - before) / (2.0 * tau)


@dataclass(frozen=True)
class _Unknown:
    """Which derivative of each unknown is unknown at the start: masks of shape (n,)."""

    multiplier: BoolArray
    rate: BoolArray
    acceleration: BoolArray

    @staticmethod
    def of(problem: DaeProblem) -> _Unknown:
        rate = problem.order_of == 1
        return _Unknown(problem.constraint, rate, ~problem.constraint & ~rate)

    def split(
        self, x: FloatArray, y: FloatArray, yd: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return y, y', y'' with the entries of x put where they belong."""
        return (
            np.where(self.multiplier, x, y),
            np.where(self.rate, x, yd),
            np.where(self.acceleration, x, 0.0),
        )

    def negligible(self, correction: FloatArray, x: FloatArray) -> bool:
        """Say whether a correction is small beside the largest entry of its kind, or beside 1."""
        kinds = (self.multiplier, self.rate, self.acceleration)
        return all(
            np.abs(correction[kind]).max(initial=0.0) <= 1e-9 * np.abs(x[kind]).max(initial=1.0)
            for kind in kinds
        )


def _solve(
    problem: DaeProblem, unknown: _Unknown, t: float, y: FloatArray, yd: FloatArray, time_scale: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return y, y', y'' by Newton iteration; one step is exact if rows are linear in what is unknown."""
    x = np.where(unknown.multiplier, y, np.where(unknown.rate, yd, 0.0))
    for _ in range(MAX_ITERATIONS):
        values = unknown.split(x, y, yd)
        try:
            lu = factorise(_matrix(problem, unknown, t, *values))
        except np.linalg.LinAlgError as error:
            raise _failure(str(error)) from error
        correction = -lu.solve(_rows(problem, t, *values, time_scale))
        if not np.isfinite(correction).all():
            raise _failure("a residual is not finite")
        x = x + correction
        if unknown.negligible(correction, x):
            return unknown.split(x, y, yd)
    raise _failure(f"{MAX_ITERATIONS} iterations were not enough")


def _rows(
    problem: DaeProblem, t: float, y: FloatArray, yd: FloatArray, ydd: FloatArray, time_scale: float
) -> FloatArray:
    """Return the rows of the system with each constraint replaced by its second derivative."""
    rows = problem.residual(t, y, yd, ydd)
    by_y = problem.jacobian(t, y, yd, ydd, 0.0, 0.0) @ ydd
    rows[problem.constraint] = by_y[problem.constraint] + constraint_curvature(problem, t, y, yd, time_scale)
    return rows


def _matrix(
    problem: DaeProblem, unknown: _Unknown, t: float, y: FloatArray, yd: FloatArray, ydd: FloatArray
) -> SparseMatrix:
    """Return the derivatives of `_rows` by what is unknown (those of gamma by y' are left out).

    F_y' and F_y'' are recovered from combined Jacobians with a large coefficient, which buries F_y.
    """

    def part(c1: float, c2: float) -> Any:
        return csc_array(cast("Any", problem.jacobian(t, y, yd, ydd, c1, c2)))

    def only(mask: BoolArray) -> Any:
        return diags_array(mask.astype(np.float64))

    f_y = part(0.0, 0.0)
    f_yd = (part(SEPARATION, 0.0) - f_y) / SEPARATION
    f_ydd = (part(0.0, SEPARATION) - f_y) / SEPARATION
    free = f_y @ only(unknown.multiplier) + f_yd @ only(unknown.rate) + f_ydd @ only(unknown.acceleration)
    matrix = only(~problem.constraint) @ free + only(problem.constraint) @ f_y @ only(unknown.acceleration)
    return cast("SparseMatrix", csc_array(matrix))


def _failure(reason: str) -> NotConvergedError:
    return NotConvergedError(
        f"No consistent starting values: {reason}",
        "constraints that neither repeat nor contradict each other",
    )
