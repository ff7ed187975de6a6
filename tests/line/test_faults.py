"""Every kind of bad file: one fault for each thing that is wrong, at its place, in plain words."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from catenaria.errors import Fault, LineFileError
from catenaria.line import Line, load_line

Write = Callable[..., Path]
Step = str | int


def faults_of(path: Path) -> tuple[Fault, ...]:
    with pytest.raises(LineFileError) as caught:
        load_line(path)
    return caught.value.faults


def place(text: str, spoilt: str) -> tuple[int, int]:
    """Line and column of a piece that occurs once, found without any parser."""
    assert text.count(spoilt) == 1
    before = text[: text.index(spoilt)]
    return before.count("\n") + 1, len(before) - before.rfind("\n")


# What is replaced in the example, by what, the piece where the fault is, its field, and words of `allowed`.
SPOILT = [
    (
        "youngs_modulus: 130 GPa",
        "youngs_modulus: 130 kN",
        "130 kN",
        "conductors.contact.youngs_modulus",
        "130 GPa",
    ),
    (
        "area: 153 mm^2",
        "area: 153 mm",
        "153 mm",
        "conductors.messenger.area",
        'an area, for example "120 mm^2"',
    ),
    (
        "area: 120 mm^2\n",
        "aera: 120 mm^2\n    area: 120 mm^2\n",
        "aera",
        "conductors.contact.aera",
        "did you mean area?",
    ),
    (
        "tension: {force: 15 kN}\n  tail: 0.5 m   # ours:",
        "tension: {force: -7 N} # ours:",
        "-7 N",
        "contact_wire.tension.force",
        "greater than zero",
    ),
    (
        "tension: {force: 15 kN}\n  tail: 0.5 m   # ours:",
        "tension: {force: 0.0} # ours:",
        "0.0}",
        "contact_wire.tension.force",
        "greater than zero",
    ),
    (
        "tension: {force: 15 kN}\n  tail: 0.5 m   # ours:",
        "tension: [{force: 7 N}, {force: 8 N}] # ours:",
        "[{force: 7",
        "contact_wire.tension",
        "one tension for a wire, with its force; 1 more than lengths to release",
    ),
    (
        "tension: {force: 15 kN}\n  tail: 0.5 m   # ours:",
        "tension: {force: 7 N, force: 8 N} # ours:",
        "force: 8 N",
        "contact_wire.tension.force",
        "each field once",
    ),
    (
        "conductor: messenger",
        "conductor: mesenger",
        "mesenger",
        "messenger_wire.conductor",
        "did you mean messenger?",
    ),
    (
        "guessed_length: 1.5 m",
        "guessed_length: 0 m",
        "0 m\n  joint",
        "dropper.guessed_length",
        "greater than zero",
    ),
    (
        "joint: guided",
        "joint: giuded",
        "giuded",
        "dropper.joint",
        "guided or frictionless (did you mean guided?)",
    ),
    ("51.5, 61]", "51.5, 65]", "65]", "spans[0].droppers.positions[6]", "between 0 and 65 m"),
    ("[4, 13.5", "[0.0, 13.5", "0.0, 13.5", "spans[0].droppers.positions[0]", "between 0 and 65 m"),
    ("13.5, 23, 32.5", "13.5, 13.50, 32.5", "13.50", "spans[0].droppers.positions[2]", "more than 13.5 m"),
    (
        "13.5, 23, 32.5",
        "13.5, 230, 32.5",
        "230, 32.5",
        "spans[0].droppers.positions[2]",
        "between 0 and 65 m",
    ),
    ("13.5, 23, 32.5", "13.5, -23, 32.5", "-23", "spans[0].droppers.positions[2]", "between 0 and 65 m"),
    (
        "tension: {force: 15 kN}\n  tail: 0.5 m   # ours:",
        "tension: {force: 15000,5 N} # ours:",
        "5 N}",
        "contact_wire.tension.5 N",
        "use a point for decimals",
    ),
    ("    area: 120 mm^2", "    area: 120", "120\n    density: 7710", "conductors.contact.area", "120 mm^2?"),
    (
        "contact_wire_height: 0 m",
        "contact_wire_height: 55 m",
        "55 m\n  - *span",
        "spans[0].contact_wire_height",
        "within 0.5 m of 0 m",
    ),
    (
        "positions: [4, 13.5, 23, 32.5, 42, 51.5, 61]",
        "first: 4, spacing: 9.5, count: 8",
        "9.5, count",
        "spans[0].droppers.spacing",
        "number 8 is at 70.5 m",
    ),
    (
        "positions: [4, 13.5, 23, 32.5, 42, 51.5, 61]",
        "first: 4, count: 8",
        "{first: 4",
        "spans[0].droppers.spacing",
        "positions, or first, spacing and count together",
    ),
    (
        "positions: [4, 13.5, 23, 32.5, 42, 51.5, 61]",
        "positions: [4, 8], count: 3 ",
        "3 }",
        "spans[0].droppers.count",
        "either positions",
    ),
    (
        "contact_wire_height: 0 m",
        "contact_wire_height: [0, 0]",
        "[0, 0]",
        "spans[0].contact_wire_height",
        "one height, or 7 of them: one for each dropper, whose length it releases; 5 fewer than lengths",
    ),
    (
        "contact_wire_height: 0 m",
        "contact_wire_height: [0, 0, 0, 0, 0, 0, 0, 0]",
        "[0, 0,",
        "spans[0].contact_wire_height",
        "one for each dropper, whose length it releases; 1 more than lengths to release",
    ),
    (
        "contact_wire_height: 0 m",
        "contact_wire_height: [0, 0, 0, 0, 3 N, 0, 0]",
        "3 N",
        "spans[0].contact_wire_height[4]",
        "a length",
    ),
    (
        "  - *span\n  - *span\n",
        "  - *span\n",
        "- contact_wire: {height: 0 m}\n    messenger_wire: {height: 1.5 m}\n  - m",
        "supports",
        "3 supports for 2 spans",
    ),
    (
        "  - contact_wire: {height: 0 m}\n    messenger_wire: {height: 1.5 m}\n\n",
        "  - messenger_wire: {height: 1.5 m}  # end\n\n",
        "messenger_wire: {height: 1.5 m}  # end",
        "supports[3].contact_wire",
        "the last support must hold the contact wire",
    ),
    (
        "  - messenger_wire: {height: 1.5 m}\n  - messenger_wire: {height: 1.5 m}\n",
        "  - messenger_wire: {height: -2 m}\n  - messenger_wire: {height: 1.5 m}\n",
        "-2 m",
        "supports[1].messenger_wire.height",
        "0.2 m or more",
    ),
    (
        "height: 0 m}\n    messenger_wire: {height: 1.5 m}\n  - m",
        "height: 0.4 m}\n    messenger_wire: {height: 0.35 m}\n  - m",
        "0.35 m",
        "supports[0].messenger_wire.height",
        "more than 0.4 m",
    ),
    (
        "messenger_wire: {height: 1.5 m}\n  - m",
        "messenger_wire: {encumbrance: 1.5 m, height: 3}\n  - m",
        "1.5 m, height",
        "supports[0].messenger_wire.encumbrance",
        "not both",
    ),
    (
        "  - messenger_wire: {height: 1.5 m}\n  - m",
        "  - messenger_wire: {encumbrance: 1.7 m}\n  - m",
        "1.7 m",
        "supports[1].messenger_wire.encumbrance",
        "the contact wire is not held",
    ),
    (
        "      saturation: 100 N",
        "      saturation: 5.0 N",
        "5.0 N",
        "solver.dynamic.contact_tension.saturation",
        "more than the dead band, 5 N",
    ),
    (
        "      dead_band: 0.01 mm",
        "      dead_band: 2 m",
        "solver:",
        "solver.dynamic.height.saturation",
        "dead band, 2 m",
    ),
    ("fine: [0.1 m, 0.3 m] ", "fine: [0.1 m, 0.09 m] ", "0.09 m", "solver.mesh.fine[1]", "more than 0.1 m"),
    (
        "largest_element: 2.4 m",
        "gauss_points: 3",
        "3     # in between",
        "solver.mesh.gauss_points",
        "4 or more",
    ),
    ("format: 1", "format: 2", "2\nname", "format", "1"),
    ("format: 1", "format: yes", "yes\nname", "format", "1"),
    ("name: Yang et al. 2017, three spans", "name: 2017", "2017\ndesc", "name", "put quotes around"),
    ("gravity: 9.8 m/s^2", "gravity: .inf", ".inf", "gravity", "finite"),
    ("gravity: 9.8 m/s^2", "gravity:", "gravity:", "gravity", "an acceleration"),
    (
        "    density: 7710 kg/m^3\n",
        "",
        "youngs_modulus: 130",
        "conductors.contact.density",
        "one of density and",
    ),
    (
        "    density: 7710 kg/m^3\n",
        "    density: 1\n    mass_per_length: 8 kg/m\n",
        "8 kg/m",
        "conductors.contact.mass_per_length",
        "not both",
    ),
    ("joint: guided", "model: ropes", "ropes", "dropper.model", "cables or bar or rigid"),
    ("joint: guided", "modle: bar", "modle", "dropper.modle", "did you mean model?"),
    (
        "tension: {force: 15 kN}\n  tail: 0.5 m   # ours:",
        "tension: {force: 15 kN, device: {efficiency: 97}} # ours:",
        "97}}",
        "contact_wire.tension.device.efficiency",
        "1 or less",
    ),
    (
        "  - messenger_wire: {height: 1.5 m}\n  - m",
        "  - {stagger: 200, messenger_wire: {height: 1.5 m}}\n  - m",
        "200, mess",
        "supports[1].stagger",
        "within 1 m, as -200 mm",
    ),
    (
        "    contact_wire_height: 0 m\n",
        "    pre_sag_per_mille: 4\n",
        "4\n  - *span\n  - *span",
        "spans[0].pre_sag_per_mille",
        "a pre-sag of at most 3.78 per mille: a deeper one needs droppers that push",
    ),
    (
        "solver:\n",
        "mid_point: {support: S2, conductor: BzII 35, tension: 3 kN, reach: 15 m}\nsolver:\n",
        "S2,",
        "mid_point.support",
        "a support that holds the contact wire",
    ),
    (
        "solver:\n",
        "track: {curves: [{start: 0, length: 90 m, radius: 80 m}]}\nsolver:\n",
        "80 m}]",
        "track.curves[0].radius",
        "at least 100 m",
    ),
    ("solver:\n", "sovler:\n", "sovler", "sovler", "did you mean solver?"),
]


@pytest.mark.parametrize(("old", "new", "spot", "field", "allowed"), SPOILT)
def test_one_fault_at_its_place(
    write: Write, example_text: str, old: str, new: str, spot: str, field: str, allowed: str
) -> None:
    assert example_text.count(old) == 1 or new == ""
    text = example_text.replace(old, new, 1)
    path = write(text)
    (fault,) = faults_of(path)
    assert fault.field == field
    assert allowed in fault.allowed
    assert fault.file == str(path)
    if spot not in ("gravity:", "solver:"):
        assert (fault.line, fault.column) == place(text, spot)


def test_the_unspoilt_example_has_no_fault(write: Write, example_text: str) -> None:
    """Negative control of all tests above: the checks do not complain about what is right."""
    assert load_line(write(example_text)).length == 195.0


GOOD = [
    ("51.5, 61]", "51.5, 64.999]"),
    ("[4, 13.5", "[1 mm, 13.5"),
    ("positions: [4, 13.5, 23, 32.5, 42, 51.5, 61]", "first: 4, spacing: 9.5, count: 7"),
    ("contact_wire_height: 0 m", "contact_wire_height: [0, 0, 0, 0, 0, 0, 0]"),
    ("      saturation: 100 N", "      saturation: 5.001 N"),
    ("  - messenger_wire: {height: 1.5 m}\n  - m", "  - messenger_wire: {height: 200 mm}\n  - m"),
    ("largest_element: 2.4 m", "gauss_points: 4"),
    ("    density: 7710 kg/m^3\n", "    mass_per_length: 8 kg/m\n"),
]


@pytest.mark.parametrize(("old", "new"), GOOD)
def test_what_is_just_allowed(write: Write, example_text: str, old: str, new: str) -> None:
    """Negative control: the same edits with values just inside their limits."""
    assert old in example_text
    load_line(write(example_text.replace(old, new, 1)))


def test_all_faults_at_once(write: Write, example_text: str) -> None:
    text = example_text
    spoilt = [
        ("130 GPa", "130 kN", "conductors.contact.youngs_modulus"),
        ("    area: 153 mm^2\n", "    aera: 153 mm^2\n", "conductors.messenger.aera"),
        (
            "conductor: contact\n  tension: {force: 15 kN}",
            "conductor: contac\n  tension: {force: -15 kN}",
            None,
        ),
        ("guessed_length: 1.5 m", "guessed_length: 0", "dropper.guessed_length"),
        ("51.5, 61]", "51.5, 71 m]", "spans[0].droppers.positions[6]"),
        ("  - *span\n  - *span\n", "  - *span\n", "supports"),
        ("saturation: 500 N", "saturation: 1 N", "solver.dynamic.messenger_tension.saturation"),
    ]
    for old, new, _ in spoilt:
        text = text.replace(old, new, 1)
    faults = faults_of(write(text))
    fields = [field for *_, field in spoilt if field]
    fields += ["conductors.messenger.area", "contact_wire.conductor", "contact_wire.tension.force"]
    assert sorted(fault.field for fault in faults) == sorted(fields)
    assert [(fault.line, fault.column) for fault in faults] == sorted((f.line, f.column) for f in faults)


def test_without_a_second_look_faults_stay_hidden(
    write: Write, tree: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: what does not fit together is found behind a broken part only by looking again."""
    tree["gravity"] = "9.8 m"
    tree["dropper"]["conductor"] = "rope"
    path = write(json.dumps(tree), "line.json")
    assert [fault.field for fault in faults_of(path)] == ["gravity", "dropper.conductor"]
    monkeypatch.setattr("catenaria.line.load._neutralise", lambda *_: None)
    assert [fault.field for fault in faults_of(path)] == ["gravity"]


