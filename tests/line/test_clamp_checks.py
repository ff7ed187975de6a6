"""Stitch wires, mid-point anchors and point masses: where they have no room, and where there is no wire."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.errors import LineFileError
from catenaria.line import Line, load_line

STITCH = {"conductor": "BzII 35", "tension": "2.8 kN", "length": "18 m"}
ANCHOR = {"support": "S2", "conductor": "BzII 35", "tension": "3 kN", "reach": "15 m"}
MASS = {"name": "insulator", "wire": "messenger wire", "chainage": 30.0, "mass": 4.0}


def errors(tree: dict[str, Any]) -> list[tuple[str, str]]:
    with pytest.raises(ValidationError) as caught:
        Line.model_validate(tree)
    return [(".".join(map(str, error["loc"])), error["msg"]) for error in caught.value.errors()]


@pytest.fixture
def held(tree: dict[str, Any]) -> dict[str, Any]:
    """The paper's line, with the contact wire held at its second support too."""
    tree["supports"][1]["contact_wire"] = {"height": 0.0}
    return tree


def test_stitch_wires_are_at_inner_supports_unless_said(tree: dict[str, Any]) -> None:
    assert Line.model_validate(tree).stitched_supports == ()
    tree["stitch_wire"] = STITCH
    assert Line.model_validate(tree).stitched_supports == (1, 2)
    tree["supports"][1]["stitch_wire"] = False
    tree["supports"][2]["stitch_wire"] = True
    assert Line.model_validate(tree).stitched_supports == (2,)


@pytest.mark.parametrize("support", [0, 3])
def test_no_stitch_wire_at_an_end(tree: dict[str, Any], support: int) -> None:
    tree["stitch_wire"] = STITCH
    tree["supports"][support]["stitch_wire"] = True
    assert (
        f"supports.{support}.stitch_wire",
        "false: the messenger wire ends beyond this support",
    ) in errors(tree)


def test_a_stitch_wire_nowhere_described(tree: dict[str, Any]) -> None:
    tree["supports"][1]["stitch_wire"] = True
    ((place, told),) = errors(tree)
    assert place == "supports.1.stitch_wire"
    assert "stitch_wire does not say" in told


@pytest.mark.parametrize(("length", "fits"), [(49.9, True), (50.0, False), (70.0, False)])
def test_stitch_wires_of_two_supports_do_not_overlap(tree: dict[str, Any], length: float, fits: bool) -> None:
    tree["spans"][1] = {"length": 50.0}
    tree["spans"][0]["droppers"] = tree["spans"][2]["droppers"] = {"positions": [4.0]}
    tree["stitch_wire"] = STITCH | {"length": length}
    if fits:
        assert Line.model_validate(tree).stitched_supports == (1, 2)
    else:
        ((place, told),) = errors(tree)
        assert place == "stitch_wire.length"
        assert "less than 50 m, the shortest span beside a stitch wire" in told


@pytest.mark.parametrize(("length", "crowded"), [(18, ()), (8.5, (0, 6)), (27.0, (1, 5)), (26.4, ())])
def test_droppers_keep_away_from_the_ends_of_stitch_wires(
    tree: dict[str, Any], length: float, crowded: tuple[int, ...]
) -> None:
    """Droppers stand 4 and 13.5 m from the supports."""
    tree["stitch_wire"] = STITCH | {"length": length}
    if not crowded:
        assert Line.model_validate(tree).stitched_supports == (1, 2)
        return
    early, late = (f"droppers.positions.{i}" for i in crowded)
    assert [place for place, _ in errors(tree)] == [
        f"spans.{span}.{which}" for span, which in ((0, late), (1, early), (1, late), (2, early))
    ]
    half = length / 2.0
    assert (
        errors(tree)[1][1] == f"0.3 m or more from {half:g} m, the end of a stitch wire on the messenger wire"
    )


def test_what_an_alias_repeats_is_told_once(write: Callable[[str], Path], example_text: str) -> None:
    stitch = "stitch_wire: {conductor: BzII 35, tension: 2.8 kN, length: 8.5 m}\n"
    with pytest.raises(LineFileError) as caught:
        load_line(write(example_text + stitch))
    assert len(caught.value.faults) == 2
    assert [fault.field for fault in caught.value.faults] == [
        "spans[1].droppers.positions[0]",
        "spans[0].droppers.positions[6]",
    ]


def test_stitch_wires_and_an_auxiliary_messenger_do_not_go_together(compound: dict[str, Any]) -> None:
    compound["stitch_wire"] = STITCH | {"length": 14.0}
    assert [place for place, _ in errors(compound)] == ["stitch_wire"]


