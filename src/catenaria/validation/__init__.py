"""Cases of the literature as data, and verdicts on what is computed for them; nothing is solved here."""

from __future__ import annotations

from catenaria.validation.case import Case, Check, Column, Drawing, Known, Run
from catenaria.validation.load import case_names, example_file, load_case
from catenaria.validation.verdict import CaseOutcome, Comparison, Verdict, compare

__all__ = [
    "Case",
    "CaseOutcome",
    "Check",
    "Column",
    "Comparison",
    "Drawing",
    "Known",
    "Run",
    "Verdict",
    "case_names",
    "compare",
    "example_file",
    "load_case",
]