def test_mending_one_fault_leaves_the_others(write: Write, tree: dict[str, Any]) -> None:
    tree["contact_wire"]["tension"]["force"] = "15 m"
    tree["spans"][1]["droppers"]["positions"][6] = 66.0
    tree["messenger_wire"]["conductor"] = "rope"
    assert len(faults_of(write(json.dumps(tree), "a.json"))) == 3
    tree["contact_wire"]["tension"]["force"] = "15 kN"
    assert len(faults_of(write(json.dumps(tree), "b.json"))) == 2


def test_what_an_alias_repeats_is_one_fault(write: Write, example_text: str) -> None:
    aliased = example_text.replace("51.5, 61]", "51.5, 71]")
    assert [fault.field for fault in faults_of(write(aliased))] == ["spans[0].droppers.positions[6]"]


def test_the_same_mistake_at_two_places_is_two_faults(write: Write, tree: dict[str, Any]) -> None:
    """Negative control of the above."""
    for i in (0, 2):
        tree["spans"][i]["droppers"]["positions"][6] = 71.0
    fields = [fault.field for fault in faults_of(write(json.dumps(tree), "line.json"))]
    assert fields == ["spans[0].droppers.positions[6]", "spans[2].droppers.positions[6]"]


def test_a_missing_section_does_not_hide_other_faults(write: Write, tree: dict[str, Any]) -> None:
    del tree["messenger_wire"]
    tree["spans"][1]["droppers"]["positions"][6] = 66.0
    tree["dropper"]["clamp_mass_top"] = "1 m"
    fields = [fault.field for fault in faults_of(write(json.dumps(tree), "line.json"))]
    assert sorted(fields) == ["dropper.clamp_mass_top", "messenger_wire", "spans[1].droppers.positions[6]"]


