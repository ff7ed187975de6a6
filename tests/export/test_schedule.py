"""The dropper schedule, and the places of clamps."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.export.clamps import clamp_columns
from catenaria.export.schedule import dropper_labels, rounded_lengths, schedule_columns, write_schedule
from catenaria.results import FormResult


@pytest.mark.parametrize("step", [1e-3, 5e-3, 0.01])
def test_rounded_lengths_are_whole_steps_and_the_nearest(every: FormResult, step: float) -> None:
    columns = schedule_columns(every, step)
    exact, rounded = (np.asarray(columns[name]) for name in ("cut_length_m", "cut_length_rounded_m"))
    np.testing.assert_allclose(rounded / step, np.round(rounded / step), rtol=0.0, atol=1e-9)
    assert np.abs(rounded - exact).max() <= 0.5 * step + 1e-9
    np.testing.assert_allclose(columns["rounding_mm"], 1e3 * (rounded - exact), rtol=0.0, atol=1e-12)
    np.testing.assert_array_equal(exact, every.droppers.cut_length)


@pytest.mark.parametrize("step", [0.0, -0.001, float("nan"), 10.0])
def test_steps_of_no_use_are_refused(plane: FormResult, step: float) -> None:
    with pytest.raises(InconsistentInputError, match="rounded to"):
        schedule_columns(plane, step)


def test_halves_are_rounded_upwards() -> None:
    np.testing.assert_array_equal(
        rounded_lengths(np.array([1.0005, 1.0015, 1.00149]), 1e-3), [1.001, 1.002, 1.001]
    )


def test_every_dropper_has_a_name_of_its_own(every: FormResult) -> None:
    names, droppers = dropper_labels(every), every.droppers
    assert len(set(names)) == len(names) == droppers.x.size
    numbers = [f"{span}.{number}" for span, number in zip(droppers.span, droppers.number, strict=True)]
    assert [name.removeprefix("H") for name in names] == numbers
    hangers = [name.startswith("H") for name in names]
    assert hangers == [wire == "auxiliary messenger" for wire in droppers.upper_wire]
    assert any(hangers) == (len(set(numbers)) < len(numbers))


def test_csv(every: FormResult, tmp_path: Path) -> None:
    file = tmp_path / "schedule.csv"
    write_schedule(every, file, 5e-3)
    with file.open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == every.droppers.x.size
    lengths = [float(row["cut_length_m"]) for row in rows]
    np.testing.assert_allclose(lengths, every.droppers.cut_length, rtol=0.0, atol=5.1e-6)
    assert {row["cut_length_rounded_m"][-3:] for row in rows} <= {"000", "500"}  # of 1.23500
    assert {float(row["reference_temperature_degC"]) for row in rows} == {
        every.inputs["reference_temperature"]
    }


def test_clamps_are_marked_in_order_and_at_the_found_coordinates(every: FormResult) -> None:
    columns = clamp_columns(every)
    wire, s = np.array(columns["wire"]), np.asarray(columns["from_start_m"])
    droppers, supports, ties = every.droppers, every.supports, every.ties
    count = 2 * droppers.x.size + len(supports.wire) + ties.coordinate.size + every.masses.mass.size
    assert s.size == count
    for form in every.wires:
        own = wire == form.name
        on = [name == form.name for name in droppers.lower_wire]
        assert np.isin(droppers.contact_coordinate[on], s[own]).all()
        if own.any():
            steps = np.asarray(columns["from_mark_before_m"])[own]
            assert steps.min() >= 0.0
            np.testing.assert_allclose(np.cumsum(steps), s[own], rtol=0.0, atol=1e-9)
            assert s[own][-1] <= form.profile.s[-1] + 1e-9


def test_distances_from_the_first_support(stitched: FormResult) -> None:
    columns = clamp_columns(stitched)
    rows = list(zip(columns["wire"], columns["mark"], columns["from_first_support_m"], strict=True))
    assert [x for wire, mark, x in rows if wire == "messenger wire" and mark == "support S1"] == [0.0]
    assert all(np.isnan(x) for wire, _, x in rows if wire.startswith("stitch"))
    assert any(mark == "start of stitch wire S2" for _, mark, _ in rows)
