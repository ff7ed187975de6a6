"""What can be described but is not solved yet is refused by name and place."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from catenaria.errors import UnsupportedError
from catenaria.line import Line, load_line, refuse_unsupported

Write = Callable[..., Path]

UNSOLVED: list[tuple[str, tuple[str | int, ...], Any]] = [
    ("contact_wire.tension.pulled", ("contact_wire", "tension", "pulled"), "end"),
    ("messenger_wire.tension.pulled", ("messenger_wire", "tension", "pulled"), "start"),
    (
        "supports[0].contact_wire.kind",
        ("supports", 0, "contact_wire"),
        {"height": 0, "kind": "steady arm", "arm": {"length": "1.2 m", "mass": "2 kg"}},
    ),
    ("supports[1].messenger_wire.kind", ("supports", 1, "messenger_wire", "kind"), "clamped"),
    (
        "supports[1].messenger_wire.kind",
        ("supports", 1, "messenger_wire"),
        {"height": 1.5, "kind": "spring", "stiffness": "50 kN/m"},
    ),
    ("supports[2].stagger", ("supports", 2, "stagger"), "-20 cm"),
    ("supports[3].contact_wire.height", ("supports", 3, "contact_wire", "height"), "10 mm"),
    ("supports[2].messenger_wire", ("supports", 2, "messenger_wire", "height"), "1.6 m"),
    ("spans[1].pre_sag", ("spans", 1, "pre_sag"), "55 mm"),
    ("track.curves", ("track",), {"curves": [{"start": 0, "length": 195, "radius": -800}]}),
    ("track.gradients", ("track",), {"gradients": [{"start": 0, "slope": "5 mm/m"}]}),
    (
        "other_wires[0]",
        ("other_wires",),
        [{"name": "Y1", "kind": "stitch", "conductor": "dropper", "start": 58, "end": 72}],
    ),
]


def changed(tree: dict[str, Any], path: tuple[str | int, ...], value: object) -> dict[str, Any]:
    node: Any = tree
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value
    return tree


@pytest.mark.parametrize(("field", "path", "value"), UNSOLVED)
def test_refused_by_name(
    tree: dict[str, Any], field: str, path: tuple[str | int, ...], value: object
) -> None:
    line = Line.model_validate(changed(tree, path, value))
    with pytest.raises(UnsupportedError) as caught:
        refuse_unsupported(line)
    assert str(caught.value).startswith(f"{field}: ")
    assert str(caught.value).endswith("is not solved yet")


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("contact_wire", "tension", "at"), "start"),
        (("contact_wire", "tension", "measure"), "strain"),
        (("supports", 2, "stagger"), "0 m"),
        (("spans", 1, "contact_wire_height"), [0, -0.01, -0.02, -0.03, -0.02, -0.01, 0]),
        (("dropper", "joint"), "frictionless"),
        (("track",), {}),
        (("other_wires",), []),
        (("start_chainage",), 1000),
        (("supports", 3, "contact_wire", "height"), 5e-10),
        (("supports", 2, "messenger_wire", "height"), 1.5 - 5e-10),
    ],
)
def test_what_is_solved_is_not_refused(
    tree: dict[str, Any], path: tuple[str | int, ...], value: object
) -> None:
    """Negative control: neither the plain line nor neighbouring features are refused."""
    refuse_unsupported(Line.model_validate(tree))
    refuse_unsupported(Line.model_validate(changed(tree, path, value)))


def test_all_of_them_with_file_line_and_column(write: Write, example_text: str) -> None:
    text = example_text.replace("    length: 65 m\n", "    length: 65 m\n    pre_sag: 55 mm\n").replace(
        "  - messenger_wire: {height: 1.5 m}\n", "  - {messenger_wire: {height: 1.5 m}, stagger: 20 cm}\n", 1
    )
    path = write(text)
    line = load_line(path)
    with pytest.raises(UnsupportedError) as caught:
        refuse_unsupported(line)
    first, second = str(caught.value).splitlines()  # the pre-sag that aliases repeat stands at one place
    row = text[: text.index("20 cm")].count("\n") + 1
    column = len(text[: text.index("20 cm")].splitlines()[-1]) + 1
    assert first.startswith(f"{path}:{row}:{column}: supports[1].stagger: ")
    assert ": spans[0].pre_sag: " in second


def test_the_same_at_two_places_is_two_complaints(tree: dict[str, Any]) -> None:
    """Negative control of merging what aliases repeat: lines without a file have no marks to merge by."""
    for span in tree["spans"]:
        span["pre_sag"] = "55 mm"
    with pytest.raises(UnsupportedError) as caught:
        refuse_unsupported(Line.model_validate(tree))
    assert len(str(caught.value).splitlines()) == 3
