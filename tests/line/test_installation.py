"""Errors of installation in files: what is read, and what is refused with its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from catenaria.errors import LineFileError
from catenaria.line import Line, load_line, summarise
from catenaria.line.installation import Installation, Spread, usual_installation
from catenaria.line.load_installation import load_installation

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def line() -> Line:
    return load_line(EXAMPLES / "yang2017_three_span.yaml")


def faults(tmp_path: Path, line: Line, text: str) -> list[tuple[int, str, str, str]]:
    """Return line, field, what was found and what is allowed, of every fault of a file."""
    file = tmp_path / "errors.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(LineFileError) as caught:
        load_installation(file, line)
    return [(f.line, f.field, f.found, f.allowed) for f in caught.value.faults]


def test_the_example_has_everything_and_fits_the_lines_of_the_examples(line: Line) -> None:
    for name in ("yang2017_three_span", "simple_60m"):
        found = load_installation(EXAMPLES / "installation_errors.yaml", load_line(EXAMPLES / f"{name}.yaml"))
        assert found.dropper_length == Spread(distribution="normal", scale=1e-3, clip=2)
        assert found.known.droppers[0].length == 3e-3
        assert found.known.wires[0].tension == -50.0
        assert found.seed == 2017
        assert not [field for field in Installation.model_fields if getattr(found, field) is None]


def test_a_line_file_holds_the_same_section(line: Line) -> None:
    errors = load_installation(EXAMPLES / "installation_errors.yaml", line)
    tree = line.model_dump(mode="json") | {"installation": errors.model_dump(mode="json")}
    assert Line.model_validate(tree).installation == errors
    assert line.installation is None


def test_usual_errors_state_a_distribution_of_every_kind() -> None:
    usual = usual_installation()
    spreads = [value for field, value in usual if field not in ("known", "seed")]
    assert all(spread is not None and spread.distribution == "uniform" for spread in spreads)
    assert usual.known.droppers == usual.known.supports == usual.known.wires == ()


@pytest.mark.parametrize(
    ("text", "place", "field", "allowed"),
    [
        ("dropper_length: {distribution: normal}", 1, "dropper_length.scale", "a value, for this field"),
        ("dropper_length: {scale: 2 mm}", 1, "dropper_length.distribution", "a value, for this field"),
        ("dropper_length: {distribution: gauss, scale: 2 mm}", 1, "dropper_length.distribution", "normal or"),
        ("dropper_length: {distribution: normal, scale: -2 mm}", 1, "dropper_length.scale", "not negative"),
        ("dropper_length: {distribution: normal, scale: 2 N}", 1, "dropper_length.scale", "a length"),
        ("dropper_length: {distribution: normal, scale: 2 km}", 1, "dropper_length.scale", "1 or less"),
        ("contact_height: {distribution: uniform, scale: 2 mm, clip: 2}", 1, "contact_height.clip", "normal"),
        ("tension: {distribution: uniform}", 1, "tension.scale", "or fraction instead"),
        ("tension: {distribution: uniform, scale: 9 N, fraction: 0.1}", 1, "tension.fraction", "not both"),
        ("tension: {distribution: uniform, scale: 2 mm}", 1, "tension.scale", "a force"),
        ("dropper_lenght: {distribution: normal, scale: 2 mm}", 1, "dropper_lenght", "dropper_length?"),
        ("seed: -1", 1, "seed", "0 or more"),
        ("known:\n  droppers: [{span: 4, dropper: 1}]", 2, "known.droppers[0].span", "a span from 1 to 3"),
        ("known:\n  droppers: [{span: 3, dropper: 8}]", 2, "known.droppers[0].dropper", "from 1 to 7"),
        (
            "known:\n  droppers: [{span: 3, dropper: 1, carries: auxiliary messenger}]",
            2,
            "known.droppers[0].dropper",
            "no such dropper",
        ),
        (
            "known:\n  droppers: [{span: 3, dropper: 1}, {span: 3, dropper: 1}]",
            2,
            "known.droppers[1]",
            "once",
        ),
        ("known:\n  supports: [{support: S22}]", 2, "known.supports[0].support", "(did you mean S"),
        ("known:\n  supports: [{support: S2}]", 2, "known.supports[0].wire", "a wire that S2 holds"),
        ("known:\n  wires: [{wire: auxiliary messenger, tension: 1 N}]", 2, "known.wires[0].wire", "one of"),
        ("known:\n  wires: [{wire: contact wire}]", 2, "known.wires[0].tension", "a value, for this field"),
    ],
)
def test_faults_have_a_place_and_say_what_is_allowed(
    tmp_path: Path, line: Line, text: str, place: int, field: str, allowed: str
) -> None:
    [(at, name, _, message)] = faults(tmp_path, line, text + "\n")
    assert (at, name) == (place, field)
    assert allowed in message


def test_a_fixed_termination_has_no_error_of_tension(tmp_path: Path, line: Line) -> None:
    tree = line.model_dump(mode="json")
    tree["messenger_wire"]["tension"]["device"] = {"kind": "fixed"}
    fixed = Line.model_validate(tree)
    text = "known:\n  wires: [{wire: messenger wire, tension: 10 N}]\n"
    [(_, field, _, allowed)] = faults(tmp_path, fixed, text)
    assert field == "known.wires[0].wire"
    assert "tensioning device" in allowed


def test_a_line_with_errors_of_what_it_does_not_have_is_refused(line: Line, tmp_path: Path) -> None:
    file = tmp_path / "line.yaml"
    text = (EXAMPLES / "yang2017_three_span.yaml").read_text(encoding="utf-8")
    file.write_text(text + "\ninstallation:\n  known: {droppers: [{span: 9, dropper: 1}]}\n", "utf-8")
    with pytest.raises(LineFileError) as caught:
        load_line(file)
    [fault] = caught.value.faults
    assert fault.field == "installation.known.droppers[0].span"
    assert fault.line == len(text.splitlines()) + 3


def test_the_summary_of_a_line_tells_its_errors(line: Line) -> None:
    assert "Errors of installation" not in dict(summarise(line))
    errors = load_installation(EXAMPLES / "installation_errors.yaml", line)
    tree = line.model_dump(mode="json") | {"installation": errors.model_dump(mode="json")}
    rows = dict(dict(summarise(Line.model_validate(tree)))["Errors of installation"])
    assert rows["dropper length"] == "normal, 1 mm, within 2 deviations"
    assert rows["tension"] == "triangular, 2 %"
    assert rows["known errors"] == "4"
    assert len(rows) == 8
