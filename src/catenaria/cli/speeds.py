"""Speeds with units as options of the command line."""

from __future__ import annotations

from catenaria.errors import InconsistentInputError


def train_speed(option: str, text: str | None) -> float | None:
    """Return the speed that an option gives [m/s], None if it is not given.

    Raises
    ------
    InconsistentInputError
        If it is no speed of trains.

    Examples
    --------
    >>> train_speed("--speed", "180km/h")
    50.0
    """
    if text is None:
        return None
    from catenaria.line.load_units import TRAIN_SPEED  # imported late: --help shall be quick
    from catenaria.units import to_si

    try:
        speed = to_si(text, TRAIN_SPEED)
    except ValueError as error:
        raise InconsistentInputError(f"{option}: found {text!r}; allowed: {error}") from None
    if not 0.0 < speed <= 150.0:
        raise InconsistentInputError(f"{option}: found {text!r}; allowed: above 0 and at most 540 km/h")
    return speed
