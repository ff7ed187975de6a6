"""What a method, or every method, cannot do is refused by name and place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from catenaria.errors import UnsupportedError
from catenaria.line import Line, load_line, refuse_for_method, refuse_unsupported

Write = Callable[..., Path]

ARM = {"height": 0, "kind": "steady arm", "arm": {"length": "1.2 m", "mass": "2 kg", "side": "left"}}
CANTILEVER = {
    "length": 2.0,
    "side": "left",
    "youngs_modulus": "70 GPa",
    "area": "20 cm^2",
    "mass_per_length": "5.4 kg/m",
    "bending_stiffness": 7e4,
}

BEYOND: list[tuple[str, tuple[str | int, ...], Any]] = [
    ("contact_wire.tension.pulled", ("contact_wire", "tension", "pulled"), "end"),
    ("messenger_wire.tension.pulled", ("messenger_wire", "tension", "pulled"), "start"),
    ("contact_wire.tension.device.efficiency", ("contact_wire", "tension", "device"), {"efficiency": 0.97}),
    ("contact_wire.wear", ("contact_wire", "wear"), 0.2),
    ("messenger_wire.anchor_start", ("messenger_wire", "anchor_start"), {"distance": 1}),
    ("contact_wire.anchor_end", ("contact_wire", "anchor_end"), {"height": 0.1}),
    ("supports[0].contact_wire.kind", ("supports", 0, "contact_wire"), ARM),
    ("supports[1].messenger_wire.kind", ("supports", 1, "messenger_wire", "kind"), "clamped"),
    ("supports[1].messenger_wire.kind", ("supports", 1, "messenger_wire", "kind"), "bracket"),
    (
        "supports[1].messenger_wire.kind",
        ("supports", 1, "messenger_wire"),
        {"height": 1.5, "kind": "spring", "stiffness": "50 kN/m"},
    ),
    (
        "supports[1].messenger_wire.kind",
        ("supports", 1, "messenger_wire"),
        {"height": 1.5, "kind": "cantilever", "cantilever": CANTILEVER},
    ),
    ("supports[1].messenger_wire.friction", ("supports", 1, "messenger_wire", "friction"), 0.02),
    ("supports[2].stagger", ("supports", 2, "stagger"), "-20 cm"),
    ("supports[2].messenger_stagger", ("supports", 2, "messenger_stagger"), "-20 cm"),
    ("supports[3].contact_wire.height", ("supports", 3, "contact_wire", "height"), "10 mm"),
    ("supports[2].messenger_wire", ("supports", 2, "messenger_wire", "height"), "1.6 m"),
    ("track.curves", ("track",), {"curves": [{"start": 0, "length": 195, "radius": -800}]}),
    ("track.gradients", ("track",), {"gradients": [{"start": 0, "slope": "5 mm/m"}]}),
    ("dropper.model", ("dropper", "model"), "bar"),
    ("dropper.model", ("dropper", "model"), "rigid"),
    ("second_contact_wire", ("second_contact_wire",), {}),
    ("stitch_wire", ("stitch_wire",), {"conductor": "dropper", "tension": "2 kN", "length": "18 m"}),
    (
        "point_masses",
        ("point_masses",),
        [{"wire": "messenger wire", "chainage": "30 m", "mass": "4 kg"}],
    ),
]


def changed(tree: dict[str, Any], path: tuple[str | int, ...], value: object) -> dict[str, Any]:
    node: Any = tree
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value
    return tree


@pytest.mark.parametrize(("field", "path", "value"), BEYOND)
def test_a_method_for_plane_lines_refuses_by_name(
    tree: dict[str, Any], field: str, path: tuple[str | int, ...], value: object
) -> None:
    line = Line.model_validate(changed(tree, path, value))
    assert not line.plane
    with pytest.raises(UnsupportedError) as caught:
        refuse_for_method(line, "separated", spatial=False)
    assert str(caught.value).startswith(f"{field}: ")
    assert str(caught.value).endswith(
        "is not solved by the method 'separated': only direct and dynamic solve it"
    )
    refuse_for_method(line, "direct", spatial=True)
    refuse_unsupported(line)


@pytest.mark.parametrize("field", ["auxiliary_messenger", "mid_point"])
def test_compound_lines_and_mid_points_are_beyond_the_plane(
    stitched: dict[str, Any], compound: dict[str, Any], field: str
) -> None:
    line = Line.model_validate(compound if field == "auxiliary_messenger" else stitched)
    with pytest.raises(UnsupportedError, match=f"(?m)^{field}: "):
        refuse_for_method(line, "separated", spatial=False)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("contact_wire", "tension", "at"), "start"),
        (("contact_wire", "tension", "measure"), "strain"),
        (("contact_wire", "tension", "device"), {"kind": "spring", "stiffness": "20 kN/m"}),
        (("supports", 2, "stagger"), "0 m"),
        (("supports", 2, "messenger_stagger"), "0 m"),
        (("supports", 1, "stitch_wire"), False),
        (("spans", 1, "contact_wire_height"), [0, -0.01, -0.02, -0.03, -0.02, -0.01, 0]),
        (("spans", 1, "contact_wire_height"), None),
        (("spans", 1, "pre_sag"), "55 mm"),
        (("spans", 1), {"length": 65}),
        (("dropper", "joint"), "frictionless"),
        (("track",), {"rail_spacing": "1.1 m"}),
        (("point_masses",), []),
        (("start_chainage",), 1000),
        (("supports", 3, "contact_wire", "height"), 5e-10),
        (("supports", 2, "messenger_wire", "height"), 1.5 - 5e-10),
    ],
)
def test_what_is_in_the_plane_is_not_refused(
    tree: dict[str, Any], path: tuple[str | int, ...], value: object
) -> None:
    """Negative control: neither the plain line nor neighbouring features are refused."""
    for line in (Line.model_validate(tree), Line.model_validate(changed(tree, path, value))):
        assert line.plane
        refuse_for_method(line, "separated", spatial=False)


def test_stitch_wires_at_no_support_leave_the_line_plane(tree: dict[str, Any]) -> None:
    tree["stitch_wire"] = {"conductor": "dropper", "tension": "2 kN", "length": "18 m"}
    for support in tree["supports"]:
        support["stitch_wire"] = False
    assert Line.model_validate(tree).plane


def test_frictionless_droppers_are_refused_in_space(tree: dict[str, Any]) -> None:
    tree["dropper"]["joint"] = "frictionless"
    tree["supports"][1]["stagger"] = "20 cm"
    line = Line.model_validate(tree)
    with pytest.raises(UnsupportedError, match=r"^dropper.joint: a frictionless .* is not solved$"):
        refuse_unsupported(line)
    with pytest.raises(UnsupportedError, match=r"^dropper.joint: "):
        refuse_for_method(line, "direct", spatial=True)


def test_all_of_them_with_file_line_and_column(write: Write, example_text: str) -> None:
    text = example_text.replace("joint: guided", "model: rigid").replace(
        "  - messenger_wire: {height: 1.5 m}\n", "  - {messenger_wire: {height: 1.5 m}, stagger: 20 cm}\n"
    )
    path = write(text)
    line = load_line(path)
    with pytest.raises(UnsupportedError) as caught:
        refuse_for_method(line, "separated", spatial=False)
    first, second = str(caught.value).splitlines()
    row = text[: text.index("20 cm")].count("\n") + 1
    column = len(text[: text.index("20 cm")].splitlines()[-1]) + 1
    assert ": dropper.model: a dropper modelled as rigid is not solved" in first
    assert second.startswith(f"{path}:{row}:{column}: supports[1].stagger (and 1 more): a stagger other than")


def test_one_of_a_kind_is_not_counted(tree: dict[str, Any]) -> None:
    """Negative control of how many more there are."""
    tree["supports"][1]["stagger"] = 0.2
    with pytest.raises(UnsupportedError) as caught:
        refuse_for_method(Line.model_validate(tree), "separated", spatial=False)
    assert "more" not in str(caught.value)
