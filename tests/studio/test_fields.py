"""Fields: what they show, what they write, and which faults are theirs."""

from __future__ import annotations

import pytest

from catenaria.errors import Fault
from catenaria.studio.documents import EXAMPLES, Document, example, replaced
from catenaria.studio.fields import Field, entered, message, shown, unplaced
from catenaria.studio.forms import all_fields, conductor_names
from catenaria.studio.solve import solved

STAGGER = Field(("supports", 0, "stagger"), "stagger", "mm")
FORCE = Field(("contact_wire", "tension", "force"), "tension", "kN")
DROPPERS = Field(("spans", 0, "droppers"), "droppers", "m", kind="positions")
HEIGHT = Field(("spans", 0, "contact_wire_height"), "height", "m", kind="list")


@pytest.mark.parametrize(
    ("value", "text"),
    [("15 kN", "15"), (15000, "15"), ("15 000 N", "15 000 N"), ("12.5kN", "12.5"), ("15 kg", "15 kg")],
)
def test_a_force_is_shown_in_kilonewtons(value: object, text: str) -> None:
    assert shown(FORCE, replaced({}, FORCE.path, value)) == text


@pytest.mark.parametrize(
    ("text", "value"),
    [("16", "16 kN"), ("16000 N", "16000 N"), (" 1.6e1 ", "1.6e1 kN"), ("x", "x"), ("15,5", "15,5")],
)
def test_a_bare_number_has_the_unit_of_the_heading(text: str, value: object) -> None:
    tree = entered(FORCE, {}, text)
    assert tree == replaced({}, FORCE.path, value)


@pytest.mark.parametrize("name", EXAMPLES)
def test_entering_what_is_shown_changes_nothing(name: str) -> None:
    document = example(name)
    line = solved(document).result
    assert line is not None
    tree = document.tree
    for field in all_fields(tree):
        tree = entered(field, tree, shown(field, tree))
    again = solved(Document(name, tree)).result
    assert again is not None
    assert again.droppers.cut_length == pytest.approx(line.droppers.cut_length, abs=1e-7)


def test_droppers_are_a_list_with_or_without_units() -> None:
    spans = {"spans": [{"droppers": {"first": "4 m", "spacing": 6.5, "count": 3}}]}
    assert shown(DROPPERS, spans) == "4, 10.5, 17"
    tree = entered(DROPPERS, spans, "4; 10, 1500 cm")
    assert tree == {"spans": [{"droppers": {"positions": ["4 m", "10 m", "1500 cm"]}}]}
    assert shown(DROPPERS, tree) == "4, 10, 15"
    assert entered(DROPPERS, {"spans": [{"length": 60, "droppers": {"positions": [4]}}]}, "") == {
        "spans": [{"length": 60}]
    }


def test_a_billion_droppers_are_a_fault_and_not_a_list(paper: Document) -> None:
    many = {"first": 0.1, "spacing": 1e-8, "count": 10**9}
    tree = replaced(paper.tree, ("spans", 0, "droppers"), many)
    assert shown(DROPPERS, tree) == str(many)
    faults = solved(Document("many", tree)).faults
    assert "1000 or less" in message(DROPPERS, faults)


def test_a_faulty_list_is_shown_as_it_stands() -> None:
    tree = entered(DROPPERS, {"spans": [{}]}, "4, here, 17")
    assert shown(DROPPERS, tree) == "4, here, 17"


def test_one_height_or_a_list() -> None:
    assert entered(HEIGHT, {"spans": [{}]}, "5.5") == {"spans": [{"contact_wire_height": 5.5}]}
    assert entered(HEIGHT, {"spans": [{}]}, "5.5, 5.4")["spans"][0]["contact_wire_height"] == [5.5, 5.4]


def test_a_field_takes_the_place_of_the_other_that_says_the_same() -> None:
    path, other = ("spans", 0, "pre_sag_per_mille"), ("spans", 0, "pre_sag")
    per_mille = Field(path, "pre-sag", "‰", "number", instead=other)
    tree = entered(per_mille, {"spans": [{"pre_sag": "30 mm"}]}, "0.5")
    assert tree == {"spans": [{"pre_sag_per_mille": 0.5}]}


@pytest.mark.parametrize(
    ("path", "text", "says"),
    [
        (("spans", 1, "length"), "65 kg", 'found "65 kg"'),
        (("spans", 1, "length"), "-65", "greater than zero"),
        (("spans", 1, "droppers"), "4, 3, 61", "ascending order"),
        (("spans", 1, "droppers"), "4, 300", "inside the span"),
        (("supports", 0, "stagger"), "3000", "within 1 m"),
        (("contact_wire", "tension", "force"), "15 km", "a force"),
        (("contact_wire", "conductor"), "AC-120 CuMg", "AC-120"),
        (("speed",), "200 kg", "km/h"),
    ],
)
def test_bad_input_is_marked_at_its_field_only(
    paper: Document, path: tuple[str | int, ...], text: str, says: str
) -> None:
    (field,) = [field for field in all_fields(paper.tree) if field.path == path]
    tree = entered(field, paper.tree, text)
    faults = solved(Document("bad", tree)).faults
    marked = {field.path: message(field, faults) for field in all_fields(tree) if message(field, faults)}
    assert list(marked) == [path]
    assert says in marked[path]
    assert unplaced(all_fields(tree), faults) == []


def test_what_is_missing_is_marked_where_it_would_stand(paper: Document) -> None:
    (field,) = [
        field for field in all_fields(paper.tree) if field.name == "supports[1].messenger_wire.height"
    ]
    tree = entered(field, paper.tree, "")
    faults = solved(Document("bad", tree)).faults
    marked = [field.name for field in all_fields(tree) if message(field, faults)]
    assert marked == [field.name, "supports[1].messenger_wire.encumbrance"]


def test_what_no_field_shows_is_left_over(paper: Document) -> None:
    tree = replaced(paper.tree, ("solver", "mesh", "largest_element"), "1 kg")
    faults = solved(Document("bad", tree)).faults
    assert [fault.field for fault in unplaced(all_fields(tree), faults)] == ["solver.mesh.largest_element"]


def test_neighbours_with_longer_names_do_not_share_faults() -> None:
    fault = Fault("line", 0, 0, "spans[0].pre_sag_per_mille", "20", "less")
    assert message(Field(("spans", 0, "pre_sag"), "pre-sag", "mm"), [fault]) == ""
    assert message(Field(("spans", 0), "span"), [fault]) == "found 20; allowed: less"


def test_conductors_of_the_line_come_first(paper: Document) -> None:
    assert conductor_names(paper.tree)[:3] == ("contact", "messenger", "dropper")
    assert "BzII 70" in conductor_names({"conductors": "nonsense"})


def test_units_of_hundreds_of_factors_are_shown_as_they_stand() -> None:
    unit = "1" + " m" * 2000
    speed, droppers = Field(("speed",), "speed", "km/h"), Field(("d",), "d", "m", kind="positions")
    assert shown(speed, {"speed": unit}) == unit
    assert shown(droppers, {"d": {"positions": [unit]}}) == unit
    assert shown(speed, {"speed": "36" + "0" * 3 + " m/h"}) == "36"
