"""What an audit says: one row for each check, and in plain words what is wrong."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

GROUPS = ("equilibrium", "lengths", "targets")


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
        One of `GROUPS`.
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


@dataclass(frozen=True)
class Audit:
    """Outcome of an audit, one entry for each check with places where something can deviate.

    Attributes
    ----------
    group : tuple of str
        ``equilibrium``, ``lengths`` or ``targets``.
    name, unit : tuple of str
        What was compared, and the unit of its deviation.
    place : tuple of str
        Where the deviation is closest to, or farthest beyond, what is allowed.
    deviation, allowed : FloatArray
        The deviation at that place, and the largest one that passes there.
    findings : tuple of str
        What is wrong, in words, one for each check that fails.
    """

    group: tuple[str, ...]
    name: tuple[str, ...]
    unit: tuple[str, ...]
    place: tuple[str, ...]
    deviation: FloatArray
    allowed: FloatArray
    findings: tuple[str, ...]

    @property
    def passed(self) -> bool:
        """Whether nothing is wrong."""
        return not self.findings

    def lines(self) -> tuple[str, str, str]:
        """Return three lines for a console: equilibrium, lengths, targets."""
        first, second, third = (self._line(group) for group in GROUPS)
        return first, second, third

    def _line(self, group: str) -> str:
        rows = [i for i, name in enumerate(self.group) if name == group]
        if not rows:
            return f"Audit of {group}: nothing to check."
        failed = [i for i in rows if not self.deviation[i] <= self.allowed[i]]
        head = f"FAILED, {len(failed)} of {len(rows)} checks" if failed else f"passed, {len(rows)} checks"
        worst = rows[int(np.argmax(_ratio(self.deviation, self.allowed)[rows]))]
        told = dict.fromkeys((rows[0], worst) if group == GROUPS[0] else (worst,))
        return f"Audit of {group}: {head}; " + "; ".join(self._row(i) for i in told) + "."

    def _row(self, i: int) -> str:
        deviation, allowed = (_amount(float(v[i]), self.unit[i]) for v in (self.deviation, self.allowed))
        return f"{self.name[i]} {deviation} of {allowed} ({self.place[i]})"


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
    deviation = _amount(float(check.deviation[i]), check.unit)
    allowed = _amount(float(check.allowed[i]), check.unit)
    return f"{check.name}: off by {deviation} at {check.place[i]}{many}; {allowed} allowed"


def _worst(check: Check) -> int:
    return int(np.argmax(_ratio(check.deviation, check.allowed)))


def _ratio(deviation: FloatArray, allowed: FloatArray) -> FloatArray:
    """Return deviations in units of what is allowed; what is not a number exceeds everything."""
    ratio = np.where(deviation <= allowed, 0.0, np.inf)
    np.divide(deviation, allowed, out=ratio, where=(allowed > 0.0) & np.isfinite(deviation))
    return ratio


def _amount(value: float, unit: str) -> str:
    """Return a value with its unit, lengths in millimetres."""
    return f"{1e3 * value:.3g} mm" if unit == "m" else f"{value:.3g} {unit}"


def _finite(values: Sequence[float]) -> FloatArray:
    """Return an array that can be stored: what is not a number becomes the largest one."""
    return np.nan_to_num(np.array(values, dtype=np.float64), nan=np.finfo(np.float64).max)
