"""Steady arms, springs, cantilevers: what belongs together at a support, and on which side a hinge is."""

from __future__ import annotations

import copy
from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.line import MessengerSupport, SteadyArm, Support

ARM: dict[str, Any] = {"length": 1.2, "mass": 2.0}
SUPPORT: dict[str, Any] = {
    "contact_wire": {"height": 5.5, "kind": "steady arm", "arm": ARM},
    "messenger_wire": {"encumbrance": 1.8},
    "stagger": 0.2,
}
BEAM: dict[str, Any] = {
    "length": 2.5,
    "side": "left",
    "youngs_modulus": 70e9,
    "area": 2e-3,
    "density": 2700.0,
    "bending_stiffness": 7e4,
}


def support(**arm: Any) -> dict[str, Any]:
    data = copy.deepcopy(SUPPORT)
    data["contact_wire"]["arm"] |= arm
    return data


def errors(model: type[Any], data: object) -> list[tuple[str, str]]:
    with pytest.raises(ValidationError) as caught:
        model.model_validate(data)
    return [(".".join(map(str, error["loc"])), error["msg"]) for error in caught.value.errors()]


@pytest.mark.parametrize(
    ("arm", "stagger", "side"),
    [
        ({}, 0.2, 1.0),
        ({}, -0.2, -1.0),
        ({}, 0.0, 0.0),
        ({"registration": "push-off"}, 0.2, 1.0),
        ({"registration": "push-off"}, -0.2, -1.0),
        ({"side": "right"}, 0.2, -1.0),
        ({"registration": "push-off", "side": "left"}, -0.2, 1.0),
        ({"hinge": {"stagger": 1.0, "height": 6.0}}, 0.2, 1.0),
        ({"hinge": {"stagger": 0.1, "height": 6.0}, "registration": "push-off"}, 0.2, -1.0),
    ],
)
def test_the_side_of_the_hinge(arm: dict[str, Any], stagger: float, side: float) -> None:
    assert SteadyArm.model_validate(ARM | arm).hinge_side(stagger) == side


@pytest.mark.parametrize(
    ("arm", "change", "field", "told"),
    [
        ({}, {"stagger": 0.0}, "contact_wire.arm.side", "left or right: the stagger is 0"),
        ({"hinge": {"stagger": 0.2, "height": 6.7}}, {}, "contact_wire.arm.hinge.stagger", "of the wire"),
        (
            {"hinge": {"stagger": 1.2, "height": 6.1}, "side": "right"},
            {},
            "contact_wire.arm.side",
            "left, where the hinge is",
        ),
        ({"hinge": {"stagger": 2.2, "height": 5.9}}, {}, "contact_wire.arm.hinge", "this is 2.04 m away"),
        ({"hinge": {"stagger": 0.7, "height": 5.9}}, {}, "contact_wire.arm.hinge", "this is 0.64 m away"),
        ({"hinge": {"stagger": 1.2, "height": 6.1}, "lift": 50}, {}, "contact_wire.arm.lift", "not both"),
        ({"lift": "60 kN"}, {}, "contact_wire.arm.lift", "within 2 kN, as 80 N"),
        ({"length": 0}, {}, "contact_wire.arm.length", "greater than zero"),
        ({"minimum_pull": "-80 N"}, {}, "contact_wire.arm.minimum_pull", "greater than zero"),
        ({}, {"stagger": "-1.1 m"}, "stagger", "within 1 m"),
        ({}, {"stagger": -200}, "stagger", "within 1 m"),
        ({}, {"messenger_stagger": 1.6}, "messenger_stagger", "within 1.5 m"),
        ({}, {"auxiliary_messenger": {"height": 5.4}}, "auxiliary_messenger.height", "5.5 to 7.3 m"),
        ({}, {"auxiliary_messenger": {"height": 7.4}}, "auxiliary_messenger.height", "5.5 to 7.3 m"),
        ({}, {"stitch_wire": "maybe"}, "stitch_wire", "boolean"),
    ],
)
def test_what_contradicts_itself(arm: dict[str, Any], change: dict[str, Any], field: str, told: str) -> None:
    ((place, message),) = errors(Support, support(**arm) | change)
    assert place == field
    assert told in message


