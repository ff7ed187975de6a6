"""Where in a file the parts of a line stand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from catenaria.line.base import Path

Mark = tuple[int, int]

UNKNOWN_MARK: Final[Mark] = (0, 0)


def format_path(path: Path) -> str:
    """Write a path as it is read: ``spans[1].droppers.positions[3]``.

    Examples
    --------
    >>> format_path(("spans", 1, "droppers", "positions", 3))
    'spans[1].droppers.positions[3]'
    """
    text = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in path)
    return text.removeprefix(".") or "the file"


@dataclass(frozen=True)
class Source:
    """File, line and column of every value of a line.

    Two lines from different files are equal when they describe the same thing: nothing here is compared.

    Parameters
    ----------
    file : str
        Name of the file as the user gave it; empty for a line that was built in Python.
    values, keys : mapping of path to (line, column)
        Where each value and the key before it begin, counted from 1.
    """

    file: str = field(default="", compare=False)
    values: Mapping[Path, Mark] = field(default_factory=dict[Path, Mark], compare=False)
    keys: Mapping[Path, Mark] = field(default_factory=dict[Path, Mark], compare=False)

    def mark(self, path: Path) -> Mark:
        """Line and column of a value, or of what lacks it; (0, 0) if nothing is known."""
        while path and path not in self.values:
            path = path[:-1]
        return self.values.get(path, UNKNOWN_MARK)
