"""The direct method on the paper's three-span line, against independent programs and the dynamic method.

Reference values as in test_dynamic_equilibrium.py; 0.2 mm and 0.02 N are what they are good for.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InfeasibleError
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.workflow import solve

Solved = Callable[..., FormResult]

LENGTH = np.array(
    [1.3790, 1.1502, 1.0129, 0.9669, 1.0122, 1.1488, 1.3768, 1.3767, 1.1483, 1.0113, 0.9657]
)  # m
FORCE = np.array([61.73, 86.26, 86.05, 86.05, 86.05, 86.11, 79.20, 79.20, 86.11, 86.05, 86.05])  # N


@pytest.fixture(scope="module")
def direct(line: Line) -> FormResult:
    return solve(line, method="direct")


def check_reference(result: FormResult) -> None:
    np.testing.assert_allclose(result.droppers.length[:11], LENGTH, atol=0.2e-3)
    np.testing.assert_allclose(result.droppers.force_bottom[:11], FORCE, atol=0.02)


def test_agrees_with_independent_programs(direct: FormResult) -> None:
    check_reference(direct)


def test_other_lengths_are_noticed(direct: FormResult) -> None:
    longer = replace(direct.droppers, length=direct.droppers.length + 0.3e-3)
    with pytest.raises(AssertionError):
        check_reference(replace(direct, droppers=longer))


def test_targets_are_met_exactly(direct: FormResult) -> None:
    newtons = np.array(direct.controls.unit) == "N"
    assert np.abs(direct.controls.error[newtons]).max() < 1e-6
    assert np.abs(direct.controls.error[~newtons]).max() < 1e-12


def test_takes_few_iterations(direct: FormResult) -> None:
    assert max(work.steps for work in direct.counters) <= 5


def test_agrees_with_the_dynamic_method(direct: FormResult, narrow: Solved) -> None:
    """Bands of 0.01 N and 0.1 um bring the dynamic method to within 0.01 mm."""
    finer = narrow(
        (
            ("solver.dynamic.contact_tension.dead_band", 0.01),
            ("solver.dynamic.contact_tension.saturation", 1.0),
            ("solver.dynamic.messenger_tension.dead_band", 0.01),
            ("solver.dynamic.messenger_tension.saturation", 1.0),
            ("solver.dynamic.height.dead_band", 1e-7),
            ("solver.dynamic.height.saturation", 1e-4),
            ("solver.dynamic.dropper_force.dead_band", 0.001),
            ("solver.dynamic.dropper_force.saturation", 5.0),
            ("solver.dynamic.settle.remaining_travel", 1e-9),
        )
    )
    np.testing.assert_allclose(finer.droppers.length, direct.droppers.length, atol=0.01e-3)
    np.testing.assert_allclose(finer.droppers.force_bottom, direct.droppers.force_bottom, atol=0.02)


def test_starts_from_an_earlier_result(line: Line, direct: FormResult) -> None:
    again = solve(line, method="direct", start=direct)
    np.testing.assert_allclose(again.droppers.length, direct.droppers.length, atol=1e-9)
    assert max(work.steps for work in again.counters) <= 2


CHANGES: dict[str, dict[str, Any]] = {
    "half the tension": {"contact_wire.tension.force": 7.5e3, "messenger_wire.tension.force": 7.5e3},
    "twice the tension": {"contact_wire.tension.force": 30e3, "messenger_wire.tension.force": 30e3},
    "strain measure": {"contact_wire.tension.measure": "strain", "messenger_wire.tension.measure": "strain"},
    "frictionless droppers": {"dropper.joint": "frictionless"},
    "one element a cable": {"dropper.elements": 1},
    "clamps": {"dropper.clamp_mass_top": 0.2, "dropper.clamp_mass_bottom": 0.15},
    "coarse mesh": {"solver.mesh.fine": (), "solver.mesh.largest_element": 5.0},
    "fine mesh": {"solver.mesh.refine": 4},
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_converges_for_other_lines(variant: Callable[[Any], Line], change: dict[str, Any]) -> None:
    result = solve(variant(change), method="direct")
    assert max(work.steps for work in result.counters) <= 8
    np.testing.assert_allclose(result.droppers.length, result.droppers.length[::-1], atol=1e-6)


def test_a_dropper_in_compression_is_refused(variant: Callable[[Any], Line]) -> None:
    """A mid-span height 60 mm below its neighbours needs a push of 2 T dh/d = 190 N."""
    span = {
        "length": 65.0,
        "droppers": {"positions": [4, 13.5, 23, 32.5, 42, 51.5, 61]},
        "contact_wire_height": [0.0, 0.0, 0.0, -0.06, 0.0, 0.0, 0.0],
    }
    with pytest.raises(InfeasibleError, match=r"compression: 4 \(-1"):
        solve(variant({"spans": (span,) * 3}), method="direct")
