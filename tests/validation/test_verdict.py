"""Verdicts: within the tolerance, explained beyond it, and different."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.validation import CaseOutcome, Check, Verdict, compare

Outcome = Callable[..., CaseOutcome]

GOOD = [6.41, 5.0]
KNOWN = {"between": (-0.5, 0.5), "why": "The book rounds."}


def verdicts(outcome: CaseOutcome) -> list[list[str]]:
    return [[verdict.value for verdict in column] for column in outcome.comparisons[0].verdicts]


@pytest.mark.parametrize("size", [0.0, 0.049, -0.049])
def test_within_the_tolerance_numbers_agree(outcome: Outcome, size: float) -> None:
    assert verdicts(outcome([6.41 + size, 5.0], GOOD)) == [["agrees", "agrees"], ["agrees", "agrees"]]


@pytest.mark.parametrize("size", [0.051, -0.051, 1.0, np.nan, np.inf])
def test_beyond_the_tolerance_a_number_differs(outcome: Outcome, size: float) -> None:
    judged = outcome([6.41 + size, 5.0], GOOD)
    assert verdicts(judged) == [["differs", "agrees"], ["agrees", "agrees"]]
    assert judged.counts == (3, 0, 1)


def test_a_known_difference_is_explained_up_to_its_size(outcome: Outcome) -> None:
    judged = outcome([6.41 + 0.4, 5.0], [6.41 - 0.51, 5.0], KNOWN)
    assert verdicts(judged) == [["explained", "agrees"], ["differs", "agrees"]]
    assert judged.counts == (2, 1, 1)
    assert judged.comparisons[0].explanation == "Explained between -0.5 and +0.5 mm: The book rounds."


def test_a_difference_to_the_other_side_is_not_explained(outcome: Outcome) -> None:
    judged = outcome([6.41 + 0.4, 5.0], [6.41 - 0.4, 5.0], KNOWN | {"between": (-0.5, 0.0)})
    assert verdicts(judged) == [["differs", "agrees"], ["explained", "agrees"]]


def test_what_agrees_needs_no_explanation(outcome: Outcome) -> None:
    assert outcome(GOOD, GOOD, KNOWN).comparisons[0].explanation == ""


def test_units_are_those_of_the_check(outcome: Outcome) -> None:
    comparison = outcome(GOOD, [6.0, 5.0]).comparisons[0]
    np.testing.assert_allclose(comparison.observed, [GOOD, [6.0, 5.0]])
    np.testing.assert_allclose(comparison.difference, [[0.0, 0.0], [-0.41, 0.0]], atol=1e-12)


def test_each_number_may_have_its_tolerance(check: Check) -> None:
    own = check.model_copy(update={"tolerance": (0.05, 1.0)})
    judged = compare(own, [np.array([6.41e-3, 5.9e-3])] * 2)
    assert judged.verdicts[0] == (Verdict.AGREES, Verdict.AGREES)
    assert compare(check, [np.array([6.41e-3, 5.9e-3])] * 2).verdicts[0][1] is Verdict.DIFFERS


def test_a_missing_number_is_an_error(check: Check) -> None:
    with pytest.raises(InconsistentInputError, match="Sag, dynamic: 1 numbers were computed, 2 are known"):
        compare(check, [np.array([6.41e-3, 5e-3]), np.array([6.41e-3])])
