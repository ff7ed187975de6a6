"""The same line however it is written: units or SI, YAML or JSON, block or flow."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from catenaria.line import Line, load_line

Write = Callable[..., Path]
per_example = settings(
    max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None
)


def test_the_example_is_section_5_of_the_paper(example_path: Path) -> None:
    line = load_line(example_path)
    assert line.gravity == 9.8
    assert line.length == 195.0
    assert line.support_x == (0.0, 65.0, 130.0, 195.0)
    pattern = (4.0, 13.5, 23.0, 32.5, 42.0, 51.5, 61.0)
    assert line.dropper_x == tuple(start + x for start in (0.0, 65.0, 130.0) for x in pattern)
    assert line.dropper_span == (0,) * 7 + (1,) * 7 + (2,) * 7
    assert line.dropper_target_height == (0.0,) * 21
    assert line.contact_support_indices == (0, 3)
    assert [support.messenger_height for support in line.supports] == [1.5] * 4
    assert [support.name for support in line.supports] == ["S1", "S2", "S3", "S4"]


def test_the_example_has_the_conductors_of_the_paper(example_path: Path) -> None:
    """Tables 2 and 3; masses per length worked out by hand from density and area."""
    line = load_line(example_path)
    contact, messenger, dropper = (line.conductors[name] for name in ("contact", "messenger", "dropper"))
    assert (pytest.approx(15.6e6), 400.0) == (contact.EA, contact.EJ)
    assert (pytest.approx(12.5001e6), 311.0) == (messenger.EA, messenger.EJ)
    assert (pytest.approx(1.19e6), 4.0) == (dropper.EA, dropper.EJ)
    assert [c.rhoA for c in (contact, messenger, dropper)] == pytest.approx([0.9252, 0.61506, 0.089])
    assert line.contact_wire.tension.force == line.messenger_wire.tension.force == 15000.0


def test_the_example_has_the_control_values_of_the_paper(example_path: Path) -> None:
    dynamic = load_line(example_path).solver.dynamic
    contact, messenger, height = dynamic.contact_tension, dynamic.messenger_tension, dynamic.height
    assert (contact.velocity, contact.dead_band, contact.saturation) == (0.0002, 5.0, 100.0)
    assert (messenger.velocity, messenger.dead_band, messenger.saturation) == (0.0004, 20.0, 500.0)
    assert (height.dead_band, height.saturation) == (1e-5, 1e-3)
    assert dynamic.settle.remaining_travel == 5e-7


def test_the_values_of_the_paper_are_the_defaults(example_path: Path, tree: dict[str, Any]) -> None:
    spoken = load_line(example_path).solver
    silent = Line.model_validate(tree | {"solver": {}}).solver
    assert silent.mesh == spoken.mesh
    for name in ("ramp_time", "contact_tension", "messenger_tension", "height", "damping", "integrator"):
        assert getattr(silent.dynamic, name) == getattr(spoken.dynamic, name)
    assert (
        silent.dynamic.settle != spoken.dynamic.settle
    )  # the example's own: its heights shall end in their band


def test_units_or_si_make_no_difference(example_path: Path, tree: dict[str, Any]) -> None:
    in_units = load_line(example_path)
    in_units = in_units.model_copy(update={"name": "", "description": ""})
    tree["solver"] = in_units.solver.model_dump()
    assert in_units == Line.model_validate(tree)
    tree["conductors"]["contact"]["area"] *= 1 + 1e-15
    assert in_units != Line.model_validate(tree)


@per_example
@given(
    tension=st.integers(200, 300_000),
    area=st.integers(10, 10**6),
    height=st.integers(-(10**6), 10**6),
    velocity=st.integers(1, 10**6),
)
def test_si_numbers_and_texts_with_units_give_equal_lines(
    tree: dict[str, Any], tension: int, area: int, height: int, velocity: int
) -> None:
    in_units, in_si = copy.deepcopy(tree), copy.deepcopy(tree)
    for data, values in (
        (
            in_units,
            (f"{tension / 1000} kN", f"{area / 100} mm^2", f"{height / 100} mm", f"{velocity / 10} mm/s"),
        ),
        (in_si, (float(tension), area / 10**8, height / 10**5, velocity / 10**4)),
    ):
        data["contact_wire"]["tension"]["force"] = values[0]
        data["conductors"]["dropper"]["area"] = values[1]
        data["start_chainage"] = values[2]
        data["solver"]["dynamic"]["height"] = {"velocity": values[3]}
    assert Line.model_validate(in_units) == Line.model_validate(in_si)


names = st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs")), max_size=20)


@per_example
@given(name=names, description=names, indent=st.sampled_from([None, 0, 1, 4, "\t"]), ascii_only=st.booleans())
def test_json_and_yaml_give_equal_lines(
    write: Write,
    tree: dict[str, Any],
    name: str,
    description: str,
    indent: int | str | None,
    ascii_only: bool,
) -> None:
    tree["name"], tree["description"] = name, description
    text = json.dumps(tree, indent=indent, ensure_ascii=ascii_only)
    from_json = load_line(write(text, "line.json"))
    assert (from_json.name, from_json.description) == (name, description)
    assert from_json == Line.model_validate(tree)
    if not ascii_only:  # YAML has no surrogate pairs, with which JSON escapes what it does not write
        assert load_line(write(text.replace("\t", " "), "line.yaml")) == from_json


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path: Path, example_path: Path) -> None:
    path = tmp_path / "line.yaml"
    path.write_bytes(b"\xef\xbb\xbf" + example_path.read_bytes())
    assert load_line(path) == load_line(example_path)


def test_windows_line_ends_make_no_difference(tmp_path: Path, example_path: Path) -> None:
    path = tmp_path / "line.yml"
    path.write_bytes(example_path.read_bytes().replace(b"\n", b"\r\n"))
    assert load_line(str(path)) == load_line(example_path)


@pytest.mark.parametrize("bare", [True, False])
def test_the_echo_of_a_line_is_the_line(write: Write, example_path: Path, bare: bool) -> None:
    line = load_line(example_path)
    echo = line.model_dump(mode="json", exclude_none=bare)
    assert load_line(write(json.dumps(echo), "echo.json")) == line


@pytest.mark.parametrize("bare", [True, False])
@pytest.mark.parametrize("name", ["stitched", "compound"])
def test_the_echo_of_a_rich_line_is_the_line(
    write: Write, request: pytest.FixtureRequest, name: str, bare: bool
) -> None:
    line = Line.model_validate(request.getfixturevalue(name))
    echo = line.model_dump(mode="json", exclude_none=bare)
    assert load_line(write(json.dumps(echo), "echo.json")) == line


def test_merged_mappings_are_read_as_yaml_means_them(
    write: Write, example_text: str, example_path: Path
) -> None:
    merged = example_text.replace(
        "  - *span\n  - *span\n", "  - <<: *span\n    length: 70\n  - {<<: *span}\n"
    )
    assert merged != example_text
    line = load_line(write(merged))
    assert [span.length for span in line.spans] == [65.0, 70.0, 65.0]
    assert line.spans[2] == load_line(example_path).spans[0]
