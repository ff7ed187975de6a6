"""The pendulum in Cartesian coordinates over many periods: drift, period, energy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ellipk

from catenaria.solvers import Options, Start, integrate

GRAVITY = 9.81
AMPLITUDE = 1.0
PERIOD = 4.0 / np.sqrt(GRAVITY) * float(ellipk(np.sin(AMPLITUDE / 2) ** 2))


def at_rest(angle):
    """Return the state at an angle from the vertical, with its multiplier -g z / 2."""
    x, z = np.sin(angle), -np.cos(angle)
    return Start(0.0, np.array([x, z, -GRAVITY * z / 2]), np.zeros(3))


def energy(solution):
    return 0.5 * (solution.yd[:, 0] ** 2 + solution.yd[:, 1] ** 2) + GRAVITY * (solution.y[:, 1] + 1.0)


def passages(solution):
    """Return the times at which the pendulum passes its lowest point."""
    x, t = solution.y[:, 0], solution.t
    before = np.flatnonzero(x[:-1] * x[1:] < 0.0)
    return t[before] - x[before] * (t[before + 1] - t[before]) / (x[before + 1] - x[before])




@pytest.mark.slow
def test_constraint_does_not_drift_in_200_periods(pendulum):
    newton = 1e-8
    problem = pendulum(error=1e-4, newton=newton)
    options = Options(max_order=2)
    solution = integrate(problem, at_rest(AMPLITUDE), 200 * PERIOD, options)
    defect = np.abs(solution.y[:, 0] ** 2 + solution.y[:, 1] ** 2 - 1.0)
    assert defect.max() < 10 * newton
    assert defect[-1000:].max() < 2 * defect[:1000].max() + newton
