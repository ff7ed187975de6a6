"""Run validation cases and compare what they give with what is known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.line import load_line
from catenaria.results import FormResult
from catenaria.results.structure import StructureForm
from catenaria.structure import load_structure
from catenaria.validation import Case, CaseOutcome, Check, Run, compare, example_file, load_case
from catenaria.workflow.observables import observe
from catenaria.workflow.rebuilt_structure import rebuilt_structure
from catenaria.workflow.solve import solve
from catenaria.workflow.solve_structure import solve_structure
from catenaria.workflow.structure_observables import observe_structure
from catenaria.workflow.variation import vary

FloatArray = NDArray[np.float64]
Result = FormResult | StructureForm


@dataclass(frozen=True)
class CaseProgress:
    """One message: the run that begins now.

    Attributes
    ----------
    case, run : str
        Names.
    number, count : int
        Number of the run within its case, from 1, and how many there are.
    """

    case: str
    run: str
    number: int
    count: int


@dataclass(frozen=True)
class ValidatedCase:
    """A case with its results by name of run, and the verdicts on them."""

    outcome: CaseOutcome
    results: dict[str, Result]


def validate(name: str, progress: Callable[[CaseProgress], None] | None = None) -> ValidatedCase:
    """Compute a case of the literature and compare it with what is known.

    Parameters
    ----------
    name : str
        One of `catenaria.validation.case_names`.
    progress : callable, optional
        Is told which run begins.

    Raises
    ------
    InconsistentInputError
        If there is no such case.
    CatenariaError
        If a run fails.
    """
    return run_case(name, load_case(name), progress)


def run_case(name: str, case: Case, progress: Callable[[CaseProgress], None] | None = None) -> ValidatedCase:
    """Compute any case; see `validate`."""
    results: dict[str, Result] = {}
    for number, (run_name, run) in enumerate(case.runs.items(), start=1):
        if progress is not None:
            progress(CaseProgress(name, run_name, number, len(case.runs)))
        results[run_name] = carry_out(run, results)
    return judge(name, case, results)


def judge(name: str, case: Case, results: dict[str, Result]) -> ValidatedCase:
    """Compare the results of a case's runs with what is known."""
    comparisons = tuple(compare(check, _observed(check, results)) for check in case.checks)
    return ValidatedCase(CaseOutcome(name, case, comparisons), results)


def carry_out(run: Run, earlier: Mapping[str, Result]) -> Result:
    """Carry out one run of a case, after the earlier ones."""
    file = example_file(run.file)
    if run.kind == "line":
        return solve(vary(load_line(file), run.change), run.method, rebuild="none")
    structure = vary(load_structure(file), run.change)
    found = earlier.get(run.rebuilds or "")
    if isinstance(found, StructureForm):
        structure = rebuilt_structure(structure, found)
    return solve_structure(structure, run.method)


def _observed(check: Check, results: dict[str, Result]) -> list[FloatArray]:
    """Return the numbers of each column; several runs of a column are put in a row."""

    def of(run: str) -> FloatArray:
        result = results[run]
        if isinstance(result, FormResult):
            return observe(result, check.quantity, check.of)
        return observe_structure(result, check.quantity, check.of)

    def beyond(run: str) -> FloatArray:
        return of(run) if check.minus is None else of(run) - of(check.minus)

    return [np.concatenate([beyond(run) for run in column.runs]) for column in check.columns]
