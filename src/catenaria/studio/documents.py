"""Line documents: what stands in a line file, as plain data that edits never change in place."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from tempfile import TemporaryDirectory
from typing import Any, Final, cast

from ruamel.yaml import YAML

from catenaria.errors import Fault, InconsistentInputError, LineFileError
from catenaria.line.base import Path
from catenaria.line.reading import read_tree
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


@dataclass(frozen=True)
class Document:
    """A line as it would stand in its file, right or wrong.

    Attributes
    ----------
    name : str
        For files that are made of it.
    tree : dict
        Dictionaries, lists, texts and numbers; whoever wants another one makes it with `replaced`.
    """

    name: str
    tree: Tree


def open_document(path: FilePath) -> Document:
    """Read a file whose contents may be faulty as a line, but not as YAML or JSON.

    Raises
    ------
    LineFileError
        If it is no mapping in YAML or JSON.
    """
    tree, _ = read_tree(path)
    if not isinstance(tree, dict):
        fault = Fault(str(path), 1, 1, "the file", "something else", "a mapping with the fields of a line")
        raise LineFileError((fault,))
    return Document(path.stem, cast("Tree", tree))


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
        If it is no mapping in YAML or JSON.
    """
    if len(data) > MOST_BYTES:
        raise InconsistentInputError(
            f"{name} has {len(data) / 1e6:.1f} MB; allowed: a line file of {MOST_BYTES / 1e6:g} MB at most"
        )
    json = name.lower().endswith(".json")
    with TemporaryDirectory(prefix="catenaria-studio-") as folder:
        file = FilePath(folder) / ("line.json" if json else "line.yaml")
        file.write_bytes(data)
        document = open_document(file)
    return Document(plain_name(FilePath(name).stem), document.tree)


def plain_name(text: str) -> str:
    """Return a name of plain letters, digits, ``-`` and ``_``, as any system takes it.

    Examples
    --------
    >>> plain_name("../my line")
    'my_line'
    """
    kept = re.sub(r"[^A-Za-z0-9_-]", "_", text)
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
