"""From observed numbers to verdicts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.validation.case import SI, Case, Check

FloatArray = NDArray[np.float64]


class Verdict(StrEnum):
    """What is to be thought of one number."""

    AGREES = "agrees"
    EXPLAINED = "explained"
    DIFFERS = "differs"


@dataclass(frozen=True)
class Comparison:
    """A check with what was observed.

    Attributes
    ----------
    check : Check
        Reference and tolerance.
    observed, difference : FloatArray, shape (n_columns, n_rows)
        What was computed, and how much more that is than the reference, in the unit of the check.
    verdicts : tuple of tuple of Verdict
        For each column and row.
    """

    check: Check
    observed: FloatArray
    difference: FloatArray
    verdicts: tuple[tuple[Verdict, ...], ...]

    @property
    def counts(self) -> tuple[int, int, int]:
        """How many numbers agree, are explained, differ."""
        agree, explained, differ = (sum(column.count(kind) for column in self.verdicts) for kind in Verdict)
        return agree, explained, differ

    @property
    def explanation(self) -> str:
        """Why numbers are not those of the reference; empty if none needs it."""
        known = self.check.known
        if known is None or not self.counts[1]:
            return ""
        low, high = known.between
        return f"Explained between {low:+g} and {high:+g} {self.check.unit}: {known.why}"


@dataclass(frozen=True)
class CaseOutcome:
    """A case with all its comparisons, in the order of its checks."""

    name: str
    case: Case
    comparisons: tuple[Comparison, ...]

    @property
    def counts(self) -> tuple[int, int, int]:
        """How many numbers agree, are explained, differ."""
        agree, explained, differ = np.sum([each.counts for each in self.comparisons], axis=0).tolist()
        return agree, explained, differ


def compare(check: Check, observed: Sequence[FloatArray]) -> Comparison:
    """Judge observed numbers.

    Parameters
    ----------
    check : Check
        Reference and tolerance.
    observed : sequence of FloatArray
        The numbers of each column, in SI.

    Raises
    ------
    InconsistentInputError
        If there are not as many numbers as references.

    Notes
    -----
    A number agrees within the tolerance; beyond it, its difference is explained if the check gives a reason
    and the range for which the reason accounts. Any other differs, and so does one that is not a number.

    Examples
    --------
    >>> from catenaria.validation import Check, Column
    >>> check = Check(title="sag", source="a book", quantity="sag", unit="mm", decimals=2, rows=("sag",),
    ...     reference=(6.4,), tolerance=0.05, reason="rounding", columns=(Column(title="a", runs=("a",)),))
    >>> compare(check, [np.array([6.41e-3])]).verdicts
    ((<Verdict.AGREES: 'agrees'>,),)
    """
    for column, numbers in zip(check.columns, observed, strict=True):
        if numbers.size != len(check.reference):
            raise InconsistentInputError(
                f"{check.title}, {column.title}: {numbers.size} numbers were computed, "
                f"{len(check.reference)} are known"
            )
    values = np.array(observed) / SI[check.unit]
    difference = values - np.array(check.reference)
    verdicts = tuple(
        tuple(_judge(check, d, tolerance) for d, tolerance in zip(row, check.tolerances, strict=True))
        for row in difference.tolist()
    )
    return Comparison(check, values, difference, verdicts)


def _judge(check: Check, difference: float, tolerance: float) -> Verdict:
    if abs(difference) <= tolerance:
        return Verdict.AGREES
    if check.known is not None and check.known.between[0] <= difference <= check.known.between[1]:
        return Verdict.EXPLAINED
    return Verdict.DIFFERS
