"""Methods side by side."""

from __future__ import annotations

import csv
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError, NotConvergedError, UnsupportedError
from catenaria.line import Line
from catenaria.workflow import METHODS, Compared, compare, write_comparison

Vary = Callable[[dict[str, Any]], Line]
FEW = ("separated", "force density")


@pytest.fixture(scope="module")
def compared(small: Line) -> tuple[Compared, ...]:
    return compare(small, FEW)


def test_the_direct_method_is_the_reference(compared: tuple[Compared, ...]) -> None:
    assert [each.method for each in compared] == ["direct", *FEW]
    assert compared[0].differences is not None
    assert compared[0].differences.largest_length == 0.0
    assert compared[0].differences.largest_height == 0.0


def test_differences_are_those_of_the_results(compared: tuple[Compared, ...]) -> None:
    direct, separated, _ = compared
    assert direct.result is not None
    assert separated.result is not None
    assert separated.differences is not None
    length = separated.result.droppers.length - direct.result.droppers.length
    np.testing.assert_array_equal(separated.differences.length, length)
    assert separated.differences.largest_length == np.abs(length).max() > 1e-4
    assert separated.differences.largest_height == pytest.approx(np.abs(length).max(), rel=0.5)
    assert separated.result.audit.passed
    assert separated.iterations == separated.result.counters[0].steps
    assert separated.time > 0.0


def test_methods_for_strings_hardly_differ_along_the_line(compared: tuple[Compared, ...]) -> None:
    """Heights between the points of profiles, too: kinks at droppers are not cut."""
    one, other = (each.differences for each in compared[1:])
    assert one is not None
    assert other is not None
    np.testing.assert_allclose(one.height, other.height, atol=1e-6)


def test_an_unknown_method_is_refused(small: Line) -> None:
    with pytest.raises(UnsupportedError, match="'newton'; there is direct, dynamic, separated"):
        compare(small, ["newton"])


def test_what_a_method_refuses_is_told(vary: Vary) -> None:
    heard: list[str] = []
    direct, separated = compare(vary({"dropper.joint": "frictionless"}), ["separated"], heard.append)
    assert direct.result is not None
    assert (separated.result, separated.refused) == (None, True)
    assert "frictionless" in separated.failure
    assert heard == ["direct", "separated"]


def test_methods_for_plane_lines_are_refused_lines_in_space(vary: Vary) -> None:
    direct, separated = compare(vary({"contact_wire.tension.pulled": "end"}), ["separated"])
    assert direct.result is not None
    assert (separated.result, separated.refused) == (None, True)
    assert "contact_wire.tension.pulled" in separated.failure
    assert "'separated': only direct and dynamic solve it" in separated.failure


def test_a_method_that_does_not_converge_is_told(small: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    class Lost:
        def __init__(self, listener: object) -> None: ...

        def find_form(self, line: Line) -> None:
            raise NotConvergedError("lost", "none")

    monkeypatch.setitem(import_module("catenaria.workflow.methods").METHODS, "separated", Lost)
    _, separated = compare(small, ["separated"])
    assert (separated.result, separated.refused) == (None, False)
    assert "lost" in separated.failure


def test_a_failure_of_the_direct_method_is_a_failure(vary: Vary) -> None:
    with pytest.raises(UnsupportedError, match=r"dropper\.joint"):
        compare(vary({"contact_wire.tension.pulled": "end", "dropper.joint": "frictionless"}))


def test_all_methods_are_compared_by_default(small: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    methods = {name: METHODS[name] for name in ("direct", "separated")}
    monkeypatch.setattr(import_module("catenaria.workflow.compare"), "METHODS", methods)
    assert [each.method for each in compare(small)] == ["direct", "separated"]


def test_table_and_figure_are_written(compared: tuple[Compared, ...], tmp_path: Path) -> None:
    files = write_comparison(compared, tmp_path / "out")
    assert {file.name for file in files} == {"differences.csv", "differences.png"}
    with (tmp_path / "out" / "differences.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert compared[1].differences is not None
    n = compared[1].differences.length.size
    assert [row["method"] for row in rows] == [name for name in FEW for _ in range(n)]
    written = [float(row["length_difference_m"]) for row in rows[:n]]
    np.testing.assert_allclose(written, compared[1].differences.length, atol=1e-8)
    assert [file.name for file in write_comparison(compared, tmp_path / "out", figures=False)] == [
        "differences.csv"
    ]


def test_a_folder_with_other_files_is_refused(compared: tuple[Compared, ...], tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"mine\.txt"):
        write_comparison(compared, tmp_path)
