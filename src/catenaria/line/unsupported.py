"""Refusal by name of what can be described but a method, or every method, cannot solve."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from catenaria.errors import UnsupportedError
from catenaria.line.base import Path
from catenaria.line.line import Line
from catenaria.line.plane import beyond_plane
from catenaria.line.source import format_path


def refuse_unsupported(line: Line) -> None:
    """Refuse a line that asks for something that no method can do.

    Parameters
    ----------
    line : Line
        The line.

    Raises
    ------
    UnsupportedError
        With one line of text for each such thing: file, line, column, field and what is solved instead.
    """
    _refuse(line, _unsolved(line), lambda what: f"{what} is not solved")


def refuse_for_method(line: Line, method: str, spatial: bool) -> None:
    """Refuse a line that asks for something that a method cannot do.

    Parameters
    ----------
    line : Line
        The line.
    method : str
        Its name.
    spatial : bool
        Whether it solves lines in space, and not only plane ones of two wires.

    Raises
    ------
    UnsupportedError
        With one line of text for each such thing: file, line, column, field and which methods can do it.
    """
    refuse_unsupported(line)
    if not spatial:
        others = f"is not solved by the method {method!r}: only direct and dynamic solve it"
        _refuse(line, beyond_plane(line), lambda what: f"{what} {others}")


def _unsolved(line: Line) -> Iterator[tuple[Path, str]]:
    if line.dropper.joint == "frictionless" and not line.plane:
        yield ("dropper", "joint"), "a frictionless dropper (guided ones are) in a line beyond the plane"


def _refuse(line: Line, found: Iterable[tuple[Path, str]], complaint: Callable[[str], str]) -> None:
    """Complain about each kind of thing once, at its first place in the file."""
    places: dict[str, list[Path]] = {}
    for path, what in sorted(found, key=lambda item: line.source.mark(item[0])):
        places.setdefault(what, []).append(path)
    if places:
        complaints = [f"{_where(line, paths)}: {complaint(what)}" for what, paths in places.items()]
        raise UnsupportedError("\n".join(complaints))


def _where(line: Line, paths: list[Path]) -> str:
    """Say where the first one stands, and how many more there are."""
    row, column = line.source.mark(paths[0])
    where = f"{line.source.file}:{row}:{column}: " if row else ""
    more = f" (and {len(paths) - 1} more)" if len(paths) > 1 else ""
    return f"{where}{format_path(paths[0])}{more}"
