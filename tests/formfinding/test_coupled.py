"""The whole line at once gives what the staged direct method gives, with droppers of another kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.formfinding.coupled import find_coupled_form
from catenaria.line import Line
from catenaria.results import FormResult
from catenaria.workflow import solve

CHANGES: dict[str, dict[str, Any]] = {
    "the paper's line": {},
    "clamps": {"dropper.clamp_mass_top": 0.2, "dropper.clamp_mass_bottom": 0.15},
    "half the tension": {"contact_wire.tension.force": 7.5e3, "messenger_wire.tension.force": 7.5e3},
    "strain measure": {"messenger_wire.tension.measure": "strain"},
}


def check_agrees(line: Line, staged: FormResult) -> None:
    """Lengths to 1e-9 m, forces to 1e-6 N, in at most 8 iterations."""
    form = find_coupled_form(line)
    np.testing.assert_allclose(form.length, staged.droppers.length, atol=1e-9)
    np.testing.assert_allclose(form.unstressed_length, staged.droppers.unstressed_length, atol=1e-9)
    np.testing.assert_allclose(form.on_contact, staged.droppers.on_contact, atol=1e-6)
    np.testing.assert_allclose(form.on_messenger, staged.droppers.on_messenger, atol=1e-6)
    assert form.iterations <= 8


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_at_once_and_staged_agree(variant: Callable[[Any], Line], change: dict[str, Any]) -> None:
    line = variant(change)
    check_agrees(line, solve(line, method="direct"))


def test_another_line_is_noticed(variant: Callable[[Any], Line]) -> None:
    staged = solve(variant({}), method="direct")
    with pytest.raises(AssertionError):
        check_agrees(variant({"messenger_wire.tension.force": 15001.0}), staged)
