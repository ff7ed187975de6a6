"""From a folder to a report: studies beside it count if they belong to it, and files are written whole."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from catenaria import workflow
from catenaria.errors import InconsistentInputError, NotConvergedError, UnsupportedError
from catenaria.loading.tolerance import Options
from catenaria.results import FormResult, save_result
from catenaria.results.elasticity import ElasticityStudy
from catenaria.workflow import pdf, studies

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"
CASES = "format: 1\ncases:\n  warm: {temperature: {change: 40 K}}\n  windy: {wind: {speed: 20 m/s}}\n"


@pytest.fixture(scope="module")
def solved() -> FormResult:
    return workflow.solve(EXAMPLE, rebuild="none")


@pytest.fixture(scope="module")
def studied(solved: FormResult) -> ElasticityStudy:
    return workflow.elasticity(solved, spacing=5.0, nonuniformity_limit=0.25)


@pytest.fixture
def folder(solved: FormResult, tmp_path: Path) -> Path:
    folder = tmp_path / "line"
    save_result(solved, folder)
    return folder


def test_a_study_beside_the_result_counts(folder: Path, studied: ElasticityStudy) -> None:
    name = "non-uniformity of elasticity"
    before = {check.name: check for check in workflow.check_result(folder)}[name]
    save_result(studied, folder.with_name("line-elasticity"))
    check = {check.name: check for check in workflow.check_result(folder)}[name]
    assert before.verdict == "not judged"
    assert check.value == pytest.approx(100.0 * studied.nonuniformity)
    assert check.limit == pytest.approx(25.0)
    assert check.verdict == ("passes" if studied.nonuniformity <= 0.25 else "fails")
    page = workflow.report(folder, progress=refused)
    assert '<section id="elasticity">' in page
    assert "elasticity-1" in page
    assert '<section id="elasticity">' not in workflow.report(folder, elasticity=False)


def refused(part: str, done: int, of: int) -> None:
    """Take notice of a study that should not be made."""
    raise AssertionError(f"{part}: {done} of {of}")


def test_without_a_study_the_report_makes_one(folder: Path, solved: FormResult) -> None:
    told: list[str] = []
    page = workflow.report(folder, progress=lambda part, done, of: told.append(part))
    u = 100.0 * workflow.elasticity(solved).nonuniformity
    assert f"non-uniformity {u:.1f} %, in the inner spans" in page
    assert "Push of 100 N" in page
    assert "linear responses" in told
    assert workflow.report(solved) == page
    assert '<section id="elasticity">' not in workflow.report(folder, elasticity=False, progress=refused)
    with pytest.raises(AssertionError, match="linear responses"):
        workflow.report(folder, progress=refused)


@pytest.mark.parametrize("method", ["force density", "least distance"])
def test_a_report_says_why_there_is_no_elasticity(method: str) -> None:
    page = workflow.report(workflow.solve(EXAMPLE, method, rebuild="none"))
    assert '<section id="elasticity">' not in page
    assert page.count("Elasticity is left out") == 1
    assert "has no nodes to start from; direct&#39;s has" in page


def test_a_study_that_fails_leaves_the_report(solved: FormResult, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*_: object, **__: object) -> None:
        raise NotConvergedError("it does not come to rest", "more iterations")

    monkeypatch.setattr(studies, "elasticity", failing)
    page = workflow.report(solved)
    assert '<section id="elasticity">' not in page
    assert "Elasticity is left out: it does not come to rest" in page


def test_checks_make_no_study(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studies, "elasticity", refused)
    check = {check.name: check for check in workflow.check_result(folder)}["non-uniformity of elasticity"]
    assert check.verdict == "not judged"
    assert "catenaria elasticity" in check.why


def test_load_cases_beside_the_result_count(folder: Path, solved: FormResult, tmp_path: Path) -> None:
    cases = tmp_path / "cases.yaml"
    cases.write_text(CASES)
    save_result(workflow.under_loads(solved, cases), folder.with_name("line-loads"))
    page = workflow.report(folder)
    for text in ('<section id="cases">', "cases-height", "cases-lateral", "windy"):
        assert text in page
    assert '<section id="cases">' not in workflow.report(solved)


def test_load_cases_are_judged(folder: Path, solved: FormResult, tmp_path: Path) -> None:
    cases = tmp_path / "cases.yaml"
    cases.write_text(CASES.replace("20 m/s", "60 m/s"))
    save_result(workflow.under_loads(solved, cases), folder.with_name("line-loads"))
    check = {check.name: check for check in workflow.check_result(folder)}[
        "lateral position under load cases"
    ]
    assert check.place.startswith("windy")
    assert check.verdict == "fails"  # 65 m without steady arms


def test_rounded_lengths_and_tolerances_beside_the_result_count(folder: Path, solved: FormResult) -> None:
    assert '<section id="accuracy">' not in workflow.report(folder)
    save_result(workflow.rounding(solved, [1e-3, 5e-3]), folder.with_name("line-rounding"))
    save_result(workflow.tolerances(solved, options=Options(samples=8)), folder.with_name("line-tolerance"))
    page = workflow.report(folder)
    for text in (
        "Rounded dropper lengths",
        "Errors of installation",
        "8 samples, nonlinear",
        "messenger height",
    ):
        assert text in page
    assert "is left out" not in page


def test_accuracy_of_another_state_is_left_out(folder: Path, solved: FormResult) -> None:
    rounded, scattered = (
        workflow.rounding(solved, [1e-3]),
        workflow.tolerances(solved, options=Options(samples=4)),
    )
    save_result(replace(rounded, cut_length=rounded.cut_length + 1e-4), folder.with_name("line-rounding"))
    tension = replace(scattered.tension, nominal=scattered.tension.nominal + 1.0)
    save_result(replace(scattered, tension=tension), folder.with_name("line-tolerance"))
    page = workflow.report(folder)
    assert '<section id="accuracy">' not in page
    assert "line-rounding is left out" in page
    assert "line-tolerance is left out" in page


def test_a_study_of_another_line_is_left_out(folder: Path, studied: ElasticityStudy) -> None:
    other = replace(studied, inputs=studied.inputs | {"gravity": 9.9})
    save_result(other, folder.with_name("line-elasticity"))
    page = workflow.report(folder)
    assert '<section id="elasticity">' in page
    assert "line-elasticity is left out" in page
    assert f"non-uniformity {100.0 * workflow.elasticity(folder).nonuniformity:.1f} %" in page


def test_a_damaged_study_is_not_passed_over(folder: Path, studied: ElasticityStudy) -> None:
    beside = folder.with_name("line-elasticity")
    save_result(studied, beside)
    (beside / "result.npz").write_bytes(b"damaged")
    with pytest.raises(InconsistentInputError, match="damaged"):
        workflow.report(folder)


def test_without_a_browser_nothing_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pdf, "BROWSERS", ("no-such-browser",))
    with pytest.raises(UnsupportedError, match="apt install chromium"):
        workflow.write_report("<p>", tmp_path / "line.html", pdf=True)
    assert list(tmp_path.iterdir()) == []


def test_a_report_in_the_folder_of_the_result(solved: FormResult, tmp_path: Path) -> None:
    files = workflow.write(solved, tmp_path / "line", figures=False, report=True)
    assert tmp_path / "line" / "report.html" in files
    assert (tmp_path / "line" / "report.html").read_text(encoding="utf-8") == workflow.report(solved)
    again = workflow.write(solved, tmp_path / "line", figures=False)  # it belongs to the folder
    assert tmp_path / "line" / "report.html" not in again
