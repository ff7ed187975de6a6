"""Whether known errors of installation are those of something that the line has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from catenaria.line.base import Path, Problem, closest
from catenaria.line.installation import DropperError, Installation, KnownErrors

if TYPE_CHECKING:
    from catenaria.line.line import Line


def installation_problems(installation: Installation, line: Line) -> Iterator[Problem]:
    """Find known errors of droppers, supports and wires that the line does not have."""
    known = installation.known
    for i, dropper in enumerate(known.droppers):
        yield from _unknown_dropper(("known", "droppers", i), dropper, line)
    names = [support.name for support in line.supports]
    for i, error in enumerate(known.supports):
        path = ("known", "supports", i)
        if error.support not in names:
            meant = closest(error.support, names)
            yield Problem((*path, "support"), error.support, f"one of {', '.join(names)}{meant}")
        elif error.wire not in _held(line, names.index(error.support)):
            yield Problem((*path, "wire"), error.wire, f"a wire that {error.support} holds")
    for i, error in enumerate(known.wires):
        if error.wire not in _wires(line):
            allowed = f"one of the wires: {', '.join(_wires(line))}"
            yield Problem(("known", "wires", i, "wire"), error.wire, allowed)
        elif not _has_device(line, error.wire):
            allowed = "a wire with a tensioning device; a fixed termination keeps no tension"
            yield Problem(("known", "wires", i, "wire"), error.wire, allowed)
    yield from _twice(known)


def _unknown_dropper(path: Path, error: DropperError, line: Line) -> Iterator[Problem]:
    if error.span > len(line.spans):
        yield Problem((*path, "span"), error.span, f"a span from 1 to {len(line.spans)}")
        return
    span = line.spans[error.span - 1]
    if error.carries == "auxiliary messenger":
        count = 0 if span.auxiliary is None else len(span.auxiliary.droppers.x)
    else:
        second = line.second_contact_wire
        count = len(span.droppers.x) * (2 if second is not None and second.droppers == "both" else 1)
    if error.dropper > count:
        allowed = f"a dropper from 1 to {count}" if count else "nothing: this span has no such dropper"
        yield Problem((*path, "dropper"), error.dropper, allowed)


def _held(line: Line, support: int) -> Iterator[str]:
    """Yield the wires that a support holds."""
    contact = line.supports[support].contact_wire is not None
    yield from (name for name in _wires(line) if contact or not name.endswith("contact wire"))


def _wires(line: Line) -> tuple[str, ...]:
    there = {
        "contact wire": True,
        "second contact wire": line.second_contact_wire is not None,
        "auxiliary messenger": line.auxiliary_messenger is not None,
        "messenger wire": True,
    }
    return tuple(name for name, is_there in there.items() if is_there)


def _has_device(line: Line, name: str) -> bool:
    wire = {"auxiliary messenger": line.auxiliary_messenger, "messenger wire": line.messenger_wire}.get(
        name, line.contact_wire
    )
    return wire is not None and wire.tension.device.kind != "fixed"


def _twice(known: KnownErrors) -> Iterator[Problem]:
    """Find what is listed twice: which of the two errors holds would be a guess."""
    keys: dict[str, Iterable[tuple[object, ...]]] = {
        "droppers": [(d.carries, d.span, d.dropper) for d in known.droppers],
        "supports": [(s.support, s.wire) for s in known.supports],
        "wires": [(w.wire,) for w in known.wires],
    }
    for name, listed in keys.items():
        seen: set[object] = set()
        for i, key in enumerate(listed):
            if key in seen:
                found = " ".join(str(part) for part in key)
                yield Problem(("known", name, i), found, "each of them once")
            seen.add(key)
