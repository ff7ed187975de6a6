"""Parts of a line: derived values, defaults, and what may not be changed."""

from __future__ import annotations

import pickle
from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.errors import InconsistentInputError
from catenaria.line import Conductor, Droppers, Line, MessengerSupport, Span, Support, TensionControl


def test_mass_per_length_or_density_is_the_same_conductor_in_effect() -> None:
    by_density = Conductor(youngs_modulus=1e11, area=1e-4, density=8000.0, bending_stiffness=0.0)
    by_length = Conductor(youngs_modulus=1e11, area=1e-4, mass_per_length=0.8, bending_stiffness=0.0)
    assert by_density.rhoA == pytest.approx(by_length.rhoA)
    assert (pytest.approx(1e7), 0.0) == (by_length.EA, by_length.EJ)


def test_bending_stiffness_may_be_zero_but_not_forgotten() -> None:
    with pytest.raises(ValidationError, match="this field is needed"):
        Conductor.model_validate({"youngs_modulus": 1e11, "area": 1e-4, "density": 8000.0})


def test_droppers_by_spacing_are_those_by_list() -> None:
    by_spacing = Span(length=65, droppers=Droppers(first=4, spacing=9.5, count=7), contact_wire_height=5.3)
    by_list = Span(
        length=65, droppers=Droppers(positions=(4, 13.5, 23, 32.5, 42, 51.5, 61)), contact_wire_height=5.3
    )
    assert by_spacing.droppers.x == by_list.droppers.x


def test_a_span_may_have_no_dropper(tree: dict[str, Any]) -> None:
    tree["spans"][1] = {"length": 50, "droppers": {"positions": []}, "contact_wire_height": 0}
    line = Line.model_validate(tree)
    assert line.dropper_span == (0,) * 7 + (2,) * 7
    assert line.dropper_x[7] == 65 + 50 + 4


def test_encumbrance_counts_from_the_contact_wire() -> None:
    contact = {"height": 5.3}
    by_encumbrance = Support.model_validate(
        {"contact_wire": contact, "messenger_wire": {"encumbrance": "1400 mm"}}
    )
    by_height = Support.model_validate({"contact_wire": contact, "messenger_wire": {"height": 6.7}})
    assert by_encumbrance.messenger_height == pytest.approx(by_height.messenger_height)


def test_chainage_shifts_everything(tree: dict[str, Any]) -> None:
    here = Line.model_validate(tree)
    there = Line.model_validate(tree | {"start_chainage": "12 km"})
    assert there.length == here.length
    assert there.support_x == tuple(12_000.0 + x for x in here.support_x)
    assert there.dropper_x == pytest.approx([12_000.0 + x for x in here.dropper_x])


def test_given_names_stay_and_others_are_numbered(tree: dict[str, Any]) -> None:
    tree["supports"][1]["name"] = "mast 17-4"
    assert [s.name for s in Line.model_validate(tree).supports] == ["S1", "mast 17-4", "S3", "S4"]


def test_automatic_names_skip_those_that_are_taken(tree: dict[str, Any]) -> None:
    tree["supports"][1]["name"] = "S1"
    tree["supports"][3]["name"] = "S3"
    names = [support.name for support in Line.model_validate(tree).supports]
    assert names == ["S2", "S1", "S4", "S3"]


def test_names_given_twice_are_still_refused(tree: dict[str, Any]) -> None:
    """Negative control of the test above."""
    tree["supports"][1]["name"] = tree["supports"][2]["name"] = "S7"
    with pytest.raises(ValidationError, match="a name that no other support has"):
        Line.model_validate(tree)


@pytest.mark.parametrize(
    ("part", "derived"),
    [
        (Droppers.model_construct(positions=None, first=4.0, spacing=None, count=3), "x"),
        (Conductor.model_construct(area=1e-4, density=None, mass_per_length=None), "rhoA"),
        (Support.model_construct(messenger_wire=MessengerSupport(encumbrance=1.5)), "messenger_height"),
    ],
)
def test_what_cannot_be_derived_is_not_made_up(part: object, derived: str) -> None:
    with pytest.raises(InconsistentInputError):
        getattr(part, derived)


def test_a_part_of_a_control_keeps_the_other_defaults(tree: dict[str, Any]) -> None:
    tree["solver"]["dynamic"]["messenger_tension"] = {"dead_band": "0.1 N"}
    control: TensionControl = Line.model_validate(tree).solver.dynamic.messenger_tension
    assert (control.velocity, control.dead_band, control.saturation) == (0.0004, 0.1, 500.0)


def test_lines_are_frozen_and_travel_between_processes(tree: dict[str, Any]) -> None:
    line = Line.model_validate(tree)
    with pytest.raises(ValidationError, match="frozen"):
        line.gravity = 1.0  # pyright: ignore[reportAttributeAccessIssue]
    assert pickle.loads(pickle.dumps(line)) == line


def test_a_support_holds_the_messenger_at_one_height() -> None:
    assert MessengerSupport(height=1.5) != MessengerSupport(encumbrance=1.5)