def leaves(node: object, path: tuple[Step, ...] = ()) -> Iterator[tuple[Step, ...]]:
    if isinstance(node, dict):
        for key, value in node.items():
            yield from leaves(value, (*path, key))
    elif isinstance(node, list):
        for i, value in enumerate(node):
            yield from leaves(value, (*path, i))
    else:
        yield path


def spoil(tree: dict[str, Any], path: tuple[Step, ...], junk: object) -> dict[str, Any]:
    spoilt = copy.deepcopy(tree)
    node: Any = spoilt
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = junk
    return spoilt


@pytest.fixture(params=["plain", "stitched", "compound"])
def rich(request: pytest.FixtureRequest, example_path: Path) -> dict[str, Any]:
    """Lines that together have every field there is."""
    if request.param == "plain":
        return load_line(example_path).model_dump(mode="json", exclude_none=True)
    tree: dict[str, Any] = request.getfixturevalue(request.param)
    return Line.model_validate(tree).model_dump(mode="json", exclude_none=True)


SETTLED = {"positions", "solver", "conductors", "density"}  # tried with the plain line


def fields(tree: dict[str, Any]) -> Iterator[tuple[Step, ...]]:
    """Yield one path for each field: of alike supports, spans and droppers, the first that has it."""
    seen = set[tuple[Step, ...]]()
    for path in leaves(tree):
        field = tuple(step if isinstance(step, str) else 0 for step in path)
        if field not in seen:
            seen.add(field)
            yield path