@pytest.mark.parametrize(
    ("change", "field", "told"),
    [
        ({"support": "S 3"}, "support", "one of the inner supports: S2, S3 (did you mean S3?)"),
        ({"support": "mast"}, "support", "one of the inner supports: S2, S3"),
        ({"support": "S1"}, "support", "an inner support"),
        ({"support": "S4"}, "support", "an inner support"),
        ({"support": "S3"}, "support", "a support that holds the contact wire"),
        ({"reach": 0.4}, "reach", "more than 0.5 m, the clearance"),
        ({"reach": 65.0}, "reach", "less than 65 m, the span beside it"),
        ({"clearance": 0.0}, "clearance", "greater than zero"),
        ({"conductor": "BzII 34"}, "conductor", "did you mean BzII 35?"),
        ({"tension": 3}, "tension", "did you mean 3 kN?"),
    ],
)
def test_mid_points_that_cannot_be(
    held: dict[str, Any], change: dict[str, Any], field: str, told: str
) -> None:
    held["mid_point"] = ANCHOR | change
    ((place, message),) = errors(held)
    assert place == f"mid_point.{field}"
    assert told in message


@pytest.mark.parametrize(
    ("change", "crowded"),
    [
        ({}, []),
        ({"reach": 13.3}, ["spans.0.droppers.positions.5", "spans.1.droppers.positions.1"]),
        ({"reach": 13.19}, []),
        ({"clearance": 4.29}, ["spans.0.droppers.positions.6", "spans.1.droppers.positions.0"]),
        ({"clearance": 4.31}, []),
    ],
)
def test_droppers_keep_away_from_mid_points(
    held: dict[str, Any], change: dict[str, Any], crowded: list[str]
) -> None:
    held["mid_point"] = ANCHOR | change
    if crowded:
        assert [place for place, _ in errors(held)] == crowded
    else:
        assert Line.model_validate(held).mid_point is not None


@pytest.mark.parametrize(("reach", "fits"), [(15.0, True), (9.1, False), (56.1, False)])
def test_a_mid_point_keeps_away_from_stitch_wires(held: dict[str, Any], reach: float, fits: bool) -> None:
    """Its own support's stitch wire ends at 9 m, that of the next support at 56 m."""
    held["stitch_wire"] = STITCH
    held["mid_point"] = ANCHOR | {"reach": reach}
    if fits:
        assert Line.model_validate(held).mid_point is not None
    else:
        assert {place for place, _ in errors(held)} == {"mid_point.reach"}


@pytest.mark.parametrize(
    ("change", "field", "told"),
    [
        ({"wire": "second contact wire"}, "wire", "this line, which has no second contact wire"),
        ({"wire": "auxiliary messenger"}, "wire", "this line, which has no auxiliary messenger"),
        ({"chainage": 0.0}, "chainage", "between 0 and 195 m"),
        ({"chainage": "0.2 km"}, "chainage", "between 0 and 195 m"),
        ({"chainage": 23.005}, "chainage", "10 mm or more from 23 m, where a dropper is clamped"),
        ({"mass": "-1 kg"}, "mass", "not negative"),
    ],
)
def test_masses_that_hang_nowhere(
    tree: dict[str, Any], change: dict[str, Any], field: str, told: str
) -> None:
    tree["point_masses"] = [MASS, MASS | change]
    ((place, message),) = errors(tree)
    assert place == f"point_masses.1.{field}"
    assert told in message


def test_a_wire_is_named_as_it_is_called(tree: dict[str, Any], write: Callable[..., Path]) -> None:
    tree["point_masses"] = [MASS | {"wire": "messenger wires"}]
    with pytest.raises(LineFileError) as caught:
        load_line(write(json.dumps(tree), "line.json"))
    (fault,) = caught.value.faults
    assert fault.field == "point_masses[0].wire"
    assert fault.allowed.startswith("contact wire or second contact wire or auxiliary messenger or messenger")
    assert fault.allowed.endswith("(did you mean messenger wire?)")


@pytest.mark.parametrize(
    "change", [{"chainage": 1e-3}, {"chainage": 194.9}, {"chainage": 23.02}, {"chainage": 65.0}, {"mass": 0}]
)
def test_masses_that_hang_somewhere(tree: dict[str, Any], change: dict[str, Any]) -> None:
    """Negative control."""
    tree["point_masses"] = [MASS | change]
    assert len(Line.model_validate(tree).point_masses) == 1


def test_a_mass_is_only_in_the_way_of_clamps_on_its_own_wire(compound: dict[str, Any]) -> None:
    """The lower droppers at 23 m hold contact wire and auxiliary messenger, the upper ones are elsewhere."""
    for wire, fits in (("messenger wire", True), ("auxiliary messenger", False), ("contact wire", False)):
        compound["point_masses"] = [MASS | {"wire": wire, "chainage": 23.0}]
        if fits:
            assert len(Line.model_validate(compound).point_masses) == 1
        else:
            assert [place for place, _ in errors(compound)] == ["point_masses.0.chainage"]


def test_too_many_supports_do_not_hide_behind_their_stitch_wires(tree: dict[str, Any]) -> None:
    tree["stitch_wire"] = STITCH
    tree["supports"] = [copy.deepcopy(tree["supports"][0]) for _ in range(9)]
    assert [place for place, _ in errors(tree)] == ["supports"]


def test_the_rich_line_has_no_fault(stitched: dict[str, Any]) -> None:
    """Negative control: all of these together."""
    line = Line.model_validate(stitched)
    assert line.stitched_supports == (1, 2, 3, 4)
    assert not line.plane
