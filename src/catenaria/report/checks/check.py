"""One check: a value beside its limit, and the verdict."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from catenaria.report.checks.rules import Rule

Verdict = Literal["passes", "fails", "not judged"]
Quantity = TypeVar("Quantity", bound=float)


@dataclass(frozen=True)
class Check:
    """A value beside its limit.

    Attributes
    ----------
    name : str
        What was checked.
    rule, source, status : str
        As the rule states them; empty for what is stated only.
    value, limit : float, optional
        In `unit`; None where there is none.
    unit : str
        In which an engineer reads it.
    bound : str
        ``at most``, ``at least`` or ``more than``; empty without a limit.
    place : str
        Where the value is closest to, or farthest beyond, the limit.
    verdict : str
        ``passes``, ``fails`` or ``not judged``.
    why : str
        Why nothing was judged, or what one must know to read the value.
    """

    name: str
    rule: str
    source: str
    status: str
    value: float | None
    unit: str
    bound: str
    limit: float | None
    place: str
    verdict: Verdict
    why: str


@dataclass(frozen=True)
class Found:
    """A value to be judged.

    Attributes
    ----------
    value : float
        In SI.
    place : str
        Where.
    unit, factor
        Unit to show it in, and how many of them make one SI unit.
    bound : str
        On which side of the limit it must be.
    why : str
        What one must know to read the value.
    resolution : float
        By how much a value may be beyond its limit and count as equal, in SI; for limits of zero.
    """

    value: float
    place: str
    unit: str
    factor: float = 1.0
    bound: Literal["at most", "at least", "more than"] = "at most"
    why: str = ""
    resolution: float = 1e-9


def judged(name: str, rule: Rule[Quantity], speed: float | None, found: Found | str) -> Check:
    """Judge a value by a rule.

    Parameters
    ----------
    name : str
        What is checked.
    rule : Rule
        The rule.
    speed : float, optional
        Of trains [m/s].
    found : Found or str
        The value, or why there is none.
    """
    if isinstance(found, str):
        return Check(name, rule.id, rule.source, rule.status, None, "", "", None, "", "not judged", found)
    return by_limit(name, rule, rule.at(speed), found)


def by_limit(name: str, rule: Rule[Quantity], limit: float | str, found: Found) -> Check:
    """Judge a value by a limit in SI, or say why there is none."""
    stated = isinstance(limit, str)
    verdict: Verdict = "not judged" if stated else "passes" if _kept(found, limit) else "fails"
    return Check(
        name=name,
        rule=rule.id,
        source=rule.source,
        status=rule.status,
        value=found.factor * found.value,
        unit=found.unit,
        bound="" if stated else found.bound,
        limit=None if stated else found.factor * limit,
        place=found.place,
        verdict=verdict,
        why="; ".join(text for text in (limit if stated else "", found.why) if text),
    )


def stated(
    name: str, value: float, unit: str, place: str = "", why: str = "no rule: for information"
) -> Check:
    """State a value without judging it."""
    return Check(name, "", "", "", value, unit, "", None, place, "not judged", why)


def first_largest(values: NDArray[np.float64]) -> int:
    """Return the first index of the largest value, where values that differ by round-off are equal.

    Examples
    --------
    >>> first_largest(np.array([0.2, 0.2 + 1e-15, 0.1]))
    0
    """
    return int(np.argmax(values >= values.max() - 1e-9))


def _kept(found: Found, limit: float) -> bool:
    if found.bound == "at most":
        return found.value <= limit + found.resolution
    if found.bound == "at least":
        return found.value >= limit - found.resolution
    return found.value > limit
