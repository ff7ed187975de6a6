"""The short table of what a file describes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from catenaria.line import Line, load_line, summarise


def flat(line: Line) -> dict[tuple[str, str], str]:
    return {(title, label): value for title, rows in summarise(line) for label, value in rows}


def test_the_example_in_short(example_path: Path) -> None:
    table = flat(load_line(example_path))
    assert table["Line", "spans"] == "3 x 65 m"
    assert table["Line", "length"] == "195 m"
    assert table["Line", "contact wire held"] == "at S1, S4, height 0 m"
    assert table["Contact wire", "EA"] == "15.6 MN"
    assert table["Contact wire", "mass per length"] == "0.9252 kg/m"
    assert table["Messenger wire", "tension"] == "15 kN, measured as reaction at the end"
    assert table["Droppers", "in each span"] == "3 x 7"
    assert table["Prescribed", "wanted"] == "2 tensions + 21 heights"
    assert table["Prescribed", "found"] == "2 wire lengths + 21 dropper lengths"


def test_the_table_follows_the_line(tree: dict[str, Any]) -> None:
    """Negative control: other lines give other tables."""
    tree["spans"][2] = {"length": 50, "droppers": {"positions": [10, 40]}, "contact_wire_height": [0, -0.02]}
    tree["messenger_wire"]["tension"] = {"force": 12_500, "measure": "strain", "at": "start"}
    table = flat(Line.model_validate(tree))
    assert table["Line", "spans"] == "2 x 65 m, 50 m"
    assert table["Droppers", "in each span"] == "2 x 7, 2"
    assert table["Droppers", "wanted heights"] == "-0.02 to 0 m"
    assert table["Messenger wire", "tension"] == "12.5 kN, measured as strain at the start"
    assert table["Prescribed", "found"] == "2 wire lengths + 16 dropper lengths"
    assert ("Line", "name") not in table


def test_wanted_and_found_are_counted_on_their_own(tree: dict[str, Any]) -> None:
    """Negative control: a line that did not pass the checks shows that its two sides differ."""
    line = Line.model_validate(tree)
    span = line.spans[1].model_copy(update={"contact_wire_height": (0.0,) * 9})
    table = flat(line.model_copy(update={"spans": (line.spans[0], span, line.spans[2])}))
    assert table["Prescribed", "wanted"] == "2 tensions + 23 heights"
    assert table["Prescribed", "found"] == "2 wire lengths + 21 dropper lengths"


def test_all_cells_are_filled(example_path: Path) -> None:
    assert all(label and value for _, rows in summarise(load_line(example_path)) for label, value in rows)