@pytest.mark.parametrize(
    ("arm", "change"),
    [
        ({}, {}),
        ({"side": "right"}, {"stagger": 0.0}),
        ({"hinge": {"stagger": 1.2, "height": 6.1}}, {}),
        ({"hinge": {"stagger": 1.2, "height": 6.1}, "side": "left"}, {}),
        ({"hinge": {"stagger": 0.5, "height": 6.5}}, {"stagger": 0.0}),
        ({"lift": "-20 N"}, {}),
        ({"minimum_pull": "80 N", "clamp_mass": 0.4}, {"stagger": -1.0, "messenger_stagger": 1.5}),
        ({}, {"auxiliary_messenger": {"height": 6.4}, "stitch_wire": True}),
    ],
)
def test_what_goes_together(arm: dict[str, Any], change: dict[str, Any]) -> None:
    """Negative control."""
    assert Support.model_validate(support(**arm) | change).messenger_height == 7.3


def test_kind_and_arm_go_together() -> None:
    data = support()
    data["contact_wire"]["kind"] = "sliding"
    assert errors(Support, data)[0][0] == "contact_wire.arm"
    del data["contact_wire"]["arm"]
    assert Support.model_validate(data).contact_wire is not None
    data["contact_wire"]["kind"] = "steady arm"
    ((place, message),) = errors(Support, data)
    assert place == "contact_wire.arm"
    assert "needed" not in message
    assert "for kind is steady arm" in message


def test_the_messenger_has_the_stagger_of_the_contact_wire_unless_it_has_its_own() -> None:
    assert Support.model_validate(SUPPORT).messenger_offset == 0.2
    assert Support.model_validate(SUPPORT | {"messenger_stagger": 0.0}).messenger_offset == 0.0


@pytest.mark.parametrize(
    ("data", "field", "told"),
    [
        ({"kind": "spring"}, "stiffness", "a value, for kind is spring"),
        ({"kind": "cantilever"}, "cantilever", "a value, for kind is cantilever"),
        ({"stiffness": 1e5}, "stiffness", "only where kind is spring"),
        ({"lateral_stiffness": 1e5}, "lateral_stiffness", "only where kind is spring"),
        ({"cantilever": BEAM}, "cantilever", "only where kind is cantilever"),
        ({"kind": "bracket", "friction": 0.02}, "friction", "0: over a bracket support no wire runs"),
        ({"kind": "clamped", "friction": 0.02}, "friction", "0: over a clamped support"),
        ({"friction": 0.6}, "friction", "less than or equal to 0.5"),
        ({"friction": -0.1}, "friction", "greater than or equal to 0"),
        (
            {"kind": "cantilever", "cantilever": BEAM | {"elements": 0}},
            "cantilever.elements",
            "or equal to 1",
        ),
        (
            {"kind": "cantilever", "cantilever": BEAM | {"bending_stiffness": 0.0}},
            "cantilever.bending_stiffness",
            "greater than zero",
        ),
        (
            {"kind": "cantilever", "cantilever": BEAM | {"mass_per_length": 1.0}},
            "cantilever.mass_per_length",
            "not both",
        ),
    ],
)
def test_messenger_supports_that_contradict_themselves(data: dict[str, Any], field: str, told: str) -> None:
    ((place, message),) = errors(MessengerSupport, {"height": 7.3} | data)
    assert place == field
    assert told in message


@pytest.mark.parametrize(
    "data",
    [
        {"friction": 0.5},
        {"kind": "spring", "stiffness": "100 kN/m", "friction": 0.02},
        {"kind": "spring", "stiffness": 1e5, "lateral_stiffness": 2e5},
        {"kind": "cantilever", "cantilever": BEAM, "friction": 0.01},
        {"kind": "bracket"},
        {"kind": "clamped"},
    ],
)
def test_messenger_supports_that_do_not(data: dict[str, Any]) -> None:
    """Negative control."""
    assert MessengerSupport.model_validate({"height": 7.3} | data).height == 7.3


def test_a_cantilever_is_made_like_a_conductor() -> None:
    held = MessengerSupport.model_validate({"height": 7.3, "kind": "cantilever", "cantilever": BEAM})
    assert held.cantilever is not None
    assert (pytest.approx(1.4e8), 7e4) == (held.cantilever.EA, held.cantilever.EJ)
    assert held.cantilever.rhoA == pytest.approx(5.4)
    assert held.cantilever.elements == 4
