"""Slips of the pen that are numbers of the right kind: forgotten prefixes, heights from another level."""

from __future__ import annotations

import copy
from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.line import Line

SLIPS: list[tuple[tuple[str | int, ...], Any, str]] = [
    (("conductors", "contact", "area"), 120, "did you mean 120 mm"),
    (("conductors", "messenger", "youngs_modulus"), 81.7, "did you mean 81.7 GPa"),
    (("conductors", "dropper", "density"), 8.9, "did you mean 8.9 g/cm"),
    (("contact_wire", "tension", "force"), 15, "did you mean 15 kN"),
    (("messenger_wire", "tension", "force"), "15 MN", "a plausible value"),
    (("spans", 1, "contact_wire_height"), -1.0, "0.5 m"),
    (("spans", 1, "contact_wire_height"), 5.3, "0.5 m"),
    (("supports", 1, "messenger_wire", "height"), 1500, "at most 200 m above the contact wire, which is"),
    (("supports", 0, "contact_wire", "height"), -5300, "within 20 m of the rails"),
]
FINE: list[tuple[tuple[str | int, ...], Any]] = [
    (("conductors", "contact", "area"), "80 mm^2"),
    (("conductors", "contact", "area"), "185 mm^2"),
    (("contact_wire", "tension", "force"), "4 kN"),
    (("messenger_wire", "tension", "force"), "33 kN"),
    (("spans", 1, "contact_wire_height"), "-55 mm"),
    (("supports", 1, "messenger_wire", "height"), "3.2 m"),
]


def changed(tree: dict[str, Any], path: tuple[str | int, ...], value: Any) -> dict[str, Any]:
    tree = copy.deepcopy(tree)
    place: Any = tree
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return tree


@pytest.mark.parametrize(("path", "value", "hint"), SLIPS)
def test_a_slip_is_refused_with_what_was_probably_meant(
    tree: dict[str, Any], path: tuple[str | int, ...], value: Any, hint: str
) -> None:
    with pytest.raises(ValidationError) as caught:
        Line.model_validate(changed(tree, path, value))
    assert hint in str(caught.value)


@pytest.mark.parametrize(("path", "value"), FINE)
def test_what_is_built_is_not_refused(tree: dict[str, Any], path: tuple[str | int, ...], value: Any) -> None:
    assert isinstance(Line.model_validate(changed(tree, path, value)), Line)
