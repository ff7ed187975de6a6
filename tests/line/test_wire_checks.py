"""Auxiliary messengers, second contact wires, devices, anchors and conductors of the library."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.errors import InconsistentInputError
from catenaria.line import Line, Tension
from catenaria.line.library import conductor_named


def errors(tree: dict[str, Any]) -> list[tuple[str, str]]:
    with pytest.raises(ValidationError) as caught:
        Line.model_validate(tree)
    return [(".".join(map(str, error["loc"])), error["msg"]) for error in caught.value.errors()]


def test_a_compound_line_is_read(compound: dict[str, Any]) -> None:
    line = Line.model_validate(compound)
    assert line.spans[0].auxiliary is not None
    assert line.spans[0].auxiliary.heights == (0.85, 0.8, 0.85)


def test_every_support_holds_the_auxiliary_messenger(compound: dict[str, Any]) -> None:
    del compound["supports"][2]["auxiliary_messenger"]
    assert errors(compound) == [
        ("supports.2.auxiliary_messenger", "a height: every support must hold the auxiliary messenger")
    ]


def test_every_span_with_droppers_holds_the_auxiliary_messenger(compound: dict[str, Any]) -> None:
    del compound["spans"][1]["auxiliary"]
    ((place, _),) = errors(compound)
    assert place == "spans.1.auxiliary"
    compound["spans"][1] = {"length": 40.0}
    assert Line.model_validate(compound).spans[1].auxiliary is None


def test_without_an_auxiliary_messenger_nothing_holds_it(compound: dict[str, Any]) -> None:
    del compound["auxiliary_messenger"]
    places = [place for place, _ in errors(compound)]
    assert places == [
        *(f"supports.{i}.auxiliary_messenger" for i in range(4)),
        *(f"spans.{i}.auxiliary" for i in range(3)),
    ]


@pytest.mark.parametrize(
    ("height", "places"),
    [
        ([0.85, 0.8], ["spans.1.auxiliary.height"]),
        ([0.85, 0.8, 0.85, 0.9], ["spans.1.auxiliary.height"]),
        ([0.85, 0.3, 0.85], ["spans.1.auxiliary.height.1"]),
        (1.5, ["spans.1.auxiliary.height"]),
        ("800 N", ["spans.1.auxiliary.height.[one]"]),
    ],
)
def test_heights_of_the_auxiliary_messenger(compound: dict[str, Any], height: Any, places: list[str]) -> None:
    compound["spans"][1]["auxiliary"]["height"] = height
    assert [place for place, _ in errors(compound)] == places


@pytest.mark.parametrize("height", [0.8, [0.5, 0.4, 0.5], "85 cm"])
def test_heights_of_the_auxiliary_messenger_that_fit(compound: dict[str, Any], height: Any) -> None:
    """Negative control."""
    compound["spans"][1]["auxiliary"]["height"] = height
    assert Line.model_validate(compound).auxiliary_messenger is not None


def test_upper_droppers_are_inside_their_span(compound: dict[str, Any]) -> None:
    compound["spans"][1]["auxiliary"]["droppers"]["positions"] = [10.0, 65.0, 54.0]
    ((place, told),) = errors(compound)
    assert place == "spans.1.auxiliary.droppers.positions.1"
    assert "between 0 and 65 m" in told


@pytest.mark.parametrize(("spacing", "fits"), [("40 mm", True), (0.49, True), (0.5, False), (40, False)])
def test_two_contact_wires_are_close_together(tree: dict[str, Any], spacing: Any, fits: bool) -> None:
    tree["second_contact_wire"] = {"spacing": spacing}
    if fits:
        second = Line.model_validate(tree).second_contact_wire
        assert second is not None
        assert second.droppers == "alternate"
    else:
        assert [place for place, _ in errors(tree)] == ["second_contact_wire.spacing"]


@pytest.mark.parametrize(
    ("tension", "field"),
    [
        ({"device": {"efficiency": 1.1}}, "device.efficiency"),
        ({"device": {"efficiency": 0}}, "device.efficiency"),
        ({"device": {"kind": "spring"}}, "device.stiffness"),
        ({"device": {"kind": "weight", "stiffness": 1e4}}, "device.stiffness"),
        ({"device": {"kind": "wieght"}}, "device.kind"),
    ],
)
def test_devices_that_cannot_be(tree: dict[str, Any], tension: dict[str, Any], field: str) -> None:
    tree["contact_wire"]["tension"] |= tension
    assert [place for place, _ in errors(tree)] == [f"contact_wire.tension.{field}"]


@pytest.mark.parametrize(
    ("tension", "at"),
    [
        ({}, "end"),
        ({"pulled": "both"}, "end"),
        ({"pulled": "start"}, "start"),
        ({"pulled": "end"}, "end"),
        ({"pulled": "start", "at": "end"}, "end"),
        ({"pulled": "both", "at": "start"}, "start"),
    ],
)
def test_a_tension_is_measured_where_the_device_is(tension: dict[str, Any], at: str) -> None:
    given = {"force": 15e3} | tension
    unspoilt = dict(given)
    assert Tension.model_validate(given).at == at
    assert given == unspoilt


def test_the_efficiency_is_what_reaches_the_wire() -> None:
    tension = Tension.model_validate({"force": "15 kN", "device": {"kind": "hydraulic", "efficiency": 0.98}})
    assert tension.on_wire == pytest.approx(14.7e3)
    assert Tension(force=15e3).on_wire == 15e3


@pytest.mark.parametrize(
    ("wear", "fits"), [(0, True), (0.5, True), (0.51, False), (20, False), (-0.1, False)]
)
def test_half_of_a_wire_is_left_at_least(tree: dict[str, Any], wear: float, fits: bool) -> None:
    tree["contact_wire"]["wear"] = wear
    if fits:
        assert Line.model_validate(tree).contact_wire.wear == wear
    else:
        assert [place for place, _ in errors(tree)] == ["contact_wire.wear"]


@pytest.mark.parametrize(
    ("anchor", "field"),
    [
        ({"distance": "35 km"}, "distance"),
        ({"distance": 30.0, "height": 10.0}, "height"),
        ({"distance": 30.0, "stagger": -8.0}, "stagger"),
        ({"height": 0.2}, "height"),
        ({"stagger": 0.2}, "stagger"),
    ],
)
@pytest.mark.parametrize("wire", ["contact_wire", "messenger_wire", "auxiliary_messenger"])
def test_anchors_that_are_nowhere_near(
    compound: dict[str, Any], wire: str, anchor: dict[str, Any], field: str
) -> None:
    """A tail is 0.5 m long: an anchor there is within 0.125 m of straight on."""
    if wire != "contact_wire" and anchor == {"height": 0.2}:
        anchor = {"height": 2.2}
    compound[wire]["anchor_end"] = anchor
    ((place, _),) = errors(compound)
    assert place == f"{wire}.anchor_end.{field}"


@pytest.mark.parametrize(
    "anchor",
    [
        {"distance": 30.0, "height": 7.0, "stagger": 7.5},
        {"height": 0.1},
        {"stagger": -0.1},
        {"distance": 200},
    ],
)
def test_anchors_that_are_near_enough(tree: dict[str, Any], anchor: dict[str, Any]) -> None:
    """Negative control."""
    tree["contact_wire"]["anchor_start"] = anchor
    assert Line.model_validate(tree).contact_wire.anchor_start is not None


def test_conductors_of_the_library_need_not_be_listed(tree: dict[str, Any]) -> None:
    """They are part of the line then: what its results repeat is complete."""
    tree["contact_wire"]["conductor"] = "AC-120 CuETP"
    tree["dropper"]["conductor"] = "BzII 10"
    del tree["conductors"]["contact"], tree["conductors"]["dropper"]
    line = Line.model_validate(tree)
    assert sorted(line.conductors) == ["AC-120 CuETP", "BzII 10", "messenger"]
    assert line.conductor("BzII 10") == conductor_named("BzII 10") == line.conductors["BzII 10"]
    echo = line.model_dump(mode="json")
    assert echo["conductors"]["AC-120 CuETP"]["area"] == pytest.approx(120e-6)
    assert Line.model_validate(echo) == line


def test_a_line_may_have_no_conductors_of_its_own(tree: dict[str, Any]) -> None:
    del tree["conductors"]
    for part, name in (
        ("contact_wire", "AC-120 CuETP"),
        ("messenger_wire", "BzII 120"),
        ("dropper", "Cu 10"),
    ):
        tree[part]["conductor"] = name
    assert len(Line.model_validate(tree).conductors) == 3


def test_own_conductors_win(tree: dict[str, Any]) -> None:
    tree["conductors"]["BzII 70"] = tree["conductors"].pop("messenger")
    tree["messenger_wire"]["conductor"] = "BzII 70"
    line = Line.model_validate(tree)
    assert pytest.approx(12.5001e6) == line.conductor("BzII 70").EA
    assert pytest.approx(12.5001e6) != conductor_named("BzII 70").EA


def test_the_library_does_not_fill_lines_that_do_not_use_it(tree: dict[str, Any]) -> None:
    """Negative control; and what is not used can still be asked for."""
    line = Line.model_validate(tree)
    assert sorted(line.conductors) == ["contact", "dropper", "messenger"]
    assert line.conductor("BzII 70") == conductor_named("BzII 70")
    with pytest.raises(InconsistentInputError, match="BzII 71"):
        line.conductor("BzII 71")


@pytest.mark.parametrize("part", ["contact_wire", "messenger_wire", "auxiliary_messenger", "dropper"])
def test_a_conductor_that_nobody_knows(compound: dict[str, Any], part: str) -> None:
    compound[part]["conductor"] = "BzII 71"
    ((place, told),) = errors(compound)
    assert place == f"{part}.conductor"
    assert "strand, those of the library (did you mean BzII 70?)" in told


@pytest.mark.parametrize(("height", "fits"), [(1.5, True), (1.6, False), (-1.6, False)])
def test_the_contact_wire_is_lifted_within_reason(tree: dict[str, Any], height: float, fits: bool) -> None:
    tree["supports"][3]["contact_wire"]["height"] = height
    for support in tree["supports"]:
        support["messenger_wire"]["height"] = 4.0
    for span in tree["spans"]:
        del span["contact_wire_height"]
    if fits:
        assert Line.model_validate(tree).contact_heights[-1] == height
    else:
        ((place, told),) = errors(tree)
        assert place == "supports.3.contact_wire.height"
        assert "within 1.5 m of 0 m" in told


def test_a_cantilever_is_as_plausible_as_a_conductor(stitched: dict[str, Any]) -> None:
    stitched["supports"][3]["messenger_wire"]["cantilever"]["youngs_modulus"] = 70.0
    ((place, told),) = errors(stitched)
    assert place == "supports.3.messenger_wire.cantilever.youngs_modulus"
    assert "did you mean 70 GPa?" in told
