"""Symmetries of lines: mirrored, and scaled in force, in length, in gravity.

Each turns a line into another one and its form into that one's form; nothing in the program knows of them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.line import Line, load_line
from catenaria.results import FormResult
from catenaria.workflow import solve

FloatArray = NDArray[np.float64]
Change = dict[str, Any]
View = dict[str, FloatArray]

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"

SPANS = (
    (50.0, (4.0, 14.5, 25.0, 35.5, 46.0), (0.0, -0.012, -0.02, -0.01, 0.0)),
    (65.0, (4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0), (0.0,) * 7),
    (57.0, (3.0, 12.0, 24.0, 36.0, 48.0), (0.0, 0.0, -0.005, -0.008, 0.0)),
)
HELD = (True, False, True, True)  # the contact wire, at the four supports


def lopsided(joint: str, measure: str) -> Line:
    """Return a line without any symmetry of its own."""
    data = load_line(EXAMPLE).model_dump()
    messenger, contact = {"messenger_wire": {"height": 1.4}}, {"contact_wire": {"height": 0.0}}
    data["supports"] = [messenger | contact if held else messenger for held in HELD]
    data["spans"] = [
        {"length": length, "droppers": {"positions": x}, "contact_wire_height": height}
        for length, x, height in SPANS
    ]
    data["dropper"] |= {"joint": joint, "clamp_mass_top": 0.2, "clamp_mass_bottom": 0.15}
    for wire, force in (("contact_wire", 14e3), ("messenger_wire", 16e3)):
        data[wire]["tension"] |= {"force": force, "measure": measure}
    data["solver"]["mesh"] |= {"fine": (0.1, 0.3), "largest_element": 2.4}
    return Line.model_validate(data)


KINDS = [("guided", "reaction"), ("frictionless", "reaction"), ("guided", "strain")]


@cache
def found(kind: tuple[str, str]) -> tuple[Line, FormResult]:
    line = lopsided(*kind)
    return line, solve(line)


def view(line: Line, result: FormResult) -> View:
    """Return a form from the first support to the last: lengths "m ...", forces "N ..."."""
    droppers, supports, origin = result.droppers, result.supports, line.support_x[0]
    seen = {
        "m dropper x": droppers.x - origin,
        "m length": droppers.length,
        "m unstressed length": droppers.unstressed_length,
        "m height": droppers.height,
        "m messenger height": droppers.messenger_height,
        "m contact coordinate": droppers.contact_coordinate,
        "m messenger coordinate": droppers.messenger_coordinate,
        "N force top": droppers.force_top,
        "N force bottom": droppers.force_bottom,
        "N on contact": droppers.on_contact,
        "N on messenger": droppers.on_messenger,
    }
    for wire in result.wires:
        here = np.array(supports.wire) == wire.name
        force = np.column_stack((supports.force_x, supports.force_y, supports.force_z))[here]
        seen |= {
            f"m {wire.name} travel": np.array([wire.travel]),
            f"m {wire.name} sag": np.array([wire.sag]),
            f"m {wire.name} lengths": np.array([wire.unstressed_length, wire.stretched_length]),
            f"m {wire.name} at supports": supports.sliding_coordinate[here],
            f"N {wire.name} on supports": force,
            f"N {wire.name} on devices": wire.end_force,
        }
    return seen | profiles(line, result)


def profiles(line: Line, result: FormResult) -> View:
    """Return the wires' configurations, which can be compared on equal meshes."""
    seen: View = {}
    for wire in result.wires:
        profile = wire.profile
        seen |= {
            f"m {wire.name} s": profile.s,
            f"m {wire.name} x": profile.x - line.support_x[0],
            f"m {wire.name} z": profile.z,
            f"N {wire.name} tension": profile.tension,
        }
    return seen


def check_same(found: View, wanted: View, metres: float, newtons: float) -> None:
    for name, value in wanted.items():
        tolerance = newtons if name.startswith("N") else metres
        np.testing.assert_allclose(found[name], value, rtol=0.0, atol=tolerance, err_msg=name)


def wanted_heights(line: Line) -> list[list[float]]:
    """Return the wanted heights of each span."""
    pairs = list(zip(line.dropper_span, line.dropper_target_height, strict=True))
    return [[height for span, height in pairs if span == i] for i in range(len(line.spans))]


def mirrored(line: Line) -> Line:
    """Return the line as seen from the other side of the track."""
    data = line.model_dump()
    data["start_chainage"] = -line.support_x[-1]
    data["supports"] = [support | {"name": ""} for support in reversed(data["supports"])]
    data["spans"] = [
        {
            "length": span.length,
            "droppers": {"positions": [span.length - x for x in reversed(span.droppers.x)]},
            "contact_wire_height": heights[::-1],
        }
        for span, heights in reversed(list(zip(line.spans, wanted_heights(line), strict=True)))
    ]
    for wire in ("contact_wire", "messenger_wire"):
        at = data[wire]["tension"]["at"]
        data[wire]["tension"]["at"] = "start" if at == "end" else "end"
    return Line.model_validate(data)


def from_behind(line: Line, result: FormResult, seen: View) -> View:
    """Return a form as seen from the other side: reversed, x and forces along the track turned round."""
    turned: View = {}
    starts = {wire.name: wire.start_x[-1] - wire.start_x[0] for wire in result.wires}
    for name, value in seen.items():
        reverse = value if name.endswith("lengths") else value[::-1]
        if value.ndim == 2:
            reverse = reverse * np.array([-1.0, 1.0, 1.0])
        if name.endswith(" x"):
            reverse = line.length - reverse
        for wire, length in starts.items():
            if name.endswith((f"{wire} s", f"{wire} at supports", f"{wire.split()[0]} coordinate")):
                reverse = length - reverse
        turned[name] = reverse
    return turned


