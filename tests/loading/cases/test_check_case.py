"""Cases that name what a line does not have are refused, with the place in their file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from catenaria.errors import InconsistentInputError, LineFileError
from catenaria.line.load_case import LoadCase, LoadCases, load_cases
from catenaria.loading.check_case import case_problems, check_cases

Make = Callable[..., Any]

FAULTY = [
    ({"broken_droppers": [{"span": 9, "number": 1}]}, "span", "a span with droppers: 1, 2, 3"),
    ({"broken_droppers": [{"span": 2, "number": 8}]}, "number", "a dropper of span 2: 1, 2, 3, 4, 5"),
    ({"broken_droppers": [{"span": 2, "number": 1, "wire": "messenger wire"}]}, "wire", "contact wire"),
    ({"moved_supports": [{"support": "S22"}]}, "support", "S1, S2, S3, S4 (did you mean S2?)"),
    ({"moved_supports": [{"support": "S2", "wire": "stitch wire"}]}, "wire", "contact wire, messenger wire"),
    ({"push": [{"chainage": 500.0, "force": 100.0}]}, "chainage", "on the contact wire: -3"),
    ({"push": [{"chainage": 50.0, "force": 100.0, "wire": "contact"}]}, "wire", "did you mean contact wire?"),
]


@pytest.mark.parametrize(("case", "field", "allowed"), FAULTY)
def test_what_a_line_does_not_have(make: Make, case: dict[str, Any], field: str, allowed: str) -> None:
    problems = list(case_problems(LoadCase.model_validate(case), make().result))
    assert len(problems) == 1
    assert problems[0].path[-1] == field
    assert allowed in problems[0].allowed


def test_what_a_line_has_is_not_refused(make: Make) -> None:
    good = LoadCase.model_validate(
        {
            "broken_droppers": [{"span": 2, "number": 5, "wire": "contact wire"}],
            "moved_supports": [{"support": "S4", "wire": "messenger wire", "lateral": 0.01}],
            "push": [{"chainage": 179.0, "force": 100.0}],
        }
    )
    assert list(case_problems(good, make().result)) == []


def test_the_place_in_the_file_is_named(make: Make, tmp_path: Path) -> None:
    file = tmp_path / "cases.yaml"
    file.write_text(
        "format: 1\ncases:\n  good: {push: [{chainage: 60 m, force: 100 N}]}\n"
        "  bad:\n    broken_droppers:\n      - {span: 2, number: 8}\n      - {span: 7, number: 1}\n"
    )
    with pytest.raises(LineFileError) as error:
        check_cases(load_cases(file), make().result)
    first, second = error.value.faults
    assert (first.file, first.line, first.field) == (str(file), 6, "cases.bad.broken_droppers[0].number")
    assert (second.line, second.field, second.found) == (7, "cases.bad.broken_droppers[1].span", "7")


def test_without_a_file_it_is_inconsistent_input(make: Make) -> None:
    cases = LoadCases.model_validate({"format": 1, "cases": {"bad": {"moved_supports": [{"support": "X"}]}}})
    with pytest.raises(InconsistentInputError, match=r"cases.bad.moved_supports\[0\].support: found X"):
        check_cases(cases, make().result)
