"""The found lengths, built into a fresh model without controls, give the found state (Fig. 19)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.formfinding.rebuild import rebuild
from catenaria.line import Line
from catenaria.results import FormResult, Rebuilt
from catenaria.workflow import solve

CLAMPS = {"dropper.clamp_mass_top": 0.2, "dropper.clamp_mass_bottom": 0.1}


def check_returns(rebuilt: Rebuilt, metres: float, newtons: float) -> None:
    """Everything comes back, within what is allowed and within the given sizes."""
    assert rebuilt.findings() == ()
    for comeback in (rebuilt.height, rebuilt.messenger_height):
        np.testing.assert_allclose(comeback.change, 0.0, atol=metres)
    for comeback in (rebuilt.force, rebuilt.tension):
        np.testing.assert_allclose(comeback.change, 0.0, atol=newtons)


@pytest.mark.parametrize("change", [{}, CLAMPS, {"messenger_wire.tension.measure": "strain"}])
def test_direct_form_comes_back(variant: Callable[[Any], Line], change: dict[str, Any]) -> None:
    line = variant(change)
    rebuilt = rebuild(line, solve(line, rebuild="none"))
    check_returns(rebuilt, 1e-7, 1e-3)
    assert rebuilt.iterations <= 8


def test_a_direct_form_is_allowed_a_hundredth_of_a_millimetre(variant: Callable[[Any], Line]) -> None:
    line = variant({})
    rebuilt = rebuild(line, solve(line, rebuild="none"))
    for comeback in (rebuilt.height, rebuilt.messenger_height):
        np.testing.assert_array_equal(comeback.allowed, 1e-5)
    for comeback in (rebuilt.force, rebuilt.tension):
        np.testing.assert_array_equal(comeback.allowed, 0.1)


def test_dynamic_form_comes_back_within_its_dead_bands(line: Line, paper: FormResult) -> None:
    """Droppers miss their balance by 0.02 N; 21 of them move the line by 0.04 mm, a tension by 0.3 N."""
    check_returns(rebuild(line, paper), 0.06e-3, 0.5)


def test_errors_against_what_was_wanted_are_reported_apart(line: Line, paper: FormResult) -> None:
    rebuilt = rebuild(line, paper)
    wanted = np.array(line.dropper_target_height)
    np.testing.assert_allclose(rebuilt.height_error, rebuilt.height.value - wanted, atol=1e-15)
    reaction = rebuilt.tension.value - [line.contact_wire.tension.force, line.messenger_wire.tension.force]
    np.testing.assert_allclose(rebuilt.tension_error, reaction, atol=1e-6)
    assert np.abs(rebuilt.tension_error).max() > 10.0 * np.abs(rebuilt.tension.change).max()


def corrupted(result: FormResult, field: str, factor: float, metres: float) -> FormResult:
    """Return the result with one entry of the dropper table changed."""
    values = getattr(result.droppers, field).copy()
    values[10] = factor * values[10] + metres
    return replace(result, droppers=replace(result.droppers, **{field: values}))


@pytest.mark.parametrize(
    ("field", "factor", "metres"),
    [
        ("unstressed_length", 1.0, 1e-3),
        ("force_bottom", 1.01, 0.0),
        ("height", 1.0, 2e-5),
        ("messenger_height", 1.0, -2e-5),
        ("contact_coordinate", 1.0, 0.1),
    ],
)
@pytest.mark.parametrize("method", ["direct", "dynamic"])
def test_one_wrong_number_is_noticed(
    line: Line, paper: FormResult, method: str, field: str, factor: float, metres: float
) -> None:
    result = paper if method == "dynamic" else solve(line, rebuild="none")
    size = 5.0 if method == "dynamic" else 1.0  # dead bands hide less than 0.06 mm
    assert rebuild(line, result).passed
    assert not rebuild(line, corrupted(result, field, factor, size * metres)).passed


def test_a_dropper_that_is_too_long_lets_the_contact_wire_hang(line: Line) -> None:
    wrong = corrupted(solve(line, rebuild="none"), "unstressed_length", 1.0, 1e-3)
    rebuilt = rebuild(line, wrong)
    assert -1e-3 < rebuilt.height.change[10] < -0.3e-3
    assert any("dropper 11" in finding for finding in rebuilt.findings())


def test_lengths_that_hold_nothing_are_told(line: Line) -> None:
    """Droppers of a millimetre would have to carry a kilonewton a metre."""
    result = solve(line, rebuild="none")
    hopeless = replace(result, droppers=replace(result.droppers, unstressed_length=np.full(21, 1e-3)))
    with pytest.raises(NotConvergedError, match="the rebuilt line: "):
        rebuild(line, hopeless)
