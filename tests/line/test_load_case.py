"""Files and options of load cases: quantities, defaults, and every fault at its place."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from catenaria.errors import InconsistentInputError, LineFileError
from catenaria.line.load_case import Ice, LoadCase, load_cases
from catenaria.line.load_options import read_cases

EXAMPLE = Path(__file__).parents[2] / "examples" / "load_cases.yaml"


def faults(tmp_path: Path, body: str) -> list[tuple[int, str, str]]:
    """Return line, field and what is allowed of everything that is wrong in a file."""
    file = tmp_path / "cases.yaml"
    file.write_text(body)
    with pytest.raises(LineFileError) as error:
        load_cases(file)
    return [(fault.line, fault.field, fault.allowed) for fault in error.value.faults]


def test_the_example() -> None:
    cases = load_cases(EXAMPLE).cases
    assert cases["winter"].warming(15.0) == -45.0
    assert cases["summer"].warming(15.0) == 40.0
    wind = cases["storm"].wind
    assert wind is not None
    assert (wind.speed, wind.direction, wind.drag, wind.gust_factor) == (33.3, 270.0, 1.1, 1.0)
    ice = cases["ice and wind"].ice
    assert ice is not None
    assert ice.thickness == 0.01
    assert cases["settled support"].moved_supports[0].vertical == -0.01
    assert [push.force for push in cases["pushed"].push] == [200.0, 200.0]


def test_units() -> None:
    case = LoadCase.model_validate({"wind": {"speed": "93.6 km/h"}, "ice": {"messenger_wire": "0.7 daN/m"}})
    assert case.wind is not None
    assert case.wind.speed == pytest.approx(26.0)
    assert case.ice is not None
    assert case.ice.messenger_wire == pytest.approx(7.0)
    assert LoadCase().warming(15.0) == 0.0


HEAD = "format: 1\ncases:\n  one:\n    "


@pytest.mark.parametrize(
    ("body", "field", "allowed"),
    [
        ("temperature: {change: 40 degC}", "temperature.change", 'for example "40 K"'),
        ("temperature: {actual: 300 K}", "temperature.actual", 'for example "15 degC"'),
        ("temperature: {}", "temperature.change", "one of change and actual"),
        ("temperature: {change: 40 K, actual: 3 degC}", "temperature.actual", "this or change, not both"),
        ("wind: {speed: -3 m/s}", "wind.speed", "0 to 150 m/s"),
        ("temperature: {change: 400 K}", "temperature.change", "-200 to 200 K"),
        ("wind: {speed: 3 m/s, drag: 0}", "wind.drag", "more than 0"),
        ("wind: {speed: 3 m/s, direction: 3 m}", "wind.direction", 'an angle, for example "90 deg"'),
        ("wind: {speed: 3 m/s, on: [masts]}", "wind.on[0]", "wires or droppers"),
        ("wind: {speed: 3 m/s, on: []}", "wind.on", "a list of 1 or more"),
        ("wind: {velocity: 3 m/s}", "wind.velocity", "the fields speed"),
        ("ice: {}", "ice.messenger_wire", "is needed"),
        ("ice: {contact_wire: 3 N/m}", "ice.messenger_wire", "contact_wire is given"),
        ("ice: {altitude: 3 m, thickness: 3 mm}", "ice.thickness", "this or altitude"),
        ("ice: {altitude: 3 m, contact_wire: 3 N/m}", "ice.contact_wire", "only with messenger_wire"),
        ("broken_droppers: [{span: 0, number: 1}]", "broken_droppers[0].span", "1 or more"),
        ("moved_supports: [{vertical: 3 mm}]", "moved_supports[0].support", "a value"),
        ("push: [{chainage: 3 m}]", "push[0].force", "a value"),
    ],
)
def test_faults(tmp_path: Path, body: str, field: str, allowed: str) -> None:
    found = faults(tmp_path, HEAD + body + "\n")
    assert [(line, name) for line, name, _ in found if name == f"cases.one.{field}"] == [
        (4, f"cases.one.{field}")
    ]
    assert any(allowed in text for _, _, text in found)


def test_cases_need_names_that_folders_can_have(tmp_path: Path) -> None:
    assert faults(tmp_path, "format: 1\ncases: {}\n")[0][1] == "cases"
    assert "a name of letters" in faults(tmp_path, "format: 1\ncases: {a/b: {}}\n")[0][2]
    assert "a name of letters" in faults(tmp_path, "format: 1\ncases: {..: {}}\n")[0][2]
    assert "a name of letters" in faults(tmp_path, "format: 1\ncases: {cases.csv: {}}\n")[0][2]
    twins = faults(tmp_path, "format: 1\ncases: {wind: {}, Wind: {}}\n")
    assert twins[0][1:] == ("cases.Wind", "a name that differs from wind by more than its case")
    assert faults(tmp_path, "format: 2\ncases: {a: {}}\n")[0][1] == "format"


def test_ice_has_one_way() -> None:
    assert Ice(altitude=700.0).altitude == 700.0
    with pytest.raises(ValueError, match="not both"):
        Ice(altitude=700.0, messenger_wire=3.0)


def test_options_act_together_at_every_temperature() -> None:
    cases = read_cases((), ["40 K", "-30 K", "55 degC"], "26 m/s@270 deg", ["200 N@60 m"]).cases
    assert [case.warming(15.0) for case in cases.values()] == [40.0, -30.0, 40.0]
    for case in cases.values():
        assert case.wind is not None
        assert (case.wind.speed, case.wind.direction) == (26.0, 270.0)
        assert case.push[0].chainage == 60.0


def test_one_case_of_a_file() -> None:
    assert list(read_cases([f"{EXAMPLE}:storm"]).cases) == ["storm"]
    assert list(read_cases([f"{EXAMPLE}:storm", f"{EXAMPLE}:ice"]).cases) == ["storm", "ice"]
    with pytest.raises(LineFileError, match="did you mean storm"):
        read_cases([f"{EXAMPLE}:strom"])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "no load case"),
        ({"files": [f"{EXAMPLE}:ice", f"{EXAMPLE}:ice"]}, "two load cases 'ice'"),
        ({"pushes": ["200 N"]}, "FORCE@CHAINAGE"),
        ({"temperatures": ["40"], "wind": "26"}, None),
        ({"temperatures": ["warm"]}, "a difference of temperatures"),
        ({"wind": "26 m"}, "a speed"),
        ({"files": ["nowhere.yaml"]}, "nowhere.yaml"),
    ],
)
def test_options(options: dict[str, Any], message: str | None) -> None:
    if message is None:
        assert list(read_cases(**options).cases) == ["warmer 40 K + wind 26"]
        return
    with pytest.raises((LineFileError, InconsistentInputError), match=message):
        read_cases(**options)
