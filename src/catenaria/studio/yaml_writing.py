"""Values as YAML, written like something that stands in a file already."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final, cast

from catenaria.line.reading import read_value
from catenaria.studio.tree_diff import same
from catenaria.studio.yaml_parts import Entry, Part

_WIDE: Final = 110  # columns
_STEP: Final = 2
_POINT_ZERO: Final = re.compile(r"[-+]?\d+\.0*")
_ESCAPED: Final = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t"}


@dataclass(frozen=True)
class Model:
    """Something that is written already: the part of the text, and its value."""

    part: Part
    value: object


@dataclass(frozen=True)
class Named:
    """What an anchor stands for in the text to be: its value, and the part in whose place that is written."""

    by: Part
    value: object


@dataclass(frozen=True)
class Writer:
    """Writes values.

    Attributes
    ----------
    text : str
        The file as it is, of which models are parts.
    named : mapping of Part to Named
        What the anchors of the parts that had them stand for.
    """

    text: str
    named: Mapping[Part, Named]

    @property
    def newline(self) -> str:
        """How lines end."""
        return "\r\n" if "\r\n" in self.text else "\n"

    def behind(
        self, value: object, like: Model | None, at: int, column: int, anchor: str = "", *, dash: bool = False
    ) -> str:
        """Return what follows a dash, or a colon, in a block.

        Parameters
        ----------
        value : object
            What is to be written.
        like : Model, optional
            How.
        at : int
            Where: only anchors before have aliases.
        column : int
            Of entries that begin lines of their own.
        anchor : str
            Its name for aliases.
        dash : bool
            Whether it is an item, whose first field may stand in the same line.
        """
        if not anchor and (alias := self.alias(value, like, at)):
            return f" {alias}"
        name = f" &{anchor}" if anchor else ""
        if not isinstance(value, dict | list):
            return f"{name} {self.scalar(value, like, flow=False)}"
        flow = f"{name} {self.flow(cast('object', value), like, at)}"
        if not value or (column + len(flow) <= _WIDE and not _is_block(cast("object", value), like)):
            return flow
        margin = self.newline + " " * column
        begin = " " if dash and not anchor else name + margin
        return begin + margin.join(self._lines(cast("object", value), like, at, column))

    def flow(self, value: object, like: Model | None, at: int) -> str:
        """Return a value in one line, as it may stand between brackets."""
        if alias := self.alias(value, like, at):
            return alias
        if isinstance(value, dict):
            fields = cast("dict[str, object]", value)
            merges, keys = self._parted(fields, like, at)
            models = models_of(like)
            written = (f"{_key(key)}: {self.flow(fields[key], models.get(key), at)}" for key in keys)
            return "{" + ", ".join([*merges, *written]) + "}"
        if isinstance(value, list):
            items = enumerate(cast("list[object]", value))
            return "[" + ", ".join(self.flow(item, _nth(like, i), at) for i, item in items) + "]"
        return self.scalar(value, like, flow=True)

    def field(self, key: str, value: object, like: Model | None, at: int, column: int) -> str:
        """Return a field of a mapping in a block."""
        return f"{_key(key)}:{self.behind(value, like, at, column + _STEP)}"

    def item(self, value: object, like: Model | None, at: int, column: int) -> str:
        """Return an item of a list in a block."""
        return f"-{self.behind(value, like, at, column + _STEP, dash=True)}"

    def alias(self, value: object, like: Model | None, at: int) -> str:
        """Return the alias by which a value is written, or nothing."""
        named = self.named.get(like.part.meant) if like else None
        if like is None or named is None or named.by.start >= at or not same(named.value, value):
            return ""
        return f"*{like.part.meant.anchor}"

    def provided(self, part: Part, at: int) -> dict[str, object] | None:
        """Return the fields that a mapping takes over from others, None if they cannot be had there."""
        fields: dict[str, object] = {}
        for entry in part.entries:
            if entry.merges:
                for source in reversed(_merged(entry)):
                    named = self.named.get(source.meant)
                    if source.target is None or named is None or named.by.start >= at:
                        return None
                    value = named.value
                    if not isinstance(value, dict):
                        return None
                    fields |= cast("dict[str, object]", value)
        return fields

    def scalar(self, value: object, like: Model | None, *, flow: bool) -> str:
        """Return a text or number in the manner of another one, and such that it is read as what it is."""
        written = ""
        if like and like.part.meant.kind == "scalar":
            written = self.text[like.part.meant.begin : like.part.meant.end]
        again = [written] if like and "\n" not in written and same(like.value, value) else []
        spellings = _texts(value, written) if isinstance(value, str) else [_number(value, written)]
        *possible, last = [*again, *spellings]
        return next((text for text in possible if _reads_as(text, value, flow=flow)), last)

    def _lines(self, value: object, like: Model | None, at: int, column: int) -> Iterator[str]:
        if isinstance(value, list):
            for i, item in enumerate(cast("list[object]", value)):
                yield self.item(item, _nth(like, i), at, column)
            return
        fields = cast("dict[str, object]", value)
        merges, keys = self._parted(fields, like, at)
        yield from merges
        models = models_of(like)
        for key in keys:
            yield self.field(key, fields[key], models.get(key), at, column)

    def _parted(self, fields: dict[str, object], like: Model | None, at: int) -> tuple[list[str], list[str]]:
        """Return how a mapping takes over fields, and the names of those that it has to state itself."""
        part = like.part.meant if like else None
        provided = self.provided(part, at) if part else None
        if part is None or not provided or not provided.keys() <= fields.keys():
            return [], [*fields]
        merges = [f"<<: {self.text[e.value.start : e.value.end]}" for e in part.entries if e.merges]
        return merges, [key for key in fields if key not in provided or not same(fields[key], provided[key])]


def models_of(like: Model | None) -> dict[str, Model]:
    """Return how the fields of a mapping are written, also those that it takes over."""
    value = like.value if like else None
    if like is None or not isinstance(value, dict):
        return {}
    fields = cast("dict[str, object]", value)
    return {e.key: Model(e.value, fields[e.key]) for e in _entries(like.part.meant) if e.key in fields}


def _entries(part: Part) -> Iterator[Entry]:
    for entry in part.entries:
        if entry.merges:
            for source in reversed(_merged(entry)):
                yield from _entries(source.meant)
    yield from (entry for entry in part.entries if not entry.merges)


def _merged(entry: Entry) -> list[Part]:
    """Return what a mapping takes over; of several the first one counts."""
    return [item.value for item in entry.value.entries] or [entry.value]


def _nth(like: Model | None, index: int) -> Model | None:
    """Return how an item of a list is written, one behind its end like the last."""
    value = like.value if like else None
    if like is None or not isinstance(value, list) or not value:
        return None
    items = cast("list[object]", value)
    index = min(index, len(items) - 1)
    return Model(like.part.meant.entries[index].value, items[index])


def _is_block(value: object, like: Model | None) -> bool:
    part = like.part.meant if like else None
    kind = "list" if isinstance(value, list) else "mapping"
    return part is not None and part.kind == kind and not part.flow


def _reads_as(text: str, value: object, *, flow: bool) -> bool:
    whole = f"[{text}, 0]" if flow else f"a: {text}"
    return same(read_value(whole, None), [value, 0] if flow else {"a": value})


def _key(key: str) -> str:
    plain = key.strip() and same(read_value(f"{{{key}: 0}}", None), {key: 0})
    return key if plain else _quoted(key)


def _texts(value: str, like: str) -> list[str]:
    single = "'" + value.replace("'", "''") + "'"
    if like.startswith('"'):
        return [_quoted(value)]
    return [single, _quoted(value)] if like.startswith("'") else [value, single, _quoted(value)]


def _quoted(value: str) -> str:
    shown = (_ESCAPED.get(c) or (c if c.isprintable() else f"\\U{ord(c):08x}") for c in value)
    return '"' + "".join(shown) + '"'


def _number(value: object, like: str) -> str:
    match value:
        case None:
            return "null"
        case bool():
            return str(value).lower()
        case float() if not math.isfinite(value):
            return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"
        case float() if value.is_integer() and abs(value) < 1e15 and not _POINT_ZERO.fullmatch(like):
            return str(int(value))
        case _:
            return str(value)
