"""The found lengths, built into a fresh model without controls, give the found state (Fig. 19)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from catenaria.formfinding.rebuild import rebuild
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.workflow import solve


def check_returns(line: Line, result: FormResult, metres: float, newtons: float) -> None:
    built = rebuild(line, result)
    np.testing.assert_allclose(built.height_change, 0.0, atol=metres)
    np.testing.assert_allclose(built.messenger_height_change, 0.0, atol=metres)
    np.testing.assert_allclose(built.force_change, 0.0, atol=newtons)
    np.testing.assert_allclose(built.tension_change, 0.0, atol=newtons)


@pytest.mark.parametrize("change", [{}, {"dropper.clamp_mass_top": 0.2, "dropper.clamp_mass_bottom": 0.1}])
def test_direct_form_comes_back(variant: Callable[[Any], Line], change: dict[str, Any]) -> None:
    line = variant(change)
    check_returns(line, solve(line, method="direct"), 1e-7, 1e-3)


def test_dynamic_form_comes_back_within_its_dead_bands(line: Line, paper: FormResult) -> None:
    """0.022 N of force balance, 0.16 mm of length between 5 and 20 N of tension: a tenth of a millimetre."""
    check_returns(line, paper, 0.15e-3, 1.0)


def test_height_error_is_reported_apart(line: Line, paper: FormResult) -> None:
    built = rebuild(line, paper)
    expected = built.height_change + paper.droppers.height_error
    np.testing.assert_allclose(built.height_error, expected, atol=1e-12)


def test_one_length_off_by_a_millimetre_is_noticed(variant: Callable[[Any], Line]) -> None:
    line = variant({})
    result = solve(line, method="direct")
    longer = result.droppers.unstressed_length + 1e-3 * (np.arange(21) == 10)
    wrong = replace(result, droppers=replace(result.droppers, unstressed_length=longer))
    with pytest.raises(AssertionError):
        check_returns(line, wrong, 1e-7, 1e-3)
    built = rebuild(line, wrong)
    assert -1e-3 < built.height_change[10] < -0.3e-3  # the contact wire hangs lower there
