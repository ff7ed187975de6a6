"""Pages: every number with its reference, difference, tolerance and verdict."""

from __future__ import annotations

from collections.abc import Callable

from catenaria.validation import CaseOutcome
from catenaria.validation.page import case_page, cells, figure_name, headings, overview

Outcome = Callable[..., CaseOutcome]


def test_a_row_holds_everything(outcome: Outcome) -> None:
    comparison = outcome([6.42, 5.0], [6.4099, 5.2]).comparisons[0]
    assert headings(comparison.check) == [
        "",
        "reference [mm]",
        "direct [mm]",
        "difference",
        "dynamic [mm]",
        "difference",
        "tolerance [mm]",
        "verdict",
    ]
    assert cells(comparison) == [
        ["first", "6.41", "6.42", "+0.01", "6.41", "0.00", "0.05", "agrees"],
        ["second", "5", "5.00", "0.00", "5.20", "+0.20", "0.05", "differs"],
    ]


def test_a_page_says_what_is_compared_and_why(outcome: Outcome) -> None:
    page = case_page(outcome([6.42, 5.0], [6.41, 5.2], {"between": (-0.3, 0.3), "why": "The book rounds."}))
    for text in (
        "# A wire\n",
        "Reference: a book.",
        "One wire.",
        "3 agree, 1 differ and are explained, and 0 differ",
        "### Sag\n\nReference: Fig. 22. Tolerance: printed to 0.01 mm.",
        "| second | 5 | 5.00 | 0.00 | 5.20 | +0.20 | 0.05 | explained |",
        "Explained between -0.3 and +0.3 mm: The book rounds.",
        "## Discussion\n\nNothing else.",
        "](figures/wire_sag.png)",
        "Beside Fig. 22 of the paper. Sag.",
    ):
        assert text in page


def test_a_page_without_differences_explains_nothing(outcome: Outcome) -> None:
    page = case_page(outcome([6.42, 5.0], [6.41, 5.0], {"between": (-0.3, 0.3), "why": "The book rounds."}))
    assert "The book rounds" not in page
    assert "4 agree, 0 differ and are explained, and 0 differ" in page


def test_the_overview_counts_verdicts(outcome: Outcome) -> None:
    page = overview([outcome([6.42, 5.0], [6.41, 5.2])])
    assert "| [A wire](wire.md) | a book | 3 | 0 | 1 |" in page


def test_figures_are_named_after_their_case(outcome: Outcome) -> None:
    judged = outcome([6.42, 5.0], [6.41, 5.2])
    assert figure_name(judged.name, judged.case.figures[0]) == "wire_sag.png"
