"""Formulas of waves against hand numbers."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.report.checks.formulas import doppler_factor, gradients, reflection_factor, wave_speed


def test_wave_speed_of_120_mm2_of_copper() -> None:
    # 15 kN and 1.07 kg/m: the square root of 14,018.7 m^2/s^2
    assert wave_speed(15e3, 1.07) == pytest.approx(118.40, abs=5e-3)


def test_reflection_factor_by_hand() -> None:
    # messenger 12 kN x 0.6 kg/m = 7,200; contact wire 20 kN x 1.0 kg/m = 20,000; roots 84.853 and 141.421
    assert reflection_factor((20e3, 1.0), (12e3, 0.6)) == pytest.approx(84.853 / 226.274, abs=1e-5)
    assert reflection_factor((20e3, 1.0), (12e3, 0.6)) != pytest.approx(141.421 / 226.274, abs=1e-2)


def test_doppler_factor_by_hand() -> None:
    assert doppler_factor(120.0, 70.0) == pytest.approx(50.0 / 190.0)
    assert doppler_factor(120.0, 120.0) == 0.0


def test_gradients_have_signs() -> None:
    x, z = np.array([0.0, 50.0, 110.0, 170.0]), np.array([5.3, 5.35, 5.35, 5.29])
    assert gradients(x, z).tolist() == pytest.approx([1e-3, 0.0, -1e-3])
