"""Descriptions of structures: what is allowed, and how what is not is named."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.errors import LineFileError
from catenaria.structure import Stiffnesses, Structure, load_structure

NAMES = ("yang2017_rod", "yang2017_three_cables")


@pytest.mark.parametrize("name", NAMES)
def test_examples_load(examples: Path, name: str) -> None:
    structure = load_structure(examples / f"{name}.yaml")
    assert structure.gravity == 9.8
    assert structure.source.mark(("cables",))[0] > 10


@pytest.mark.parametrize("name", NAMES)
def test_a_description_survives_its_dump(examples: Path, name: str) -> None:
    structure = load_structure(examples / f"{name}.yaml")
    assert Structure.model_validate(structure.model_dump()) == structure
    assert Structure.model_validate(json.loads(structure.model_dump_json())) == structure


def test_units_and_both_kinds_of_sections(taut: dict[str, Any]) -> None:
    taut["sections"]["other"] = {
        "youngs_modulus": "130 GPa",
        "area": "120 mm^2",
        "density": 7710,
        "bending_stiffness": 400,
    }
    taut["sections"]["third"] = Stiffnesses.model_validate({"EA": "1 MN", "EJ": 10, "rhoA": 1})
    structure = Structure.model_validate(taut)
    assert structure.sections["other"].EA == 15.6e6
    assert structure.sections["third"] == structure.sections["wire"]


def test_without_controls(taut: dict[str, Any]) -> None:
    structure = Structure.model_validate(taut)
    assert list(structure.controls) == ["T", "h"]
    assert not structure.without_controls().controls
    assert structure.without_controls().joints == structure.joints


def spoilt(taut: dict[str, Any], path: str, value: Any) -> dict[str, Any]:
    *steps, last = path.split("/")
    node = taut
    for step in steps:
        node = node[step]
    node[last] = value
    return taut


LA = {"cable": "main", "point": 10.0}
FAULTS: list[tuple[str, Any, str, str]] = [
    ("cables/main/section", "wier", "cables.main.section", "did you mean wire?"),
    ("cables/main/points", [[0, 0, 0]], "cables.main.points", "at least a start and an end"),
    ("cables/main/points", [[0, 0, 0], [0, 0, 0]], "cables.main.points[1]", "not the one before"),
    ("cables/main/points", [[0, 0], [1, 0, 0]], "cables.main.points[0]", "three: x, y, z"),
    ("tensions/T/move", {"right": ["up", 0, 0]}, "tensions.T.move.right[0]", "a finite number"),
    ("cables/main/elements", None, "cables.main.elements", "one of elements and nodes"),
    ("cables/main/nodes", [1.0, 2.0], "cables.main.nodes", "this or elements"),
    ("cables/hanger/unstressed_length", 1.1, "cables.hanger.unstressed_length", "above each other"),
    ("sections/wire/EA", "1 km", "sections.wire.EA", "a force"),
    ("joints/ring/type", "slidng", "joints.ring.type", "did you mean sliding?"),
    ("joints/ring/on/cable", "mian", "joints.ring.on.cable", "did you mean main?"),
    ("joints/ring/on/point", 11.0, "joints.ring.on.point", "0 to 10.5 m"),
    ("joints/ring/on/point", "middle", "joints.ring.on.point", "start, end or a length"),
    ("joints/ring/on/point", "end", "joints.ring.on", "also in joint right"),
    ("joints/clamp/to", None, "joints.clamp.to", "the cable that is guided"),
    ("joints/clamp/on/point", 4.1, "joints.clamp.to", "0.1 m away"),
    ("masses", {"m": {"on": {"cable": "main", "point": 99}, "mass": 1}}, "masses.m.on.point", "10.5 m"),
    ("tensions/T/move", {}, "tensions.T.move", "held point that is released"),
    ("tensions/T/move", {"right": [0, 0, 0]}, "tensions.T.move.right", "not zero"),
    ("tensions/T/move", {"ring": [1, 0, 0]}, "tensions.T.move.ring", "a held point"),
    ("tensions/T/move", {"rihgt": [1, 0, 0]}, "tensions.T.move.rihgt", "did you mean right?"),
    ("heights/h/move", {"right": [1, 0, 0]}, "heights.h.move.right", "no other control moves"),
    ("tensions/T/joint", "ring", "tensions.T.joint", "start or end with the ground"),
    ("tensions/T/measure", "strain", "tensions.T.joint", "sliding or guided"),
    (
        "tensions/T",
        {"joint": "right", "force": 1, "measure": "pull", "move": {"left": [1, 0, 0]}},
        "tensions.T.joint",
        "that this control moves",
    ),
    ("heights/h/joint", "left", "heights.h.joint", "fixed to the ground"),
    ("heights", {"T": {"joint": "clamp", "height": 0, "move": {"top": [0, 0, 1]}}}, "heights.T", "no other"),
    (
        "balances",
        {"b": {"halves": ["hanger", "man"], "move": {"left": [1, 0, 0]}}},
        "balances.b.halves[1]",
        "main",
    ),
]


@pytest.mark.parametrize(("path", "value", "field", "allowed"), FAULTS)
def test_a_fault_is_named(
    taut: dict[str, Any], path: str, value: Any, field: str, allowed: str, tmp_path: Path
) -> None:
    file = tmp_path / "structure.json"
    file.write_text(json.dumps(spoilt(taut, path, value), indent=1), encoding="utf-8")
    with pytest.raises(LineFileError) as caught:
        load_structure(file)
    faults = {fault.field: fault for fault in caught.value.faults}
    assert field in faults, list(faults)
    assert allowed in faults[field].allowed
    assert faults[field].line > 1


def test_what_is_right_has_no_fault(taut: dict[str, Any], tmp_path: Path) -> None:
    file = tmp_path / "structure.json"
    file.write_text(json.dumps(taut), encoding="utf-8")
    assert load_structure(file) == Structure.model_validate(taut)


def test_all_faults_at_once(taut: dict[str, Any], tmp_path: Path) -> None:
    taut["cables"]["main"]["section"] = "rope"
    taut["tensions"]["T"]["force"] = "-1 kN"
    taut["joints"]["ring"]["colour"] = "red"
    file = tmp_path / "structure.json"
    file.write_text(json.dumps(taut), encoding="utf-8")
    with pytest.raises(LineFileError) as caught:
        load_structure(file)
    assert {fault.field for fault in caught.value.faults} == {
        "cables.main.section",
        "tensions.T.force",
        "joints.ring.colour",
    }


def test_python_objects_are_checked_too(taut: dict[str, Any]) -> None:
    with pytest.raises(ValidationError, match="at least a start") as caught:
        Structure.model_validate(spoilt(taut, "cables/main/points", [[0, 0, 0]]))
    assert caught.value.error_count() == 1
