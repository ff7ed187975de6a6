"""Tables as a page shows them: headers with units, formatted cells."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Column:
    """One column.

    Attributes
    ----------
    name, unit : str
        The header.
    cells : tuple of str
        The rows.
    numeric : bool
        Whether it is set flush right.
    """

    name: str
    unit: str
    cells: tuple[str, ...]
    numeric: bool


@dataclass(frozen=True)
class Table:
    """A table, foldable if it has a title of its own."""

    title: str
    columns: tuple[Column, ...]
    open: bool = True

    @property
    def rows(self) -> list[tuple[str, ...]]:
        """Cells, row by row."""
        return list(zip(*(column.cells for column in self.columns), strict=True))


def column(name: str, unit: str, values: Iterable[Any], form: str = "", *, flush: bool = False) -> Column:
    """Return a column of texts or of formatted numbers; what is not a number stays empty.

    Texts that are numbers with units are set `flush` right as numbers are.

    Examples
    --------
    >>> column("force", "N", [60.04, float("nan"), -0.001], ".1f").cells
    ('60.0', '', '0.0')
    """
    items: list[Any] = np.asarray(list(values)).tolist()
    numeric = bool(items) and all(
        isinstance(item, int | float) and not isinstance(item, bool) for item in items
    )
    return Column(name, unit, tuple(_cell(item, form) for item in items), numeric or flush)


def _cell(item: Any, form: str) -> str:
    if isinstance(item, bool):
        return "yes" if item else "no"
    if not isinstance(item, float):
        return str(item)
    if item != item:
        return ""
    text = format(item, form or ".6g")
    return text.removeprefix("-") if not text.strip("-0.") else text
