"""The outcome of an audit as a value: what was checked, how far off it was, and what is wrong."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

GROUPS = ("equilibrium", "lengths", "targets")


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
        worst = rows[int(np.argmax(ratio(self.deviation, self.allowed)[rows]))]
        told = dict.fromkeys((rows[0], worst) if group == GROUPS[0] else (worst,))
        return f"Audit of {group}: {head}; " + "; ".join(self._row(i) for i in told) + "."

    def _row(self, i: int) -> str:
        deviation, allowed = (amount(float(v[i]), self.unit[i]) for v in (self.deviation, self.allowed))
        return f"{self.name[i]} {deviation} of {allowed} ({self.place[i]})"


def ratio(deviation: FloatArray, allowed: FloatArray) -> FloatArray:
    """Return deviations in units of what is allowed; what is not a number exceeds everything."""
    parts = np.where(deviation <= allowed, 0.0, np.inf)
    np.divide(deviation, allowed, out=parts, where=(allowed > 0.0) & np.isfinite(deviation))
    return parts


def amount(value: float, unit: str) -> str:
    """Return a value with its unit, lengths in millimetres."""
    return f"{1e3 * value:.3g} mm" if unit == "m" else f"{value:.3g} {unit}"


NOT_AUDITED = Audit((), (), (), (), np.empty(0), np.empty(0), ())
