"""The wanted heights of the contact wire: level, graded, with pre-sag, or dropper by dropper."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.line import Line, Span
from catenaria.line.profile import between, lowered

POSITIONS = (4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0)


def heights(tree: dict[str, Any]) -> tuple[float, ...]:
    return Line.model_validate(tree).dropper_target_height


@pytest.mark.parametrize("given", [0.1, [0.1, 0.2, 0.3, 0.1, 0.0, 1e-17, 0.1 + 0.2]])
def test_heights_that_are_given_stay_bit_for_bit(tree: dict[str, Any], given: Any) -> None:
    tree["spans"][1]["contact_wire_height"] = given
    expected = tuple(given) if isinstance(given, list) else (given,) * 7
    assert heights(tree) == (0.0,) * 7 + expected + (0.0,) * 7


def test_heights_that_are_not_given_are_on_the_line_between_supports(tree: dict[str, Any]) -> None:
    """The contact wire is held at the first and the last of four supports only, 195 m apart."""
    tree["supports"][3]["contact_wire"]["height"] = 0.39
    for span in tree["spans"]:
        del span["contact_wire_height"]
    x = [start + at for start in (0.0, 65.0, 130.0) for at in POSITIONS]
    assert heights(tree) == pytest.approx([0.002 * place for place in x], abs=1e-15)
    tree["supports"][1]["contact_wire"] = {"height": 0.065}
    assert heights(tree)[:7] == pytest.approx([0.001 * place for place in POSITIONS], abs=1e-15)
    assert heights(tree)[13] == pytest.approx(0.065 + 0.325 * 61.0 / 130.0, abs=1e-15)


def test_heights_that_are_not_given_in_a_level_line_are_exactly_its_height(tree: dict[str, Any]) -> None:
    for support in (tree["supports"][0], tree["supports"][3]):
        support["contact_wire"]["height"] = 5.3
    for support in tree["supports"]:
        support["messenger_wire"]["height"] = 6.7
    for span in tree["spans"]:
        span["contact_wire_height"] = None
    tree["start_chainage"] = 1234.567
    assert heights(tree) == (5.3,) * 21


def test_a_pre_sag_is_a_parabola_from_the_first_to_the_last_dropper(tree: dict[str, Any]) -> None:
    """By hand: droppers at 4, 13.5, ... are 1, 2/3, 1/3 and 0 of the half length from the middle, 32.5 m."""
    tree["spans"][1]["pre_sag"] = "54 mm"
    expected = [-0.054 * (1.0 - share**2) for share in (1.0, 2 / 3, 1 / 3, 0.0, 1 / 3, 2 / 3, 1.0)]
    assert heights(tree)[7:14] == pytest.approx(expected, abs=1e-16)
    assert heights(tree)[10] == pytest.approx(-0.054, abs=1e-16)


def test_a_pre_sag_per_mille_is_that_of_the_span(tree: dict[str, Any]) -> None:
    in_mm, in_share = (tree["spans"][i] for i in (0, 1))
    in_mm["pre_sag"], in_share["pre_sag_per_mille"] = 0.0325, 0.5
    assert heights(tree)[:7] == pytest.approx(heights(tree)[7:14], abs=1e-16)
    in_share["pre_sag_per_mille"] = 0.4
    assert heights(tree)[:7] != pytest.approx(heights(tree)[7:14], abs=1e-4)


def test_a_pre_sag_lies_on_a_gradient(tree: dict[str, Any]) -> None:
    for span in tree["spans"]:
        del span["contact_wire_height"]
    tree["supports"][3]["contact_wire"]["height"] = 0.39
    straight = heights(tree)
    tree["spans"][0]["pre_sag"] = 0.05
    assert heights(tree)[3] == pytest.approx(straight[3] - 0.05, abs=1e-15)
    assert (heights(tree)[0], heights(tree)[6]) == (straight[0], straight[6])
    assert heights(tree)[7:] == straight[7:]


def test_no_pre_sag_lowers_nothing() -> None:
    given = (0.1, 0.2, 0.3)
    span = Span.model_validate({"length": 40, "droppers": {"positions": [10, 20, 30]}})
    assert lowered(span, given) is given


def test_heights_at_supports(tree: dict[str, Any]) -> None:
    tree["supports"][3]["contact_wire"]["height"] = 0.3
    assert Line.model_validate(tree).contact_heights == pytest.approx((0.0, 0.1, 0.2, 0.3))


def test_outside_of_what_is_known_there_is_no_height() -> None:
    points = [(0.0, 1.0), (10.0, 2.0)]
    assert between(points, 10.0) == 2.0
    assert str(between(points, 10.5)) == str(between([], 1.0)) == "nan"


@pytest.mark.parametrize(
    ("span", "field", "told"),
    [
        ({"pre_sag": 0.05, "pre_sag_per_mille": 1}, "pre_sag_per_mille", "this or pre_sag, not both"),
        ({"pre_sag": 0.05, "contact_wire_height": [0, -0.01, 0]}, "pre_sag", "a height for each dropper"),
        (
            {"pre_sag_per_mille": 1, "droppers": {"positions": [10, 20]}},
            "pre_sag_per_mille",
            "three droppers",
        ),
        ({"pre_sag_per_mille": 11}, "pre_sag_per_mille", "less than or equal to 10"),
    ],
)
def test_a_pre_sag_that_says_too_much(span: dict[str, Any], field: str, told: str) -> None:
    whole = {"length": 40, "droppers": {"positions": [10, 20, 30]}} | span
    with pytest.raises(ValidationError, match=told) as caught:
        Span.model_validate(whole)
    assert [error["loc"] for error in caught.value.errors()] == [(field,)]


@pytest.mark.parametrize("wear", [0.0, 0.2])
def test_a_pre_sag_beyond_the_wires_own_sag_is_refused(tree: dict[str, Any], wear: float) -> None:
    """The wire hangs by w L^2/(8 T) between the outer droppers, L = 57 m: 0.2456 m at 15 kN, less if worn."""
    tree["contact_wire"]["wear"] = wear
    most = 9.8 * 0.9252 * (1.0 - wear) * 57.0**2 / (8.0 * 15e3)
    tree["spans"][1]["pre_sag"] = 0.999 * most
    assert min(heights(tree)) == pytest.approx(-0.999 * most)
    tree["spans"][1]["pre_sag"] = 1.001 * most
    with pytest.raises(ValidationError, match=f"at most {most * 1e3:.3g} mm: a deeper one"):
        Line.model_validate(tree)


def test_the_efficiency_of_the_device_lets_the_wire_hang_deeper(tree: dict[str, Any]) -> None:
    tree["spans"][1]["pre_sag"] = 0.25
    tree["contact_wire"]["tension"]["device"] = {"efficiency": 0.95}
    assert Line.model_validate(tree).contact_wire.tension.on_wire == pytest.approx(14250.0)
    tree["contact_wire"]["tension"]["device"] = {"efficiency": 1.0}
    with pytest.raises(ValidationError, match="need"):
        Line.model_validate(tree)
