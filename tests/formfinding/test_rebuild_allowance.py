"""What a rebuilt line is allowed is what the method leaves open, and nothing besides."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.formfinding.rebuild import rebuild
from catenaria.line import Line
from catenaria.results import Comeback, FormResult, Rebuilt
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]

FRICTIONLESS = {"dropper.joint": "frictionless"}
FLOORS = {"height": 1e-5, "messenger_height": 1e-5, "force": 0.1, "tension": 0.1}


def effects(rebuilt: Rebuilt) -> dict[str, tuple[float, float]]:
    """Return the largest change of each kind, and the largest one allowed beyond what always passes."""
    parts: dict[str, Comeback] = {name: getattr(rebuilt, name) for name in FLOORS}
    return {
        name: (float(np.abs(part.change).max()), float(part.allowed.max() - FLOORS[name]))
        for name, part in parts.items()
    }


def check_prediction(rebuilt: Rebuilt, ratio: float) -> None:
    """Linearised statics allow what happens, and hardly more."""
    for name, (change, allowed) in effects(rebuilt).items():
        assert change < allowed + 0.01 * FLOORS[name], name
        assert allowed < ratio * change + 0.1 * FLOORS[name], name


def test_dead_bands_allow_what_they_cause(line: Line, paper: FormResult) -> None:
    """Bands of 0.022 N, of which each dropper of this line uses 0.021 N to the same side."""
    check_prediction(rebuild(line, paper), 2.0)


def test_lower_bands_allow_less(line: Line, paper: FormResult) -> None:
    """Negative control: with half the bands and errors this result would not pass."""
    controls, errors = paper.controls, paper.droppers.force_error
    narrower = replace(
        paper,
        controls=replace(controls, dead_band=0.5 * controls.dead_band),
        droppers=replace(paper.droppers, force_error=0.5 * errors),
    )
    with pytest.raises(AssertionError):
        check_prediction(rebuild(line, narrower), 2.0)


@pytest.mark.parametrize("clamps", [0.0, 0.4])
def test_leaning_droppers_of_frictionless_joints(variant: Callable[[Any], Line], clamps: float) -> None:
    """Tops are up to 43 mm beside their feet: whole droppers change a tension by 3 N, predicted to 2 %."""
    line = variant(FRICTIONLESS | {"dropper.clamp_mass_top": clamps})
    rebuilt = rebuild(line, solve(line, rebuild="none"))
    change, allowed = effects(rebuilt)["tension"]
    assert 2.0 < change < 5.0
    assert change == pytest.approx(allowed / 1.2, rel=0.02)
    assert rebuilt.passed


def test_frictionless_joints_do_not_hide_a_wrong_length(variant: Callable[[Any], Line]) -> None:
    line = variant(FRICTIONLESS)
    result = solve(line, rebuild="none")
    longer = result.droppers.unstressed_length + 0.1e-3 * (np.arange(21) == 10)
    wrong = replace(result, droppers=replace(result.droppers, unstressed_length=longer))
    right, off = rebuild(line, result), rebuild(line, wrong)
    np.testing.assert_allclose(off.height.allowed, right.height.allowed, rtol=0.01)
    assert right.passed
    assert not off.passed
