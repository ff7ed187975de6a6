"""Changed lines: new values by dotted path, checked like those of a file."""

from __future__ import annotations

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.line import Line
from catenaria.workflow.variation import vary


def test_values_are_replaced_and_the_original_is_kept(small: Line) -> None:
    change = {"messenger_wire.tension.force": "16 kN", "spans.0.droppers.positions.1": 15.0}
    varied = vary(small, change)
    assert varied.messenger_wire.tension.force == 16e3
    assert varied.dropper_x == (6.0, 15.0)
    assert small.messenger_wire.tension.force == 15e3
    assert vary(varied, {"messenger_wire.tension.force": 15e3, "spans.0.droppers.positions.1": 14.0}) == small


def test_without_changes_it_is_the_same(small: Line) -> None:
    assert vary(small, {}) == small


@pytest.mark.parametrize(
    "path", ["messenger_wire.tensoin.force", "spans.1.length", "spans.x.length", "name.first", ""]
)
def test_an_unknown_place_is_refused(small: Line, path: str) -> None:
    with pytest.raises(InconsistentInputError, match="there is no"):
        vary(small, {path: 1.0})


@pytest.mark.parametrize("value", ["15 kg", -1.0, None])
def test_a_value_that_does_not_fit_is_refused(small: Line, value: object) -> None:
    with pytest.raises(
        InconsistentInputError, match=r"do not fit: Line: messenger_wire\.tension\.force: "
    ) as raised:
        vary(small, {"messenger_wire.tension.force": value})
    assert "pydantic" not in str(raised.value)
    assert "[type=" not in str(raised.value)
