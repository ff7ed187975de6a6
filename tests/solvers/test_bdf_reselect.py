"""A bead on a track of cubic pieces: the active piece is a discrete state that changes during a run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline

from catenaria.solvers import Start, integrate

GRAVITY = 9.81
KNOTS = np.linspace(-2.0, 2.0, 9)
TRACK = CubicHermiteSpline(KNOTS, 0.5 * KNOTS**2 + 0.1 * np.cos(5 * KNOTS), KNOTS)
X0 = 1.4


@pytest.fixture
def bead(base_problem, to_sparse):
    """Unknowns x, z, la with the constraint f_i(x) - z = 0 for the active piece i."""

    class Bead(base_problem):
        def __init__(self, piece, frozen=False):
            super().__init__([2, 2, 0], [2], 1e-6, 1e-9)
            self.piece, self.frozen = piece, frozen
            f = np.poly1d(TRACK.c[:, piece])
            self.derivatives = f, f.deriv(), f.deriv(2)

        def track(self, x):
            return [f(x - KNOTS[self.piece]) for f in self.derivatives]

        def residual(self, t, y, yd, ydd):
            f, f_x, _ = self.track(y[0])
            return np.array([ydd[0] + f_x * y[2], ydd[1] - y[2] + GRAVITY, f - y[1]])

        def jacobian(self, t, y, yd, ydd, c1, c2):
            _, f_x, f_xx = self.track(y[0])
            return to_sparse(np.array([[c2 + f_xx * y[2], 0.0, f_x], [0.0, c2, -1.0], [f_x, -1.0, 0.0]]))

        def reselect(self, y):
            piece = int(np.clip(np.searchsorted(KNOTS, y[0]) - 1, 0, KNOTS.size - 2))
            return None if self.frozen or piece == self.piece else Bead(piece)

    return Bead


def run(problem, t_end):
    return integrate(problem, Start(0.0, np.array([X0, float(TRACK(X0)), GRAVITY]), np.zeros(3)), t_end)


def reference(t_end):
    """Return x at t_end from x'' (1 + f'^2) + f' f'' x'^2 + g f' = 0, restarted wherever x passes a knot."""

    def rhs(t, state, piece):
        f_x, f_xx = (np.poly1d(TRACK.c[:, piece]).deriv(m)(state[0] - KNOTS[piece]) for m in (1, 2))
        return [state[1], -f_x * (GRAVITY + f_xx * state[1] ** 2) / (1 + f_x**2)]

    def border(side):
        def event(t, state, piece):
            return state[0] - KNOTS[piece + side]

        vars(event).update(terminal=True, direction=2 * side - 1)
        return event

    t, state, piece, crossings = 0.0, np.array([X0, 0.0]), int(np.searchsorted(KNOTS, X0)) - 1, 0
    while t < t_end:
        borders: Any = [border(0), border(1)]
        part = solve_ivp(rhs, (t, t_end), state, args=(piece,), events=borders, rtol=1e-10, atol=1e-12)
        t, state = part.t[-1], part.y[:, -1]
        if part.status == 1:
            piece += 1 if part.t_events[1].size else -1
            crossings += 1
    return state[0], crossings


def test_crossing_pieces_many_times_gives_the_run_with_exact_switching(bead):
    expected, crossings = reference(8.0)
    solution = run(bead(6), 8.0)
    assert crossings > 25
    assert solution.counters.reselections >= crossings
    assert solution.counters.reselections < 2 * crossings
    assert solution.y[-1, 0] == pytest.approx(expected, abs=3e-3)
    assert solution.y[:, 1] == pytest.approx(TRACK(solution.y[:, 0]), abs=1e-8)
    assert solution.problem.reselect(solution.y[-1]) is None


def test_negative_control_without_reselection_the_answer_is_wrong(bead):
    expected, _ = reference(2.0)
    solution = run(bead(6, frozen=True), 2.0)
    assert abs(solution.y[-1, 0] - expected) > 0.05
    assert np.abs(solution.y[:, 1] - TRACK(solution.y[:, 0])).max() > 0.05


def test_two_states_that_point_at_each_other_do_not_hang(bead):
    class Undecided(bead):
        def reselect(self, y):
            return Undecided(11 - self.piece) if abs(y[0] - 1.0) < 1e-3 else None

    solution = run(Undecided(6), 0.5)
    assert solution.t[-1] == 0.5