@pytest.mark.parametrize("junk", [True, [[1]], {"x": 1}, "3 furlong", float(10**9) * -1])
def test_rubbish_anywhere_is_told_in_plain_words(write: Write, rich: dict[str, Any], junk: object) -> None:
    free = ("start_chainage", "stagger", "pre_sag", "contact_wire_height", "start", "radius")
    for path in fields(rich):
        if isinstance(junk, str) and path[-1] in ("name", "description"):
            continue
        if rich["name"] in ("stitched", "") and SETTLED & set(path):
            continue
        if junk is True and path[-1] == "stitch_wire":
            continue
        if junk == -1e9 and path[-1] in free:
            continue  # any finite number is allowed there, or it is refused at another place
        if junk == -1e9 and path[0] == "supports" and "contact_wire" in path:
            continue  # the contact wire may be far below the messenger
        for fault in faults_of(write(json.dumps(spoil(rich, path, junk)), "line.json")):
            assert fault.line > 0
            for jargon in ("Input", "input", "pydantic", "type=", "validat", "http"):
                assert jargon not in fault.allowed
                assert jargon not in fault.found


def test_fault_text_names_file_line_column_field_found_and_allowed(write: Write, example_text: str) -> None:
    path = write(example_text.replace("51.5, 61]", "51.5, 71 m]"))
    (fault,) = faults_of(path)
    row, column = place(path.read_text(encoding="utf-8"), "71 m")
    assert str(fault) == (
        f'{path}:{row}:{column}: spans[0].droppers.positions[6]: found "71 m"; '
        "allowed: droppers inside the span, between 0 and 65 m; number 7 is at 71 m"
    )
