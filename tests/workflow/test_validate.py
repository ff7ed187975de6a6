"""Validation: every verdict on every case, pages that say what is computed, and cases that must fail.

The documentation's pages are computed anew and compared: words exactly, numbers to a few units of their last
digit. If a page is out of date, `catenaria validate --out docs/validation` writes it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.errors import InconsistentInputError, UnsupportedError
from catenaria.results import FormResult
from catenaria.validation import Case, Check, Run, case_names, load, load_case
from catenaria.validation.page import FIGURES, case_page, figure_name, overview
from catenaria.workflow import CaseProgress, ValidatedCase, validate, write_validation
from catenaria.workflow.observables import observe
from catenaria.workflow.validate import carry_out, judge, run_case

PAGES = Path(__file__).parents[2] / "docs" / "validation"
CASES = case_names()
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?![\w])")
LAST_DIGITS = 5.0  # units of the last digit by which numbers of a page may be off

Validated = Callable[[str], ValidatedCase]


@pytest.fixture(scope="session")
def validated() -> Validated:
    """Validate each case once."""
    done: dict[str, ValidatedCase] = {}

    def once(name: str) -> ValidatedCase:
        if name not in done:
            done[name] = validate(name)
        return done[name]

    return once


def disagreements(one: str, other: str) -> list[str]:
    """Name words that are not the same in two pages, and numbers that are further apart than rounding."""
    if NUMBER.sub("#", one) != NUMBER.sub("#", other):
        pairs = zip(NUMBER.sub("#", one).splitlines(), NUMBER.sub("#", other).splitlines(), strict=False)
        return next(([a, b] for a, b in pairs if a != b), ["one is longer"])
    return [
        f"{a} and {b}"
        for a, b in zip(NUMBER.findall(one), NUMBER.findall(other), strict=True)
        if abs(float(a) - float(b)) > LAST_DIGITS * 0.1 ** len(a.partition(".")[2])
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_no_number_differs(validated: Validated, name: str) -> None:
    outcome = validated(name).outcome
    agree, _, differ = outcome.counts
    assert [each.check.title for each in outcome.comparisons if each.counts[2]] == []
    assert (differ, agree > 0) == (0, True)


def corrupted(check: Check, row: int) -> Check:
    """Return a check whose reference is further away than tolerance and explanation reach."""
    known = 0.0 if check.known is None else 2.0 * max(map(abs, check.known.between))
    reference = list(check.reference)
    reference[row] += 2.0 * check.tolerances[row] + known + 1e-6
    return check.model_copy(update={"reference": tuple(reference)})


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_a_changed_reference_is_noticed(validated: Validated, name: str) -> None:
    """Negative control: one number of each check is off."""
    case, results = validated(name).outcome.case, validated(name).results
    checks = tuple(corrupted(check, i % len(check.rows)) for i, check in enumerate(case.checks))
    outcome = judge(name, case.model_copy(update={"checks": checks}), results).outcome
    assert [each.check.title for each in outcome.comparisons if not each.counts[2]] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_the_documentation_says_what_is_computed(validated: Validated, name: str) -> None:
    page = (PAGES / f"{name}.md").read_text(encoding="utf-8")
    assert disagreements(page, case_page(validated(name).outcome)) == []


@pytest.mark.slow
def test_the_overview_is_that_of_all_cases(validated: Validated) -> None:
    page = (PAGES / "index.md").read_text(encoding="utf-8")
    assert disagreements(page, overview([validated(name).outcome for name in CASES])) == []


@pytest.mark.parametrize("old", ["14.9951 kN, agrees", "14.9944 kN, differs", "14.995 kN, agrees"])
def test_a_page_that_is_out_of_date_is_noticed(old: str) -> None:
    """Negative control: another number, another verdict, fewer digits that hide a difference."""
    new = "14.9944 kN, agrees"
    assert (disagreements(old, new) == []) == (old == "14.995 kN, agrees")


@pytest.mark.parametrize("name", CASES)
def test_the_documentation_has_all_figures(name: str) -> None:
    for drawing in load_case(name).figures:
        assert (PAGES / FIGURES / figure_name(name, drawing)).stat().st_size > 5_000


def small_case(small_file: Path, **changes: Any) -> Case:
    """Build a case of the small line."""
    check: dict[str, Any] = {
        "title": "Heights",
        "source": "the line itself",
        "quantity": "height error",
        "unit": "mm",
        "decimals": 3,
        "rows": ["1", "2"],
        "reference": [0, 0],
        "tolerance": 0.001,
        "reason": "it is a target",
        "columns": [{"title": "direct", "runs": ["a"]}],
    }
    drawing = {"name": "a", "drawn": "contact wire", "runs": ["a"], "paper": "Fig. 22", "text": "A."}
    runs = {
        "a": {"file": str(small_file)},
        "b": {"file": str(small_file), "change": {"messenger_wire.tension.force": "15.5 kN"}},
    }
    return Case.model_validate(
        {
            "title": "Small",
            "source": "a book",
            "text": "A line.",
            "runs": runs,
            "checks": [check | changes],
            "figures": [drawing],
        }
    )


def test_a_case_is_computed_and_told_about(small_file: Path) -> None:
    told: list[CaseProgress] = []
    validated = run_case("small", small_case(small_file), told.append)
    assert validated.outcome.counts == (2, 0, 0)
    assert told == [CaseProgress("small", "a", 1, 2), CaseProgress("small", "b", 2, 2)]
    changed = validated.results["b"]
    assert isinstance(changed, FormResult)
    assert changed.wires[1].target_tension == 15.5e3


def test_a_quantity_may_be_a_difference_of_runs(small_file: Path) -> None:
    change = {"quantity": "mean messenger tension", "rows": ["more"], "minus": "a", "unit": "kN"}
    column = {"columns": [{"title": "direct", "runs": ["b"]}], "reference": [0.5], "tolerance": 0.005}
    assert run_case("small", small_case(small_file, **change, **column)).outcome.counts == (1, 0, 0)
    wrong = column | {"reference": [0.49]}
    assert run_case("small", small_case(small_file, **change, **wrong)).outcome.counts == (0, 0, 1)


def test_several_runs_of_a_column_are_put_in_a_row(small_file: Path) -> None:
    change = {"quantity": "messenger reaction", "reference": [15, 15.5], "unit": "kN"}
    column = {"columns": [{"title": "direct", "runs": ["a", "b"]}]}
    assert run_case("small", small_case(small_file, **change, **column)).outcome.counts == (2, 0, 0)


def test_an_unknown_quantity_is_refused(small_file: Path) -> None:
    with pytest.raises(InconsistentInputError, match="no quantity 'colour'"):
        run_case("small", small_case(small_file, quantity="colour"))


def test_an_unknown_method_is_refused(small_file: Path) -> None:
    with pytest.raises(UnsupportedError, match="no method 'guess'"):
        carry_out(Run.model_construct(file=str(small_file), method="guess"), {})


def test_pages_are_written_whole_or_not_at_all(
    small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    validated, folder = run_case("small", small_case(small_file)), tmp_path / "pages"
    files = write_validation([validated], folder)
    assert [str(file.relative_to(folder)) for file in files] == [
        "figures/small_a.png",
        "index.md",
        "small.md",
    ]
    before = (folder / "small.md").read_bytes()

    def failing(*_: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr("catenaria.workflow.validation_figures.draw", failing)
    with pytest.raises(OSError, match="disk full"):
        write_validation([validated], folder)
    assert (folder / "small.md").read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == {"pages"}


def test_pages_do_not_replace_foreign_files(small_file: Path, tmp_path: Path) -> None:
    (tmp_path / "thesis.md").write_text("mine", encoding="utf-8")
    with pytest.raises(InconsistentInputError, match=r"thesis\.md"):
        write_validation([run_case("small", small_case(small_file))], tmp_path)


@pytest.mark.slow
def test_droppers_are_chosen_by_number(validated: Validated) -> None:
    result = validated("three_spans").results["direct"]
    assert isinstance(result, FormResult)
    some = observe(result, "dropper length", ["2", "11"])
    np.testing.assert_array_equal(some, result.droppers.length[[1, 10]])


def test_the_command_passes_and_writes_pages(command: Callable[..., Any], tmp_path: Path) -> None:
    process = command("validate", "rod", "--out", "pages")
    stdout, stderr = process.communicate()
    assert (process.returncode, stderr) == (0, "")
    assert "0 differ." in stdout
    assert (tmp_path / "pages" / "rod.md").is_file()


def test_the_command_fails_when_a_reference_is_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Negative control: 45.03 N of Table 1 becomes 45.05 N, two tolerances away."""
    text = (Path(load.__file__).parent / "cases" / "rod.yaml").read_text(encoding="utf-8")
    (tmp_path / "rod.yaml").write_text(text.replace("45.03,", "45.05,"), encoding="utf-8")
    monkeypatch.setattr(load, "CASES", tmp_path)
    outcome = CliRunner().invoke(app, ["validate", "rod"])
    assert outcome.exit_code == 1
    assert outcome.stderr.startswith("rod: Forces of the bars, rigid rod, fixed tops (Table 1, analytic")
