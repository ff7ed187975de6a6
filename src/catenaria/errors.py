"""Every failure that catenaria raises on purpose, by name.

All of them derive from `CatenariaError`; each message says what is wrong, where, and what to try.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

_MOST_NAMES = 8


def some(names: Sequence[str]) -> str:
    """Return names for a message, not too many of them.

    Examples
    --------
    >>> some(["a", "b"]), some([str(i) for i in range(10)])
    ('a; b', '0; 1; 2; 3; 4; 5; 6; 7; and 2 more')
    """
    more = len(names) - _MOST_NAMES
    return "; ".join(names[:_MOST_NAMES]) + (f"; and {more} more" if more > 0 else "")


class CatenariaError(Exception):
    """Base of all errors that catenaria raises on purpose."""


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong with an input file.

    Parameters
    ----------
    file : str
        Name of the file as the user gave it.
    line, column : int
        Where the offending value stands, counted from 1 (0 when the place is unknown).
    field : str
        Path of the field, for example ``spans[1].droppers.positions[3]``.
    found : str
        What stands there.
    allowed : str
        What may stand there.
    """

    file: str
    line: int
    column: int
    field: str
    found: str
    allowed: str

    def __str__(self) -> str:
        where = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return f"{where}: {self.field}: found {self.found}; allowed: {self.allowed}"


class LineFileError(CatenariaError):
    """An input file cannot be used; `faults` holds one entry for each thing that is wrong."""

    def __init__(self, faults: tuple[Fault, ...]) -> None:
        self.faults = faults
        super().__init__("\n".join(str(fault) for fault in faults))


class UnsupportedError(CatenariaError):
    """The line asks for something that the chosen method does not do; the message names both."""


class InconsistentInputError(CatenariaError):
    """Arguments contradict each other or the physics (a wrong count, a shape, a negative length)."""


class SingularError(InconsistentInputError):
    """What is prescribed leaves a motion free, so that no equilibrium is determined.

    Parameters
    ----------
    reason : str
        What can move, and what does not hold it.
    advice : str
        What to try.
    partial : object, optional
        The free motion.
    """

    def __init__(self, reason: str, advice: str, partial: object | None = None) -> None:
        self.reason = reason
        self.advice = advice
        self.partial = partial
        super().__init__(f"{reason}. Try: {advice}")


class InfeasibleError(CatenariaError):
    """No equilibrium meets the demands, for example because a dropper would be in compression.

    Parameters
    ----------
    message : str
        Which demand cannot be met, and what would help.
    partial : object, optional
        What had been computed until then.
    """

    def __init__(self, message: str, partial: object | None = None) -> None:
        self.partial = partial
        super().__init__(message)


class NotConvergedError(CatenariaError):
    """A computation ended before it reached its goal.

    Parameters
    ----------
    reason : str
        What stopped it.
    advice : str
        What to try.
    partial : object, optional
        What had been computed until then.
    """

    def __init__(self, reason: str, advice: str, partial: object | None = None) -> None:
        self.reason = reason
        self.advice = advice
        self.partial = partial
        super().__init__(f"{reason}. Try: {advice}")
