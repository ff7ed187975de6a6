"""What an audit says: one row for each check, and in plain words what is wrong."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from catenaria.results.audit import Audit, amount, ratio

FloatArray = NDArray[np.float64]


class Names(Protocol):
    """Names by number: a tuple of them, or what makes up each one when it is asked for."""

    def __getitem__(self, i: int, /) -> str:
        """Return one name."""
        ...


@dataclass(frozen=True)
class Check:
    """One kind of deviation at all places where it can occur.

    Attributes
    ----------
    group : str
        One of `catenaria.results.audit.GROUPS`.
    name : str
        What is compared.
    unit : str
        Unit of the deviations.
    deviation, allowed : FloatArray, shape (n,)
        Sizes of the deviations, and the largest ones that pass.
    place : Names
        The n places.
    """

    group: str
    name: str
    unit: str
    deviation: FloatArray
    allowed: FloatArray
    place: Names


def conclude(checks: Sequence[Check]) -> Audit:
    """Return the audit that a number of checks amounts to; checks without any place are left out.

    Examples
    --------
    >>> limit = np.full(2, 1e-3)
    >>> audit = conclude([Check("lengths", "length of droppers", "m", limit * [0.0, 2.0], limit, ("a", "b"))])
    >>> audit.passed, audit.findings
    (False, ('length of droppers: off by 2 mm at b; 1 mm allowed',))
    """
    held = [check for check in checks if check.deviation.size]
    worst = [_worst(check) for check in held]
    deviation = [check.deviation[i] for check, i in zip(held, worst, strict=True)]
    allowed = [check.allowed[i] for check, i in zip(held, worst, strict=True)]
    return Audit(
        group=tuple(check.group for check in held),
        name=tuple(check.name for check in held),
        unit=tuple(check.unit for check in held),
        place=tuple(check.place[i] for check, i in zip(held, worst, strict=True)),
        deviation=_finite(deviation),
        allowed=_finite(allowed),
        findings=tuple(text for check in held if (text := _finding(check))),
    )


def _finding(check: Check) -> str:
    """Return what is wrong, or nothing. A deviation that is not a number is wrong."""
    failed = np.count_nonzero(~(check.deviation <= check.allowed))
    if not failed:
        return ""
    i = _worst(check)
    many = f", the worst of {failed} places" if failed > 1 else ""
    deviation = amount(float(check.deviation[i]), check.unit)
    allowed = amount(float(check.allowed[i]), check.unit)
    return f"{check.name}: off by {deviation} at {check.place[i]}{many}; {allowed} allowed"


def _worst(check: Check) -> int:
    return int(np.argmax(ratio(check.deviation, check.allowed)))


def _finite(values: Sequence[float]) -> FloatArray:
    """Return an array that can be stored: what is not a number becomes the largest one."""
    return np.nan_to_num(np.array(values, dtype=np.float64), nan=np.finfo(np.float64).max)
