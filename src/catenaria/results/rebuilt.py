"""The outcome of a rebuild as a value: where the found lengths come to rest, and how far off the form."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Comeback:
    """One kind of quantity of a rebuilt line beside what the method had returned, all in m or all in N.

    Attributes
    ----------
    value : FloatArray
        In the rebuilt line.
    change : FloatArray
        The same minus what the method had returned.
    allowed : FloatArray
        Largest size of the change that passes.
    """

    value: FloatArray
    change: FloatArray
    allowed: FloatArray

    @property
    def passed(self) -> NDArray[np.bool_]:
        """Which entries came back; one that is not a number did not."""
        return np.abs(self.change) <= self.allowed


@dataclass(frozen=True)
class Rebuilt:
    """Where a line that was built from a result came to rest.

    Attributes
    ----------
    way : str
        How it was brought to rest: ``static``, ``static, from the found state`` or ``relaxation``; empty if
        the line was not rebuilt.
    iterations : int
        Of Newton's method, or steps of the relaxation.
    height, messenger_height : Comeback
        Heights of the two wires at the droppers [m], shape (n,).
    force : Comeback
        Vertical forces of the droppers on the contact wire [N], shape (n,).
    tension : Comeback
        Reactions at the ends of contact wire and messenger wire [N], shape (2,).
    height_error : FloatArray, shape (n,)
        Height of the rebuilt contact wire at the droppers minus the wanted one [m].
    tension_error : FloatArray, shape (2,)
        Tension of the rebuilt wires, measured as the line file wants it, minus the wanted one [N].
    """

    way: str
    iterations: int
    height: Comeback
    messenger_height: Comeback
    force: Comeback
    tension: Comeback
    height_error: FloatArray
    tension_error: FloatArray

    @property
    def passed(self) -> bool:
        """Whether everything came back."""
        return not self.findings()

    def findings(self) -> tuple[str, ...]:
        """Return what did not come back, in words, one sentence for each kind of quantity."""
        return tuple(finding for part in self._parts() if (finding := _finding(*part)))

    def lines(self) -> tuple[str, ...]:
        """Return lines for a console: how far it came back, and apart from that what was wanted."""
        if not self.way:
            return ("Not rebuilt: nothing says that the found lengths, when built, give this form.",)
        rows = "; ".join(_row(name, unit, comeback) for name, unit, comeback, _ in self._parts())
        verdict = "comes back" if self.passed else "DOES NOT COME BACK"
        height, tension = (float(np.abs(error).max()) for error in (self.height_error, self.tension_error))
        return (
            f"Rebuilt from the found lengths ({self.way}, {self.iterations} steps), it {verdict}: {rows}.",
            f"The rebuilt line misses what was wanted by {_amount(height, 'm')} of height and "
            f"{_amount(tension, 'N')} of tension.",
        )

    def _parts(self) -> Iterator[tuple[str, str, Comeback, tuple[str, ...]]]:
        """Yield name, unit, comeback and places of each kind of quantity."""
        droppers = tuple(f"dropper {i + 1}" for i in range(self.height.value.size))
        yield "height", "m", self.height, droppers
        yield "messenger height", "m", self.messenger_height, droppers
        yield "dropper force", "N", self.force, droppers
        yield "tension", "N", self.tension, ("contact wire", "messenger wire")


def _worst(comeback: Comeback) -> int:
    """Return the entry that is closest to, or farthest beyond, what is allowed."""
    excess = np.abs(comeback.change) / comeback.allowed
    return int(np.argmax(np.where(np.isnan(excess), np.inf, excess)))


def _row(name: str, unit: str, comeback: Comeback) -> str:
    i = _worst(comeback)
    change, allowed = _amount(abs(float(comeback.change[i])), unit), _amount(float(comeback.allowed[i]), unit)
    return f"{name} {change} of {allowed}"


def _finding(name: str, unit: str, comeback: Comeback, places: tuple[str, ...]) -> str:
    """Say what did not come back; nothing if all did."""
    count = int(np.count_nonzero(~comeback.passed))
    if not count:
        return ""
    i = _worst(comeback)
    change, allowed = _amount(float(comeback.change[i]), unit), _amount(float(comeback.allowed[i]), unit)
    return f"rebuilt line: {name} off by {change} at {places[i]}, allowed {allowed}; {count} such places"


def _amount(value: float, unit: str) -> str:
    """Return a value with its unit, with digits that do not depend on round-off."""
    return f"{1e3 * value:.4f} mm" if unit == "m" else f"{value:.3f} N"


_NOTHING = Comeback(np.empty(0), np.empty(0), np.empty(0))

NOT_REBUILT = Rebuilt("", 0, _NOTHING, _NOTHING, _NOTHING, _NOTHING, np.empty(0), np.empty(0))
