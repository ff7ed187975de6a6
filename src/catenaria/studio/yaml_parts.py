"""What the text of a YAML file is made of, with the place of each part: aliases are not followed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any, Final, Literal

from ruamel.yaml import YAML

MERGE: Final = "<<"
_ANCHOR: Final = re.compile(r"&\S+\s*")
_BLANKS: Final = re.compile(r"(?:\s|#.*)*")  # and comments


@dataclass(frozen=True, eq=False)
class Part:
    """A value as it is written.

    Attributes
    ----------
    kind : str
        What it is; an ``alias`` is one itself, whatever it stands for.
    start, begin, end : int
        Where it starts, where it starts behind its anchor, and where it ends.
    flow : bool
        Whether brackets surround its entries.
    anchor : str
        Its name for aliases, or none.
    target : Part, optional
        What an alias stands for.
    entries : tuple of Entry
        What a mapping or a list consists of.
    """

    kind: Literal["scalar", "alias", "mapping", "list"]
    start: int
    begin: int
    end: int
    flow: bool = False
    anchor: str = ""
    target: Part | None = None
    entries: tuple[Entry, ...] = ()

    @property
    def meant(self) -> Part:
        """What an alias stands for, or the part itself."""
        return self if self.target is None else self.target


@dataclass(frozen=True, eq=False)
class Entry:
    """A field of a mapping or an item of a list.

    Attributes
    ----------
    key : str
        Name of the field; `MERGE` without quotes takes over the fields of others; empty in a list.
    start, gap : int
        Where the name or the dash starts, and where that and its colon end.
    value : Part
        What stands there.
    """

    key: str
    start: int
    gap: int
    value: Part
    merges: bool = False


def parts(text: str) -> Part:
    """Return the parts of a text that can be read as one YAML document."""
    yaml: Any = YAML(typ="safe", pure=True)
    return _Composer(text, (event for event in yaml.parse(text) if not _is_frame(event))).part()


@dataclass
class _Composer:
    """Puts ruamel.yaml's events together."""

    text: str
    events: Iterator[Any]
    anchors: dict[str, Part] = field(default_factory=dict[str, Part])

    def part(self, event: Any = None) -> Part:
        """Return the next part, or the one that an event begins."""
        event = event or next(self.events)
        name = type(event).__name__
        if name == "AliasEvent":
            start, end = event.start_mark.index, event.end_mark.index
            return Part("alias", start, start, end, target=self.anchors[event.anchor])
        compose = {"ScalarEvent": self._scalar, "SequenceStartEvent": self._list}.get(name, self._mapping)
        part = compose(event)
        if part.anchor:
            self.anchors[part.anchor] = part
        return part

    def _scalar(self, event: Any) -> Part:
        start = event.start_mark.index
        written = self.text[start : event.end_mark.index]
        if event.style in ("|", ">"):
            written = written.rstrip()  # the mark is in the next line
        anchor = _ANCHOR.match(written)
        begin = start + (anchor.end() if anchor else 0)
        return Part("scalar", start, begin, start + len(written), anchor=event.anchor or "")

    def _list(self, event: Any) -> Part:
        flow, begin = bool(event.flow_style), event.end_mark.index
        if flow or not self.text.startswith("-", begin):
            begin -= 1  # the mark is behind the bracket, or behind the first dash of a list without indent
        entries: list[Entry] = []
        end = begin
        while not _is_end(item := next(self.events)):
            start = item.start_mark.index if flow else self._past_blanks(end)
            gap = start if flow else start + 1
            value = _placed(self.part(item), gap)
            entries.append(Entry("", start, gap, value))
            end = value.end
        end = item.end_mark.index if flow else end
        return Part(
            "list", event.start_mark.index, begin, end, flow, event.anchor or "", None, tuple(entries)
        )

    def _mapping(self, event: Any) -> Part:
        flow, begin = bool(event.flow_style), event.end_mark.index
        begin -= flow
        entries: list[Entry] = []
        end = begin
        while not _is_end(key := next(self.events)):
            named = self.part(key)
            name = getattr(key, "value", self.text[named.meant.begin : named.meant.end])
            gap = self.text.find(":", named.end) + 1
            value = _placed(self.part(), gap)
            merges = name == MERGE and key.implicit[0]
            entries.append(Entry(name, named.start, gap, value, merges))
            end = value.end
        end = key.end_mark.index if flow else end
        return Part(
            "mapping", event.start_mark.index, begin, end, flow, event.anchor or "", None, tuple(entries)
        )

    def _past_blanks(self, at: int) -> int:
        found = _BLANKS.match(self.text, at)
        return found.end() if found else at


def _placed(part: Part, gap: int) -> Part:
    """Return a part; one without text stands where nothing is written, not where something else follows."""
    empty = part.start == part.end
    return replace(part, start=gap, begin=gap, end=gap) if empty else part


def _is_frame(event: Any) -> bool:
    return type(event).__name__.startswith(("Stream", "Document"))


def _is_end(event: Any) -> bool:
    return type(event).__name__ in ("SequenceEndEvent", "MappingEndEvent")
