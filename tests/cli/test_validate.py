"""`catenaria validate`: what it prints, its exit codes and messages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from catenaria.cli.main import app
from catenaria.errors import InconsistentInputError, NotConvergedError
from catenaria.validation import Case, CaseOutcome, compare
from catenaria.workflow import CaseProgress

Fake = Callable[..., None]

CASE: dict[str, Any] = {
    "title": "A wire",
    "source": "Yang et al. 2017",
    "text": "",
    "runs": {"a": {"file": "a.yaml"}},
    "checks": [
        {
            "title": "Sag",
            "source": "Fig. 22",
            "quantity": "sag",
            "unit": "mm",
            "decimals": 2,
            "rows": ["sag"],
            "reference": [6.41],
            "tolerance": 0.05,
            "reason": "rounding",
            "known": {"between": (-0.5, 0.5), "why": "The book rounds."},
            "columns": [{"title": "direct", "runs": ["a"]}],
        }
    ],
}


def run(*arguments: str) -> Any:
    return CliRunner().invoke(app, ["validate", *arguments])


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Fake:
    """Let a case observe a given number [mm], or fail; pages go nowhere."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("catenaria.validation.case_names", lambda: ("wire",))

    def install(observed: float, failure: BaseException | None = None) -> None:
        def validate(name: str, tell: Callable[[CaseProgress], None]) -> Any:
            tell(CaseProgress(name, "a", 1, 1))
            if failure is not None:
                raise failure
            case = Case.model_validate(CASE)
            comparison = compare(case.checks[0], [np.array([1e-3 * observed])])
            return SimpleNamespace(outcome=CaseOutcome(name, case, (comparison,)), results={})

        monkeypatch.setattr("catenaria.workflow.validate", validate)
        monkeypatch.setattr(
            "catenaria.workflow.write_validation", lambda cases, folder: (folder / "index.md",)
        )

    return install


def test_numbers_are_printed_with_reference_difference_and_verdict(fake: Fake) -> None:
    fake(6.40)
    outcome = run()
    assert (outcome.exit_code, outcome.stderr) == (0, "")
    for text in ("A wire (wire)", "Sag (Fig. 22)", "reference [mm]", "6.41", "6.40", "-0.01", "agrees"):
        assert text in outcome.stdout
    assert "1 numbers: 1 agree, 0 differ and are explained, 0 differ." in outcome.stdout
    assert "Written" not in outcome.stdout


def test_an_explained_difference_is_explained_and_passes(fake: Fake) -> None:
    fake(6.80)
    outcome = run("wire", "--out", "pages")
    assert outcome.exit_code == 0
    assert "Explained between -0.5 and +0.5 mm: The book rounds." in outcome.stdout
    assert "1 numbers: 0 agree, 1 differ and are explained, 0 differ." in outcome.stdout
    assert "Written to pages: 1 files." in outcome.stdout


def test_a_difference_fails_the_command(fake: Fake) -> None:
    fake(7.0)
    outcome = run()
    assert outcome.exit_code == 1
    assert outcome.stderr == "wire: Sag (Fig. 22) differ.\n"
    assert "1 numbers: 0 agree, 0 differ and are explained, 1 differ." in outcome.stdout


@pytest.mark.parametrize(
    ("failure", "code", "message"),
    [
        (InconsistentInputError("there is no case 'rope'"), 2, "there is no case 'rope'"),
        (NotConvergedError("it wanders", "a better guess", None), 1, "it wanders"),
        (KeyboardInterrupt(), 130, "Interrupted. Nothing was written."),
    ],
)
def test_failures_have_exit_codes(fake: Fake, failure: BaseException, code: int, message: str) -> None:
    fake(0.0, failure)
    outcome = run("wire")
    assert outcome.exit_code == code
    assert message in outcome.stderr


def test_a_folder_of_somebody_else_is_refused_before_anything_is_computed(fake: Fake, tmp_path: Path) -> None:
    fake(6.41, AssertionError("this must not be computed"))
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.md").write_text("mine", encoding="utf-8")
    outcome = run("--out", "mine")
    assert outcome.exit_code == 2
    assert "thesis.md" in outcome.stderr


def test_a_folder_that_cannot_be_written_is_named(fake: Fake, monkeypatch: pytest.MonkeyPatch) -> None:
    fake(6.41)

    def failing(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("catenaria.workflow.write_validation", failing)
    outcome = run("--out", "pages")
    assert outcome.exit_code == 2
    assert outcome.stderr == "pages cannot be written: No space left on device\n"


def test_an_unknown_case_is_bad_input() -> None:
    outcome = run("rope")
    assert outcome.exit_code == 2
    assert "there is no case 'rope'" in outcome.stderr
