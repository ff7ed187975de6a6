"""Errors of installation in a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator

from catenaria.line.installation import Installation, Spread, TensionSpread


def installation_rows(errors: Installation | None) -> list[tuple[str, str]]:
    """Say how errors scatter, and how many are known.

    Examples
    --------
    >>> installation_rows(Installation(dropper_length=Spread(distribution="normal", scale=1e-3, clip=2)))
    [('dropper length', 'normal, 1 mm, within 2 deviations')]
    """
    return [] if errors is None else list(_rows(errors))


def _rows(errors: Installation) -> Iterator[tuple[str, str]]:
    for field in Installation.model_fields:
        value: object = getattr(errors, field)
        if isinstance(value, Spread | TensionSpread):
            yield field.replace("_", " "), _spread(value)
    known = errors.known
    count = len(known.droppers) + len(known.supports) + len(known.wires)
    if count:
        yield "known errors", str(count)


def _spread(spread: Spread | TensionSpread) -> str:
    size = f"{1e3 * spread.scale:g} mm" if isinstance(spread, Spread) else _force(spread)
    mean = f", mean {1e3 * spread.mean:g} mm" if isinstance(spread, Spread) and spread.mean else ""
    clip = "" if spread.clip is None else f", within {spread.clip:g} deviations"
    return f"{spread.distribution}, {size}{clip}{mean}"


def _force(spread: TensionSpread) -> str:
    return f"{spread.scale:g} N" if spread.scale is not None else f"{100.0 * (spread.fraction or 0.0):g} %"
