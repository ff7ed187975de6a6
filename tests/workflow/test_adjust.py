"""From files to an adjustment on disk."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from catenaria.results import FormResult, load_result, save_result
from catenaria.results.adjustment import Adjustment
from catenaria.workflow import adjust, solve, write_adjustment

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def found() -> FormResult:
    return solve(EXAMPLES / "yang2017_three_span.yaml")


@pytest.fixture(scope="module")
def study(found: FormResult) -> Adjustment:
    return adjust(found, EXAMPLES / "measured_heights.csv")


def test_the_example_names_the_droppers_that_are_wrong(study: Adjustment) -> None:
    droppers, only = study.droppers, study.droppers.adjusted
    places = zip(droppers.span[only].tolist(), droppers.number[only].tolist(), strict=True)
    expected = {(1, 4): -0.030, (2, 2): 0.020, (3, 5): -0.015}
    assert dict(zip(places, droppers.change[only].tolist(), strict=True)) == pytest.approx(expected)
    assert study.largest_deviation(droppers.height_after) < 0.002


def test_a_result_on_disk_gives_the_same(found: FormResult, study: Adjustment, tmp_path: Path) -> None:
    save_result(found, tmp_path)
    heard: list[str] = []
    again = adjust(tmp_path, EXAMPLES / "measured_heights.csv", progress=heard.append)
    np.testing.assert_array_equal(again.droppers.change, study.droppers.change)
    assert len(heard) == 1 + study.passes


def test_everything_is_written(study: Adjustment, tmp_path: Path) -> None:
    files = write_adjustment(study, tmp_path / "out")
    names = {file.name for file in files}
    assert {"adjust.csv", "heights.csv", "measured.csv", "adjust.png", "result.json"} <= names
    with (tmp_path / "out" / "adjust.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [(row["span"], row["dropper"], row["action"]) for row in rows] == [
        ("1", "4", "shorten"),
        ("2", "2", "lengthen"),
        ("3", "5", "shorten"),
    ]
    assert [float(row["change_mm"]) for row in rows] == [-30.0, 20.0, -15.0]
    for row in rows:
        assert abs(float(row["height_after_m"])) < 0.002 < abs(float(row["height_before_m"]))


def test_what_is_saved_is_loaded_again(study: Adjustment, tmp_path: Path) -> None:
    save_result(study, tmp_path)
    again = load_result(tmp_path, Adjustment)
    np.testing.assert_array_equal(again.droppers.height_after, study.droppers.height_after)
    assert (again.fewest, again.passes, again.supports) == (study.fewest, study.passes, study.supports)


def test_a_table_of_nothing_to_do_has_a_header_only(found: FormResult, tmp_path: Path) -> None:
    file = tmp_path / "as_found.csv"
    file.write_text("span,dropper,height_m\n1,1,0.001\n", encoding="utf-8")
    write_adjustment(adjust(found, file), tmp_path / "out")
    assert len((tmp_path / "out" / "adjust.csv").read_text(encoding="utf-8").splitlines()) == 1
