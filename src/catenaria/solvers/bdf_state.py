"""State of a BDF integration as a value, and the state with which one begins."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from catenaria.errors import InconsistentInputError
from catenaria.solvers.corrector import Linearisation
from catenaria.solvers.error_control import NOTHING_HELD, Held
from catenaria.solvers.outcome import NO_WORK, Counters, Options, Start, Step
from catenaria.solvers.problem import DaeProblem, FloatArray

FIRST_STEP = 1e-4  # of the time span, if rates at the start do not ask for less


@dataclass(frozen=True)
class History:
    """Past points, newest first: t (m,), y (m, n) and y' (m, n)."""

    t: tuple[float, ...]
    y: FloatArray
    yd: FloatArray

    def pushed(self, t: float, y: FloatArray, yd: FloatArray, length: int) -> History:
        """Return the history with one more point and at most `length` points in all."""
        keep = length - 1
        return History((t, *self.t[:keep]), np.vstack((y, self.y[:keep])), np.vstack((yd, self.yd[:keep])))


@dataclass(frozen=True)
class State:
    """All that the next attempt depends on, and the outcome of the last one.

    Attributes
    ----------
    history : History
        Accepted points; a single starting point is preceded by one on its tangent, for the predictor alone.
    points : int
        Number of true points in the history.
    problem : DaeProblem
        With the discrete state of the last accepted point.
    h, order : float, int
        Step to try next and its order.
    linearisation : Linearisation or None
        Kept factorisation.
    counters : Counters
        Work done so far.
    held : Held
        Record of the accepted steps with the present length and order.
    failures : int
        Rejected attempts since the last accepted step.
    accepted : Step or None
        The step that led here, None if the attempt was rejected.
    complaint : str
        Why the attempt was rejected.
    """

    history: History
    points: int
    problem: DaeProblem
    h: float
    order: int
    linearisation: Linearisation | None = None
    counters: Counters = NO_WORK
    held: Held = NOTHING_HELD
    failures: int = 0
    accepted: Step | None = None
    complaint: str = ""


def begin(problem: DaeProblem, start: Start, t_end: float, options: Options) -> State:
    """Return the state before the first step.

    Raises
    ------
    InconsistentInputError
        If start, end and options contradict each other.
    """
    t, y, yd = np.atleast_1d(start.t), np.atleast_2d(start.y), np.atleast_2d(start.yd)
    _check(problem, t, y, yd, t_end, options)
    recent = slice(None, -options.max_order - 2, -1)
    history = History(tuple(t[recent].tolist()), y[recent], yd[recent])
    points = min(t.size, options.max_order + 1)
    h = _first_step(problem, history, t_end, options)
    order = min(options.max_order, points if options.constant_step else max(points - 1, 1))
    if points == 1:
        history = History((float(t[0]), float(t[0]) - h), np.vstack((y, y - h * yd)), np.vstack((yd, yd)))
    return State(history, points, problem, h, order)


def _first_step(problem: DaeProblem, history: History, t_end: float, options: Options) -> float:
    """Return the given first step, that of the table, or one in which rates move half an allowed error."""
    t0 = history.t[0]
    if options.constant_step is not None:
        return options.constant_step
    if options.initial_step is not None:
        return min(options.initial_step, options.max_step)
    if len(history.t) > 1:
        return min(t0 - history.t[1], options.max_step)
    span = t_end - t0
    rate = float(np.abs(history.yd[0] / problem.error_scale).max())
    return min(FIRST_STEP * span, 0.5 / max(rate, 1.0 / span), options.max_step)


def _check(
    problem: DaeProblem, t: FloatArray, y: FloatArray, yd: FloatArray, t_end: float, options: Options
) -> None:
    n = problem.size
    steps = (options.initial_step, options.constant_step, options.max_step)
    complaints = {
        f"start has y of shape {y.shape} and y' of shape {yd.shape}; expected {(t.size, n)}": not (
            y.shape == yd.shape == (t.size, n)
        ),
        "start is not finite": not (np.isfinite(y).all() and np.isfinite(yd).all()),
        "the times of start do not ascend": bool((np.diff(t) <= 0.0).any()),
        f"t_end = {t_end} is not a finite time after the start": not t[-1] < t_end < np.inf,
        f"max_order = {options.max_order} is not one of 1 to 5": options.max_order not in range(1, 6),
        "a step length is not positive": any(step is not None and not step > 0.0 for step in steps),
        "error_scale and newton_scale must be positive": not (
            (problem.error_scale > 0.0).all() and (problem.newton_scale > 0.0).all()
        ),
    }
    for complaint, holds in complaints.items():
        if holds:
            raise InconsistentInputError(f"Cannot integrate: {complaint}.")
