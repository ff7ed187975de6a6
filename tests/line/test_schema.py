"""JSON Schema: every field is explained, and an independent validator agrees with the models."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from pydantic import Field, ValidationError

from catenaria.line import Line, load_line, schema
from catenaria.line.base import LineModel


def undescribed(described: dict[str, Any]) -> Iterator[str]:
    for model in (described, *described.get("$defs", {}).values()):
        for name, field in model.get("properties", {}).items():
            if not field.get("description", "").strip():
                yield f"{model['title']}.{name}"
        if not model.get("description", "").strip():
            yield model["title"]


def test_every_field_and_model_is_described() -> None:
    described = schema()
    assert len(described["$defs"]) > 15
    assert list(undescribed(described)) == []


def test_a_field_without_description_would_be_found() -> None:
    """Negative control."""

    class Bare(LineModel):
        """A model."""

        silent: int
        spoken: int = Field(description="Speaks.")

    assert list(undescribed(Bare.model_json_schema())) == ["Bare.silent"]


def test_descriptions_are_sentences_without_code() -> None:
    for model in (schema(), *schema()["$defs"].values()):
        assert ">>>" not in model["description"]
        assert "\n" not in model["description"]
        assert model["description"].endswith(".")
        for field in model["properties"].values():
            assert field["description"].rstrip("1:").endswith((".", " "))


def validator() -> jsonschema.Draft202012Validator:
    jsonschema.Draft202012Validator.check_schema(schema())
    return jsonschema.Draft202012Validator(schema())


def test_an_independent_validator_accepts_the_example(example_path: Path, tree: dict[str, Any]) -> None:
    assert validator().is_valid(tree)
    assert validator().is_valid(load_line(example_path).model_dump(mode="json"))


@pytest.mark.parametrize("name", ["stitched", "compound"])
def test_an_independent_validator_accepts_rich_lines(name: str, request: pytest.FixtureRequest) -> None:
    rich = request.getfixturevalue(name)
    assert validator().is_valid(rich)
    assert validator().is_valid(Line.model_validate(rich).model_dump(mode="json"))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("stitch_wire", "tension"), 0),
        (("stitch_wire", "length"), None),
        (("mid_point", "clearence"), 0.5),
        (("contact_wire", "wear"), 0.6),
        (("contact_wire", "tension", "device", "efficiency"), 0.0),
        (("second_contact_wire", "droppers"), "all"),
        (("point_masses", 0, "wire"), "return wire"),
        (("supports", 1, "contact_wire", "arm", "side"), "outside"),
        (("supports", 1, "stitch_wire"), "yes"),
        (("supports", 3, "messenger_wire", "cantilever", "density"), 2700.0),
        (("supports", 0, "messenger_wire", "friction"), 0.7),
        (("spans", 0, "pre_sag_per_mille"), "1 mm"),
        (("track", "rail_spacing"), -1.5),
        (("dropper", "model"), "rope"),
        (("other_wires",), []),
    ],
)
def test_model_and_schema_refuse_the_same_in_rich_lines(
    stitched: dict[str, Any], path: tuple[str | int, ...], value: object
) -> None:
    node: Any = stitched
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value
    assert not validator().is_valid(stitched)
    with pytest.raises(ValidationError):
        Line.model_validate(stitched)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("gravity",), True),
        (("gravity",), 0),
        (("gravity",), [9.8]),
        (("supports",), {}),
        (("spans", 0, "length"), -1),
        (("spans", 0, "droppers", "count"), 0),
        (("spans", 0, "droppers", "distance"), 1),
        (("dropper", "joint"), "glued"),
        (("conductors", "contact", "mass_per_length"), 1.0),
        (("solver", "mesh"), {"gauss_points": 2}),
        (("format",), 2),
    ],
)
def test_model_and_schema_refuse_the_same(
    tree: dict[str, Any], path: tuple[str | int, ...], value: object
) -> None:
    spoilt = copy.deepcopy(tree)
    node: Any = spoilt
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value
    assert not validator().is_valid(spoilt)
    with pytest.raises(ValidationError):
        Line.model_validate(spoilt)


def test_the_schema_is_json() -> None:
    assert json.loads(json.dumps(schema())) == schema()
