"""What becomes of every part of a YAML file when its tree is replaced by another one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

from catenaria.studio.tree_diff import Pair, aligned, same
from catenaria.studio.yaml_parts import Entry, Part
from catenaria.studio.yaml_writing import Named

Tree = Mapping[str, object]


@dataclass(frozen=True)
class Wanted:
    """What a part of the text says, and what shall stand there; items of lists are paired."""

    old: object
    new: object
    pairs: Sequence[Pair] = ()


def valued_parts(part: Part, value: object) -> Iterator[tuple[Part, object]]:
    """Yield every part, in the order of the text, with its value."""
    yield part, value
    for entry, item in _valued(part, value):
        yield from valued_parts(entry.value, item)


def _valued(part: Part, value: object) -> list[tuple[Entry, object]]:
    if part.kind in ("scalar", "alias"):
        return []
    if part.kind == "list":
        return list(zip(part.entries, cast("list[object]", value), strict=True))
    fields = cast("Tree", value)
    return [(entry, fields[entry.key]) for entry in part.entries if not entry.merges and entry.key in fields]


def wanted_parts(part: Part, old: object, new: object) -> Iterator[tuple[Part, Wanted]]:
    """Yield what shall stand in place of every part that stays, if only because something in it does."""
    wanted = Wanted(old, new)
    if part.kind == "list" and isinstance(new, list):
        before, after = cast("list[object]", old), cast("list[object]", new)
        wanted = replace(wanted, pairs=aligned(before, after))
        for i, j in wanted.pairs:
            if i is not None and j is not None:
                yield from wanted_parts(part.entries[i].value, before[i], after[j])
    elif part.kind == "mapping" and isinstance(new, dict):
        fields = cast("Tree", new)
        for entry, value in _valued(part, old):
            if entry.key in fields:
                yield from wanted_parts(entry.value, value, fields[entry.key])
    yield part, wanted


def names(values: Mapping[Part, object], wanted: Mapping[Part, Wanted]) -> dict[Part, Named]:
    """Return what every anchor stands for in the end.

    If what it names is edited or taken away while aliases still want what it was, it moves to the first of
    them; if none does, aliases follow the edit, as far as they want the same.
    """
    heirs: dict[Part, Part] = {}
    for alias, value in values.items():
        if alias.target is not None and alias in wanted and same(wanted[alias].new, value):
            heirs.setdefault(alias.target, alias)
    found: dict[Part, Named] = {}
    for part, value in values.items():
        if part.anchor:
            here, heir = wanted.get(part), heirs.get(part)
            if here and (heir is None or same(here.new, value)):
                found[part] = Named(part, here.new)
            elif heir:
                found[part] = Named(heir, value)
    return found
