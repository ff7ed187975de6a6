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
    assert ("Line", "speed") not in table


def test_the_speed_is_shown_if_there_is_one(tree: dict[str, Any]) -> None:
    tree["speed"] = "250 km/h"
    assert flat(Line.model_validate(tree))["Line", "speed"] == "250 km/h"


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


def test_a_plain_line_has_no_section_of_what_it_does_not_have(example_path: Path) -> None:
    titles = [title for title, _ in summarise(load_line(example_path))]
    assert titles == ["Line", "Contact wire", "Messenger wire", "Droppers", "Prescribed", "Dynamic method"]


def test_a_rich_line_in_short(stitched: dict[str, Any]) -> None:
    table = flat(Line.model_validate(stitched))
    arms = "at all supports (3 pull-off arm, 1 push-off arm), height 5.5 to 6 m"
    assert table["Line", "contact wire held"] == arms
    assert table["Line", "messenger held"] == "2 sliding, 1 spring, 1 clamped, 1 cantilever, 1 bracket"
    assert table["Line", "friction"] == "0 to 0.02"
    assert table["Line", "stagger"] == "-0.2 to 0.2 m"
    assert ("Line", "messenger stagger") not in table
    assert table["Line", "curve"] == "radius 800 m to the right from 1050 m, 150 m long, cant 100 mm"
    assert table["Line", "gradient"] == "5 mm/m from 1000 m"
    assert table["Contact wire", "pulled"] == "at the end only, by a weight"
    assert table["Contact wire", "efficiency"] == "0.97: 14.55 kN on the wire"
    assert table["Contact wire", "wear"] == "10 % of the section"
    assert table["Contact wire", "second wire"] == "40 mm beside it, droppers: both"
    assert table["Contact wire", "tails"] == "0.5 m beyond the end supports"
    end = "30 m beyond the support, height 6.5 m, stagger 1.5 m"
    assert table["Contact wire", "anchor at the end"] == end
    assert table["Stitch wires", "number"] == "4"
    assert table["Mid-point anchor", "reach"] == "12 m on the messenger, 0.5 m on the contact wire"
    assert table["Point masses", "contact wire"] == "insulator, 5 kg"
    assert table["Point masses", "messenger wire"] == "4 kg"
    assert table["Droppers", "number"] == "48"
    assert table["Droppers", "model"] == "rigid"
    # contact wires, messenger wire, four stitch wires, two wires of the anchor
    assert table["Prescribed", "wanted"] == "9 tensions + 48 heights"
    assert table["Prescribed", "found"] == "9 wire lengths + 48 dropper lengths"


def test_a_compound_line_in_short(compound: dict[str, Any]) -> None:
    table = flat(Line.model_validate(compound))
    assert table["Auxiliary messenger", "tension"] == "8 kN, measured as reaction at the end"
    assert table["Droppers", "number"] == "21"
    assert table["Droppers", "auxiliary messenger's"] == "9"
    assert table["Prescribed", "wanted"] == "3 tensions + 30 heights"


def test_all_cells_are_filled(example_path: Path, stitched: dict[str, Any], compound: dict[str, Any]) -> None:
    for line in (load_line(example_path), *map(Line.model_validate, (stitched, compound))):
        assert all(label and value for _, rows in summarise(line) for label, value in rows)
