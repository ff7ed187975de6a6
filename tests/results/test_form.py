"""What follows from the fields of a result."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.results import NO_ARMS, NO_CANTILEVERS, NO_MASSES, NO_TIES, Arms, FormResult


def arms(registration: tuple[str, ...], radial: list[float], minimum: float) -> Arms:
    force, one = np.array(radial), np.ones(len(radial))
    place = np.zeros((one.size, 3))
    names = tuple(f"S{i}" for i in range(one.size))
    return Arms(
        names, names, registration, one, place, place, one, one, one, one, force, force, one, minimum * one
    )


def test_a_pull_off_arm_must_pull_and_a_push_off_arm_may_push() -> None:
    found = arms(
        ("pull-off", "pull-off", "pull-off", "push-off", "push-off"), [90.0, 70.0, -90.0, -90.0, -70.0], 80.0
    )
    np.testing.assert_array_equal(found.enough, [True, False, False, True, False])
    np.testing.assert_array_equal(found.pull, [90.0, 70.0, -90.0, 90.0, 70.0])
    without = replace(found, minimum_radial=np.zeros(5))
    np.testing.assert_array_equal(without.enough, [True, True, False, True, True])


def test_inclination_and_slackness(result: FormResult) -> None:
    """A 3-4-5 triangle leans by atan(3/4), in whatever direction."""
    bottom = np.zeros((3, 3))
    top = np.array([[0.0, 0.0, 2.0], [0.0, -3.0, 4.0], [3.0, 0.0, 4.0]])
    droppers = replace(
        result.droppers, position_bottom=bottom, position_top=top, force_bottom=np.array([-1.0, 0.0, 1.0])
    )
    np.testing.assert_allclose(droppers.inclination, [0.0, np.arctan(0.75), np.arctan(0.75)])
    np.testing.assert_array_equal(droppers.slack, [True, True, False])


def test_wires_are_found_by_name(result: FormResult) -> None:
    assert result.wire(result.wires[1].name) is result.wires[1]
    with pytest.raises(InconsistentInputError, match="there is no wire 'nowhere'; there is text"):
        result.wire("nowhere")


def test_a_line_is_in_space_if_all_wires_were_found_at_once(result: FormResult) -> None:
    assert not result.spatial
    assert replace(result, stages=(replace(result.stages[0], step="line"),)).spatial
    assert not replace(result, stages=()).spatial


@pytest.mark.parametrize("table", [NO_ARMS, NO_TIES, NO_MASSES, NO_CANTILEVERS])
def test_empty_tables_have_no_rows(table: Any) -> None:
    assert all(len(getattr(table, field.name)) == 0 for field in fields(table))
