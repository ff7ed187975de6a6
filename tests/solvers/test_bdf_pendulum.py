"""The pendulum in Cartesian coordinates over many periods: drift, period, energy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ellipk

from catenaria.solvers import Options, Start, integrate

GRAVITY = 9.81
AMPLITUDE = 1.0


def period_of(amplitude):
    return 4.0 / np.sqrt(GRAVITY) * float(ellipk(np.sin(amplitude / 2) ** 2))


PERIOD = period_of(AMPLITUDE)


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


def test_constraint_does_not_drift_in_200_periods(pendulum):
    newton = 1e-8
    solution = integrate(pendulum(error=2e-4, newton=newton), at_rest(AMPLITUDE), 200 * PERIOD)
    defect = np.abs(solution.y[:, 0] ** 2 + solution.y[:, 1] ** 2 - 1.0)
    assert defect.max() < 10 * newton
    assert defect[-1000:].max() < 2 * defect[:1000].max()
    assert np.abs(solution.y[-1000:, 0]).max() > 0.05  # it still swings


def test_negative_control_a_coarse_newton_tolerance_shows_in_the_constraint(pendulum):
    solution = integrate(pendulum(error=2e-4, newton=1e-4), at_rest(AMPLITUDE), 10 * PERIOD)
    defect = np.abs(solution.y[:, 0] ** 2 + solution.y[:, 1] ** 2 - 1.0)
    assert 1e-6 < defect.max() < 10 * 1e-4


@pytest.mark.parametrize(("order", "tolerance"), [(2, 3e-4), (5, 5e-6)])
def test_period_agrees_with_the_elliptic_integral(pendulum, order, tolerance):
    """Energy, and with it the amplitude, is what the first steps of low order have left."""
    options = Options(max_order=order, constant_step=PERIOD / 400)
    solution = integrate(pendulum(newton=1e-12), at_rest(AMPLITUDE), 12 * PERIOD, options)
    times = passages(solution)
    period = 2 * (times[-1] - times[3]) / (times.size - 4)
    left = energy(solution)[(solution.t > times[3]) & (solution.t < times[-1])].mean()
    expected = period_of(np.arccos(1.0 - left / GRAVITY))
    assert period == pytest.approx(expected, rel=tolerance)
    assert expected != pytest.approx(2 * np.pi / np.sqrt(GRAVITY), rel=0.05)


@pytest.mark.parametrize(
    ("order", "per_period", "growth"),
    [(1, 400, lambda w: -(w**2) / 2), (2, 50, lambda w: -(w**4) / 4), (3, 50, lambda w: w**4 / 4)],
)
def test_energy_changes_as_the_formula_prescribes(pendulum, order, per_period, growth):
    """Amplitude per step exp(growth), from the series of the formula's roots (docs/theory/bdf.md).

    Orders 1 and 2 damp; order 3 feeds energy into an undamped oscillation.
    """
    angle, periods = 0.01, 20
    period = 2 * np.pi / np.sqrt(GRAVITY)
    options = Options(max_order=order, constant_step=period / per_period)
    solution = integrate(pendulum(newton=1e-13), at_rest(angle), periods * period, options)
    omega_h = 2 * np.pi / per_period
    amplitude = [
        np.abs(solution.y[(solution.t >= t) & (solution.t <= t + period), 0]).max()
        for t in (2 * period, (periods - 1) * period - 1e-9)
    ]
    steps = (periods - 3) * per_period
    assert np.log(amplitude[1] / amplitude[0]) / steps == pytest.approx(growth(omega_h), rel=0.1)
