"""Line documents: what a line file says, as plain data that edits never change in place, and its text."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path as FilePath
from tempfile import TemporaryDirectory
from typing import Any, Final, cast

from ruamel.yaml import YAML

from catenaria.errors import Fault, InconsistentInputError, LineFileError
from catenaria.line.base import Path
from catenaria.line.reading import read_tree
from catenaria.line.source import Source, format_path
from catenaria.studio.limits import refuse_long_tables, refuse_slow_text
from catenaria.studio.text import merged
from catenaria.studio.tree_diff import same
from catenaria.validation import example_file

Tree = dict[str, Any]

MOST_BYTES: Final = 1_000_000

EXAMPLES: Final[Mapping[str, str]] = {
    "yang2017_three_span": "three spans of 65 m, Yang et al. 2017",
    "simple_55m": "AC line, 55 m spans, pre-sag",
    "simple_60m": "AC line, 60 m spans, cantilevers",
    "stitched_re250": "stitch wires at the supports",
    "compound": "auxiliary messenger",
    "curve_800m": "curve of 800 m radius",
    "overlap": "overlap at both ends",
    "bridge": "low bridge on a gradient",
    "two_contact_wires_3kv": "DC line, two contact wires",
}


_SUFFIXES: Final = (".yaml", ".yml", ".json")


@dataclass(frozen=True)
class Written:
    """A text, and what it says."""

    text: str
    tree: Tree


@dataclass(frozen=True)
class Document:
    """A line as it would stand in its file, right or wrong.

    Attributes
    ----------
    name : str
        For files that are made of it.
    tree : dict
        Dictionaries, lists, texts and numbers; whoever wants another one makes it with `replaced`.
    written : Written, optional
        The file that it came from.
    suffix : str
        Of that file: ``.json`` means JSON, any other YAML.
    """

    name: str
    tree: Tree
    written: Written | None = None
    suffix: str = ".yaml"

    @property
    def file(self) -> str:
        """Name of the line file."""
        return self.name + self.suffix

    @cached_property
    def text(self) -> str:
        """The line file: that which it came from, changed where the line was edited."""
        if self.written is not None and same(self.written.tree, self.tree):
            return self.written.text
        if self.suffix == ".json":
            return json.dumps(self.tree, indent=2, ensure_ascii=False) + "\n"
        text = merged(self.written.text, self.written.tree, self.tree) if self.written else None
        return as_yaml(self) if text is None else text

    def edited(self, tree: Tree) -> Document:
        """Return it with other contents."""
        return replace(self, tree=tree)

    def rewritten(self, text: str) -> Document:
        """Return it with another text.

        Raises
        ------
        LineFileError
            If that is no mapping in YAML, or JSON, or takes long to read or to show.
        """
        refuse_slow_text(text, self.file)
        tree, _ = _read(text, self.name, self.suffix)
        refuse_long_tables(tree, self.file)
        return replace(self, tree=tree, written=Written(text, tree))


def open_document(path: FilePath) -> Document:
    """Read a file whose contents may be faulty as a line, but not as YAML or JSON.

    Raises
    ------
    LineFileError
        If it is no mapping in YAML or JSON, or takes long to read or to show.
    """
    tree, _ = _mapping(path)
    refuse_long_tables(tree, str(path))
    return Document(path.stem, tree, Written(path.read_bytes().decode("utf-8-sig"), tree), path.suffix)


def example(name: str) -> Document:
    """Return an example that comes with the package.

    Examples
    --------
    >>> example("simple_55m").tree["format"]
    1
    """
    return open_document(example_file(f"{name}.yaml"))


def uploaded(name: str, data: bytes) -> Document:
    """Read what somebody sent, by way of a temporary folder; the name of the file is only looked at.

    Parameters
    ----------
    name : str
        As the sender calls it; the suffix ``.json`` means JSON, any other YAML.
    data : bytes
        At most `MOST_BYTES`.

    Raises
    ------
    InconsistentInputError
        If it is too large.
    LineFileError
        If it is no mapping in YAML or JSON, or takes long to read or to show.
    """
    if len(data) > MOST_BYTES:
        raise InconsistentInputError(
            f"{name} has {len(data) / 1e6:.1f} MB; allowed: a line file of {MOST_BYTES / 1e6:g} MB at most"
        )
    stem, suffix = plain_name(FilePath(name).stem), FilePath(name).suffix.lower()
    suffix = suffix if suffix in _SUFFIXES else ".yaml"
    refuse_slow_text(data.decode("utf-8-sig", errors="replace"), stem + suffix)
    tree, _ = _read(data, stem, suffix)
    refuse_long_tables(tree, stem + suffix)
    return Document(stem, tree, Written(data.decode("utf-8-sig"), tree), suffix)


def placed(document: Document, faults: Sequence[Fault]) -> tuple[Fault, ...]:
    """Return faults of a document with line and column in its text: of the value, or of what lacks it."""
    _, source = _read(document.text, document.name, document.suffix)
    marks = {format_path(path): mark for path, mark in source.values.items()}
    found: list[Fault] = []
    for fault in faults:
        field = fault.field
        while field not in marks:
            field = field[: max(field.rfind("."), field.rfind("["), 0)] or format_path(())
        line, column = marks[field]
        found.append(replace(fault, line=line, column=column))
    return tuple(sorted(found, key=lambda fault: (fault.line, fault.column)))


def _read(text: str | bytes, name: str, suffix: str) -> tuple[Tree, Source]:
    """Read a file that lies nowhere; faults call it by its name."""
    with TemporaryDirectory(prefix="catenaria-studio-") as folder:
        file = FilePath(folder) / f"line{suffix}"
        data = text if isinstance(text, bytes) else text.encode(errors="surrogatepass")
        file.write_bytes(data)
        try:
            return _mapping(file)
        except LineFileError as error:
            faults = tuple(replace(fault, file=name + suffix) for fault in error.faults)
            raise LineFileError(faults) from error


def _mapping(path: FilePath) -> tuple[Tree, Source]:
    tree, source = read_tree(path)
    if not isinstance(tree, dict):
        fault = Fault(str(path), 1, 1, "the file", "something else", "a mapping with the fields of a line")
        raise LineFileError((fault,))
    return cast("Tree", tree), source


def plain_name(text: str) -> str:
    """Return a name of plain letters, digits, ``-`` and ``_``, as any system takes it.

    Examples
    --------
    >>> plain_name("../my line")
    'my_line'
    """
    kept = re.sub(r"[^A-Za-z0-9_-]+", "_", text)
    return kept.strip("_")[:60] or "line"


def as_yaml(document: Document) -> str:
    """Return the text of the line file, without comments and with all repetitions written out."""
    writer: Any = YAML(typ="safe", pure=True)
    writer.default_flow_style = None
    writer.sort_base_mapping_type_on_output = False
    writer.width = 110
    writer.representer.ignore_aliases = _written_out
    stream = io.StringIO()
    writer.dump(document.tree, stream)
    return stream.getvalue()


def _written_out(_: object) -> bool:
    return True


def replaced(tree: Tree, path: Path, value: object) -> Tree:
    """Return a tree with another value at a path; None takes away the field, and mappings that it empties.

    Examples
    --------
    >>> replaced({"a": [{"b": 1}, {"b": 2}]}, ("a", 1, "b"), 3)
    {'a': [{'b': 1}, {'b': 3}]}
    >>> replaced({"a": {"b": {"c": 1}}, "d": 0}, ("a", "b", "c"), None)
    {'d': 0}
    """
    return cast("Tree", _replaced(tree, path, value) or {})


def _replaced(node: object, path: Path, value: object) -> object:
    if not path:
        return value
    step, *rest = path
    if isinstance(node, list) and isinstance(step, int):
        items = list(cast("list[object]", node))
        items[step] = _replaced(items[step], tuple(rest), value)
        return items
    fields = dict(cast("dict[object, object]", node)) if isinstance(node, dict) else {}
    new = _replaced(fields.get(step), tuple(rest), value)
    if new is None or new == {}:
        fields.pop(step, None)
    else:
        fields[step] = new
    return fields
