"""An edited line in the text that it came from: what was not edited stays as it was written.

ruamel.yaml's own round trip writes the whole file anew, with line breaks, blanks and quotes of its own. Here
it only finds where things stand, and the text is changed in the places of the edits.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, cast

from catenaria.line.reading import read_value
from catenaria.studio.tree_diff import same
from catenaria.studio.yaml_parts import Entry, Part, parts
from catenaria.studio.yaml_plan import Tree, Wanted, names, valued_parts, wanted_parts
from catenaria.studio.yaml_writing import Model, Writer, models_of

_COMMENT: Final = re.compile(r"[ \t]+(#[^\r\n]*)")


def merged(source: str, old: Tree, new: Tree) -> str | None:
    r"""Return a YAML text with as little change as possible that reads as another tree.

    Comments, order, quotes, the way numbers are written, brackets and anchors of what is not edited stay.
    Where something is edited that others share by an alias, the others keep sharing what they had.

    Parameters
    ----------
    source : str
        A text.
    old, new : mapping
        What it says, and what it shall say.

    Returns
    -------
    str or None
        The text; None if what came out of it does not read as `new`.

    Examples
    --------
    >>> source = "a: &x {b: 1}  # one\nc: *x\n"
    >>> print(merged(source, {"a": {"b": 1}, "c": {"b": 1}}, {"a": {"b": 2}, "c": {"b": 1}}))
    a: {b: 2}  # one
    c: &x {b: 1}
    <BLANKLINE>
    """
    if same(old, new):
        return source
    text = patched(source, old, new)
    return text if text is not None and same(read_value(text, None), new) else None


def patched(source: str, old: Tree, new: Tree) -> str | None:
    """Return the text before it is read again, None if nothing of the old one would stay."""
    root = parts(source)
    if root.kind != "mapping" or not new.keys() & {entry.key for entry in root.entries}:
        return None
    wanted = dict(wanted_parts(root, old, new))
    named = names(dict(valued_parts(root, old)), wanted)
    patches = _Patches(source, wanted, Writer(source, named))
    patches.entries(root)
    return patches.applied()


@dataclass
class _Patches:
    """Collects what to replace in a text."""

    source: str
    wanted: Mapping[Part, Wanted]
    writer: Writer
    patches: list[tuple[int, int, str]] = field(default_factory=list[tuple[int, int, str]])

    def applied(self) -> str:
        """Return the text with everything replaced; where two take the same away, it is gone once."""
        done, at = "", 0
        for start, end, text in sorted(self.patches, key=lambda patch: patch[0]):
            done += self.source[at : max(start, at)] + text
            at = max(at, end)
        return done + self.source[at:]

    def entries(self, part: Part) -> None:
        """Change the entries of a mapping or a list that stays."""
        stay = [i for i, entry in enumerate(part.entries) if self._stays(part, entry)]
        for i in stay:
            if not part.entries[i].merges:
                self._value(part.entries[i], part)
        self._remove(part, stay)
        if part.kind == "list":
            self._add_items(part)
        else:
            self._add_fields(part)

    def _stays(self, part: Part, entry: Entry) -> bool:
        return bool(self._taken_over(part)) if entry.merges else entry.value in self.wanted

    def _taken_over(self, part: Part) -> dict[str, object]:
        """Return the fields that a mapping goes on to take over from others; nothing if one is unwanted."""
        provided = self.writer.provided(part, part.end) or {}
        return provided if provided.keys() <= cast("Tree", self.wanted[part].new).keys() else {}

    def _value(self, entry: Entry, inside: Part) -> None:
        """Change the value of an entry that stays."""
        part, want = entry.value, self.wanted[entry.value]
        named = self.writer.named.get(part.meant)
        anchor = part.meant.anchor if named and named.by is part else ""
        if part.kind == "alias":
            if anchor or not self.writer.alias(want.new, Model(part, want.old), part.start):
                self._rewrite(entry, inside, anchor)
        elif not self._is_kept(part, want):
            self._rewrite(entry, inside, anchor)
        else:
            if part.anchor and not anchor:
                self._unname(part)
            if part.entries:
                self.entries(part)

    def _is_kept(self, part: Part, want: Wanted) -> bool:
        """Return whether a part stays as far as its entries do."""
        if part.kind == "scalar":
            return same(want.old, want.new)
        kind = list if part.kind == "list" else dict
        new = want.new
        alike = isinstance(new, kind) and bool(part.entries) == bool(cast("object", new))
        return alike and (not part.entries or any(self._stays(part, entry) for entry in part.entries))

    def _rewrite(self, entry: Entry, inside: Part, anchor: str) -> None:
        """Write a value anew."""
        part, want = entry.value, self.wanted[entry.value]
        like, name = Model(part, want.old), f"&{anchor} " if anchor else ""
        if inside.flow or self.source[entry.gap : part.start].strip():
            self._replace(entry.gap, part, f" {name}{self.writer.flow(want.new, like, part.start)}")
            return
        column, dash = self._column(entry.start) + 2, inside.kind == "list"
        text = self.writer.behind(want.new, like, part.start, column, anchor, dash=dash)
        self._replace(entry.gap, part, text)

    def _replace(self, gap: int, part: Part, text: str) -> None:
        """Put a text that begins with a blank or a line break in place of a value, and leave its comment."""
        first, newline, rest = text.partition(self.writer.newline)
        start = gap
        if not newline and not _is_block(part) and self.source[gap : part.start]:
            start, first = part.start, first.lstrip()
        comment = _COMMENT.match(self.source, part.end)
        if comment is None:
            self.patches.append((start, part.end, first + newline + rest))
            return
        column = self._column(comment.end() - len(comment[1])) - self._column(start) - len(first)
        said = " " * max(column, min(2, len(comment[0]) - len(comment[1]))) + comment[1]
        self.patches.append((start, comment.end(), first + said + newline + rest))

    def _unname(self, part: Part) -> None:
        """Take the anchor away from what keeps its place."""
        end = part.start + 1 + len(part.anchor)
        between = self.source[end : part.begin]
        beside = self._column(part.start) == self._column(part.begin)  # as a field may stand beside a dash
        joins = _is_block(part) and beside and self._stays(part, part.entries[0]) and not between.strip()
        if joins or "\n" not in between:
            self.patches.append((part.start, part.begin, ""))
        else:
            self.patches.append((len(self.source[: part.start].rstrip(" ")), end, ""))

    def _remove(self, part: Part, stay: Sequence[int]) -> None:
        """Take the other entries away: in a block with their lines, but not with comments above them."""
        entries = part.entries
        for i in sorted(set(range(len(entries))).difference(stay)):
            first = self._line(entries[i].start)
            if part.flow and i < stay[-1]:
                self.patches.append((entries[i].start, entries[i + 1].start, ""))
            elif part.flow:
                self.patches.append((entries[i - 1].value.end, entries[i].value.end, ""))
            elif not self.source[first : entries[i].start].strip():
                self.patches.append((first, self._next_line(entries[i].value.end), ""))
            else:
                self._remove_beside_dash(part, stay[0])

    def _remove_beside_dash(self, part: Part, stays: int) -> None:
        """Take away the first field, beside the dash of an item, and move up the first one that stays."""
        start, behind = part.entries[0].start, self._next_line(part.entries[stays - 1].value.end)
        up = part.entries[stays].start
        if commented := self.source[behind:up].strip():
            start = len(self.source[:start].rstrip(" "))
        end = self._next_line(part.entries[0].value.end) - len(self.writer.newline) if commented else up
        self.patches.append((start, end, ""))

    def _add_fields(self, part: Part) -> None:
        taken_over = self._taken_over(part)
        own = {entry.key for entry in part.entries if not entry.merges}
        want, last = self.wanted[part], part.entries[-1]
        models = models_of(Model(part, want.old))
        at, column = last.value.end, self._column(part.begin)
        for key, value in cast("Tree", want.new).items():
            if key in own or (key in taken_over and same(taken_over[key], value)):
                continue
            if part.flow:
                added = self.writer.flow({key: value}, None, at)[1:-1]
            else:
                added = self.writer.field(key, value, models.get(key), at, column)
            self._add(part, last, added)

    def _add_items(self, part: Part) -> None:
        want, behind = self.wanted[part], -1
        old, new = cast("list[object]", want.old), cast("list[object]", want.new)
        for i, j in want.pairs:
            if i is not None:
                behind = i
            elif j is not None:
                before = part.entries[behind] if behind >= 0 else None
                like = Model(part.entries[max(behind, 0)].value, old[max(behind, 0)])
                at = before.value.end if before else part.begin
                if part.flow:
                    added = self.writer.flow(new[j], like, at)
                else:
                    added = self.writer.item(new[j], like, at, self._column(part.begin))
                self._add(part, before, added)

    def _add(self, part: Part, before: Entry | None, added: str) -> None:
        """Add an entry behind another one, or as the first."""
        if part.flow:
            at = before.value.end if before else part.entries[0].start
            self.patches.append((at, at, f", {added}" if before else f"{added}, "))
            return
        at = self._next_line(before.value.end) if before else self._line(part.entries[0].start)
        line = " " * self._column(part.begin) + added
        newline = self.writer.newline
        ended = at == 0 or self.source[at - 1] == "\n"
        self.patches.append((at, at, line + newline if ended else newline + line))

    def _line(self, at: int) -> int:
        return self.source.rfind("\n", 0, at) + 1

    def _next_line(self, at: int) -> int:
        return self.source.find("\n", at) + 1 or len(self.source)

    def _column(self, at: int) -> int:
        return at - self._line(at)


def _is_block(part: Part) -> bool:
    return part.kind in ("mapping", "list") and not part.flow
