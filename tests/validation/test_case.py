"""Cases as data: what a case may say, where they are found, and that they name their sources."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from catenaria.errors import InconsistentInputError
from catenaria.line import load_line
from catenaria.validation import Case, case_names, example_file, load_case
from catenaria.validation.load import FOLDERS, read_case

CASES = case_names()
FAULTS: dict[str, tuple[dict[str, Any], str]] = {
    "too few references": ({"reference": [6.41]}, "2 numbers, one for each row"),
    "too many tolerances": ({"tolerance": [1, 2, 3]}, "2 numbers, one for each row"),
    "an unknown run": ({"columns": [{"title": "x", "runs": ["c"]}]}, "one of a, b"),
    "an unknown run to subtract": ({"minus": "c"}, "one of a, b"),
    "an unknown unit": ({"unit": "ft"}, "unit"),
    "a typing error": ({"tolerence": 1.0}, "did you mean tolerance"),
    "no reason": ({"reason": None}, "reason"),
    "an explanation without size": ({"known": {"between": (0.0, 0.0), "why": "?"}}, "ascends"),
}


def test_a_sound_case_is_read(data: dict[str, Any]) -> None:
    case = Case.model_validate(data)
    assert case.checks[0].tolerances == (0.05, 0.05)
    assert case.runs["a"].method == "direct"


@pytest.mark.parametrize(("fault", "message"), FAULTS.values(), ids=FAULTS)
def test_a_fault_in_a_check_is_refused(data: dict[str, Any], fault: dict[str, Any], message: str) -> None:
    with pytest.raises(ValidationError, match=message):
        Case.model_validate(data | {"checks": [data["checks"][0] | fault]})


@pytest.mark.parametrize("fault", [{"runs": ["c"]}, {"of": ["Length"]}])
def test_a_fault_in_a_figure_is_refused(data: dict[str, Any], fault: dict[str, Any]) -> None:
    with pytest.raises(ValidationError, match="one of"):
        Case.model_validate(data | {"figures": [data["figures"][0] | fault]})


def test_titles_are_unique(data: dict[str, Any]) -> None:
    with pytest.raises(ValidationError, match="a title of its own"):
        Case.model_validate(data | {"checks": data["checks"] * 2})


def test_a_file_that_is_no_case_is_named(tmp_path: Path) -> None:
    (tmp_path / "empty.yaml").write_text("title: nothing\n", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"empty\.yaml"):
        read_case(tmp_path / "empty.yaml")


def test_an_unknown_case_is_refused_by_name() -> None:
    with pytest.raises(InconsistentInputError, match="did you mean three_spans"):
        load_case("three_span")


@pytest.mark.parametrize("name", CASES)
def test_every_number_of_a_case_has_a_source_and_a_reason(name: str) -> None:
    case = load_case(name)
    assert "Yang et al. 2017" in case.source
    for check in case.checks:
        assert len(check.source) > 5
        assert len(check.reason) > 10
        assert all(tolerance >= 0.0 for tolerance in check.tolerances)


@pytest.mark.parametrize("name", CASES)
def test_the_files_of_a_case_are_examples(name: str) -> None:
    for run in load_case(name).runs.values():
        assert example_file(run.file).is_file()


def test_the_wheel_brings_the_examples_along() -> None:
    """Installed, they lie within the package, where `example_file` looks first."""
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))
    wheel = project["tool"]["hatch"]["build"]["targets"]["wheel"]
    assert wheel["force-include"] == {"examples": "catenaria/examples"}
    assert FOLDERS[0].parts[-2:] == ("catenaria", "examples")


def test_an_example_is_found_and_a_missing_one_is_not() -> None:
    assert load_line(example_file("yang2017_three_span.yaml")).length == pytest.approx(195.0)
    with pytest.raises(InconsistentInputError, match="no example nothing"):
        example_file("nothing.yaml")