@pytest.mark.parametrize("kind", KINDS, ids=" ".join)
def test_the_mirrored_line_has_the_mirrored_form(kind: tuple[str, str]) -> None:
    """Lengths to a nanometre, forces to 10 uN: nothing but rounding may tell the ends of a line apart."""
    line, result = found(kind)
    seen, other = view(line, result), mirrored(line)
    behind = view(other, solve(other))
    check_same(behind, from_behind(line, result, seen), 1e-9, 1e-5)
    assert np.abs(behind["m length"] - seen["m length"]).max() > 0.05


def test_a_line_that_is_not_quite_the_mirrored_one_is_noticed() -> None:
    line, result = found(KINDS[0])
    data = mirrored(line).model_dump()
    data["spans"][0]["droppers"]["positions"] = [9.01, *data["spans"][0]["droppers"]["positions"][1:]]
    other = Line.model_validate(data)
    with pytest.raises(AssertionError):
        check_same(view(other, solve(other)), from_behind(line, result, view(line, result)), 1e-4, 1e-2)


def scaled(line: Line, length: float = 1.0, force: float = 1.0, gravity: float = 1.0) -> Line:
    """Return the similar line whose form has all lengths and all forces multiplied by the given factors.

    Strains are to be the same, so EA goes with force, EJ with force times length squared, weight per length
    with force over length.
    """
    data = line.model_dump()
    data["gravity"] *= gravity
    data["dropper"]["guessed_length"] *= length
    data["start_chainage"] *= length
    for conductor in data["conductors"].values():
        conductor["youngs_modulus"] *= force
        conductor["bending_stiffness"] *= force * length**2
        conductor["density"] *= force / length / gravity
    for wire in ("contact_wire", "messenger_wire"):
        data[wire]["tension"]["force"] *= force
        data[wire]["tail"] *= length
    for mass in ("clamp_mass_top", "clamp_mass_bottom"):
        data["dropper"][mass] *= force / gravity
    for support in data["supports"]:
        support["messenger_wire"]["height"] *= length
    mesh = data["solver"]["mesh"]
    mesh["fine"] = tuple(length * fine for fine in mesh["fine"])
    mesh["largest_element"] *= length
    data["spans"] = [
        {
            "length": length * span.length,
            "droppers": {"positions": [length * x for x in span.droppers.x]},
            "contact_wire_height": [length * height for height in heights],
        }
        for span, heights in zip(line.spans, wanted_heights(line), strict=True)
    ]
    return Line.model_validate(data)


def multiplied(seen: View, length: float, force: float) -> View:
    return {name: value * (force if name.startswith("N") else length) for name, value in seen.items()}


SIMILAR: dict[str, tuple[float, float, float]] = {
    "heavier and stiffer": (1.0, 3.7, 1.0),
    "lighter and softer": (1.0, 0.15, 1.0),
    "in another gravity": (1.0, 1.0, 0.3),
    "larger": (1.3, 1.0, 1.0),
    "smaller": (0.6, 1.0, 1.0),
    "all at once": (0.8, 2.1, 1.6),
}
CASES = [
    (kind, factors)
    for kind in KINDS
    for factors in SIMILAR.values()
    if factors[0] == 1.0 or kind[1] == "reaction"  # strain at a point depends on the mesh, see below
]


def check_similar(kind: tuple[str, str], other: Line, factors: tuple[float, float, float]) -> None:
    """Check a line against the similar one.

    Newton's method ends when corrections are below 1e-9 m and 1e-5 N, which do not scale. Nodes stand at
    round material coordinates, so that meshes of longer and shorter lines are not quite similar.
    """
    line, result = found(kind)
    length, force, _ = factors
    wanted, mesh = view(line, result), profiles(line, result)
    same = length == 1.0
    wanted = {name: value for name, value in wanted.items() if same or name not in mesh}
    metres, newtons = (1e-8, 1e-4) if same else (3e-6, 0.01)
    check_same(view(other, solve(other)), multiplied(wanted, length, force), metres, newtons)


@pytest.mark.parametrize(("kind", "factors"), CASES)
def test_a_similar_line_has_the_similar_form(
    kind: tuple[str, str], factors: tuple[float, float, float]
) -> None:
    check_similar(kind, scaled(found(kind)[0], *factors), factors)


def with_factor(wrong: str) -> Callable[[Line], Line]:
    """Return a way to change one quantity of a line by 0.1 %."""

    def changed(line: Line) -> Line:
        data = line.model_dump()
        *way, last = wrong.split(".")
        place: Any = data
        for key in way:
            place = place[key]
        place[last] *= 1.001
        return Line.model_validate(data)

    return changed


@pytest.mark.parametrize(
    "wrong",
    [
        "conductors.contact.bending_stiffness",
        "conductors.messenger.youngs_modulus",
        "conductors.dropper.density",
        "contact_wire.tension.force",
        "dropper.clamp_mass_top",
        "gravity",
    ],
)
def test_a_quantity_that_does_not_follow_is_noticed(wrong: str) -> None:
    factors = (1.0, 2.1, 1.6)
    other = with_factor(wrong)(scaled(found(KINDS[0])[0], *factors))
    with pytest.raises(AssertionError):
        check_similar(KINDS[0], other, factors)


def test_a_length_that_does_not_follow_is_noticed() -> None:
    factors = SIMILAR["all at once"]
    data = scaled(found(KINDS[0])[0], *factors).model_dump()
    for support in data["supports"]:
        support["messenger_wire"]["height"] += 1e-5
    with pytest.raises(AssertionError):
        check_similar(KINDS[0], Line.model_validate(data), factors)
