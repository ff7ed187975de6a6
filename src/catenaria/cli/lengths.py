"""Lengths with units as options of the command line."""

from __future__ import annotations

from catenaria.errors import InconsistentInputError


def positive_length(option: str, text: str) -> float:
    """Return the length that an option gives [m].

    Raises
    ------
    InconsistentInputError
        If it is none, or not above zero.

    Examples
    --------
    >>> positive_length("--step", "5mm")
    0.005
    """
    from catenaria.units import LENGTH, to_si  # imported late: --help shall be quick

    try:
        length = to_si(text, LENGTH)
    except ValueError as error:
        raise InconsistentInputError(f"{option}: found {text!r}; allowed: {error}") from None
    if not length > 0.0:
        raise InconsistentInputError(f"{option}: found {text!r}; allowed: a length above zero")
    return length
