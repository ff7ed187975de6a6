"""Refusal by name of what can be described but is not solved yet."""

from __future__ import annotations

from collections.abc import Iterator

from catenaria.errors import UnsupportedError
from catenaria.line.base import Path
from catenaria.line.line import Line
from catenaria.line.source import UNKNOWN_MARK, format_path
from catenaria.line.support import Support

_SAME_HEIGHT = 1e-9  # m: rounding of a height and an encumbrance that are added


def refuse_unsupported(line: Line) -> None:
    """Refuse a line that asks for something that no method solves yet.

    Parameters
    ----------
    line : Line
        The line.

    Raises
    ------
    UnsupportedError
        With one line of text for each such thing: file, line, column, field and what is solved instead.
    """
    complaints: dict[object, str] = {}
    for path, what in sorted(_unsupported(line), key=lambda item: line.source.mark(item[0])):
        mark = line.source.mark(path)
        # What a YAML alias repeats stands at one place and is one complaint.
        place = (mark, path[-1]) if mark != UNKNOWN_MARK else path
        complaints.setdefault((place, what), _complaint(line, path, what))
    if complaints:
        raise UnsupportedError("\n".join(complaints.values()))


def _complaint(line: Line, path: Path, what: str) -> str:
    source = line.source
    row, column = source.mark(path)
    where = f"{source.file}:{row}:{column}: " if row else ""
    return f"{where}{format_path(path)}: {what} is not solved yet"


def _unsupported(line: Line) -> Iterator[tuple[Path, str]]:
    yield from _wires(line)
    for i, support in enumerate(line.supports):
        for field, what in _support(support):
            yield ("supports", i, *field), what
    yield from _heights(line)
    for i, span in enumerate(line.spans):
        if span.pre_sag != 0.0:
            yield ("spans", i, "pre_sag"), "a pre-sag other than 0 (a list of heights is)"
    if line.track.curves:
        yield ("track", "curves"), "a curved track"
    if line.track.gradients:
        yield ("track", "gradients"), "a track with gradients"


def _wires(line: Line) -> Iterator[tuple[Path, str]]:
    for field, wire in (("contact_wire", line.contact_wire), ("messenger_wire", line.messenger_wire)):
        if wire.tension.pulled != "both":
            yield (field, "tension", "pulled"), f"a wire that is pulled at its {wire.tension.pulled} only"
    for i, wire in enumerate(line.other_wires):
        yield ("other_wires", i), f"a {wire.kind} wire besides contact and messenger wire"


def _heights(line: Line) -> Iterator[tuple[Path, str]]:
    """Yield supports that do not hold a wire as high as its first one: wires are laid out level."""
    contact, first = line.contact_support_indices[0], line.supports[0]
    level = line.supports[contact].contact_wire
    for i, support in enumerate(line.supports):
        held = support.contact_wire
        if held and level and abs(held.height - level.height) > _SAME_HEIGHT:
            yield ("supports", i, "contact_wire", "height"), "a contact wire held at different heights"
        if abs(support.messenger_height - first.messenger_height) > _SAME_HEIGHT:
            yield ("supports", i, "messenger_wire"), "a messenger wire held at different heights"


def _support(support: Support) -> Iterator[tuple[Path, str]]:
    if support.contact_wire is not None and support.contact_wire.kind != "sliding":
        yield ("contact_wire", "kind"), f"a {support.contact_wire.kind}"
    if support.messenger_wire.kind != "sliding":
        yield ("messenger_wire", "kind"), f"a {support.messenger_wire.kind} messenger support"
    if support.stagger != 0.0:
        yield ("stagger",), "a stagger other than 0"
