"""YAML and JSON text to plain data, with line and column of every value."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path as FilePath
from typing import Any, Final, NoReturn, Protocol

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError
from ruamel.yaml.reader import ReaderError

from catenaria.errors import Fault, LineFileError
from catenaria.line.base import Path
from catenaria.line.source import Mark, Source, format_path

_MOST_VALUES: Final = 1_000_000  # aliases of aliases write billions of values in a few lines
_PLAIN_TAGS = frozenset(
    f"tag:yaml.org,2002:{kind}" for kind in ("null", "bool", "int", "float", "str", "timestamp", "seq", "map")
)


def read_tree(path: FilePath) -> tuple[object, Source]:
    """Read a YAML or JSON file.

    Parameters
    ----------
    path : pathlib.Path
        The file; the suffix ``.json`` means JSON, any other YAML.

    Returns
    -------
    tree : object
        Dictionaries, lists, texts, numbers, booleans and None.
    source : Source
        Where everything in the tree stands.

    Raises
    ------
    LineFileError
        If there is no such file or its text is not what its suffix says.
    """
    file, text = str(path), _read_text(path)
    if path.suffix.lower() != ".json":
        return _Builder(file).build(text)
    tree = _parse_json(file, text)
    # JSON is YAML too, which knows the places; tabs between values are the one thing that YAML minds.
    _, source = _Builder(file).build(text.replace("\t", " "))
    return tree, source


def read_value(text: str, otherwise: object) -> object:
    """Read a YAML value that stands in no file; return `otherwise` if the text is none.

    Examples
    --------
    >>> read_value("[0.1, 30 cm]", None)
    [0.1, '30 cm']
    """
    try:
        return _Builder("").build(text)[0]
    except LineFileError:
        return otherwise


def _refuse(file: str, found: str, allowed: str, mark: Mark = (0, 0), field: str = "the file") -> NoReturn:
    """Raise one fault that makes the file as a whole useless."""
    raise LineFileError((Fault(file, *mark, format_path(()), found, allowed),))


def _read_text(path: FilePath) -> str:
    file = str(path)
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        _refuse(file, "no such file", "the path of a YAML or JSON file")
    except IsADirectoryError:
        _refuse(file, "a directory", "the path of a YAML or JSON file")
    except OSError as error:
        _refuse(file, f"a file that cannot be read ({error.strerror})", "a readable file")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = data[: error.start]
        mark = _place_of_end(before.decode("utf-8-sig", errors="replace"))
        _refuse(file, f"byte 0x{data[error.start]:02x}, which is not UTF-8", "text in UTF-8", mark)


def _parse_json(file: str, text: str) -> object:
    try:
        return json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        _refuse(file, f"a JSON error ({error.msg})", "valid JSON", (error.lineno, error.colno))
    except RecursionError:
        _refuse(file, "brackets nested too deeply", "a mapping with the fields of a line")
    except ValueError as error:
        _refuse(file, f"a number that JSON does not have ({error})", "finite JSON numbers")


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(name)


class Node(Protocol):
    """What ruamel.yaml, which has no types, composes a document of."""

    id: str
    tag: object
    value: Any
    start_mark: Any


class _Builder:
    """Turns the node graph of one YAML document into data, noting the places on the way."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.values: dict[Path, Mark] = {}
        self.keys: dict[Path, Mark] = {}
        self.faults: list[Fault] = []
        self.open: set[int] = set()
        self.values_read = 0
        self.yaml: Any = YAML(typ="safe", pure=True)

    def build(self, text: str) -> tuple[object, Source]:
        """Read the document; raise what is wrong with it."""
        try:
            root = self._compose(text)
            tree = self._data(root, ())
        except RecursionError:
            _refuse(self.file, "brackets nested too deeply", "a mapping with the fields of a line")
        if self.faults:
            raise LineFileError(tuple(self.faults))
        return tree, Source(self.file, self.values, self.keys)

    def _compose(self, text: str) -> Node:
        self.yaml.composer.warn_double_anchors = False
        try:
            root: Node | None = self.yaml.compose(text)
        except MarkedYAMLError as error:
            mark: Any = error.problem_mark or error.context_mark
            what = ": ".join(str(part) for part in (error.context, error.problem) if part)
            _refuse(self.file, f"a YAML error ({what})", "valid YAML", (mark.line + 1, mark.column + 1))
        except ReaderError as unreadable:
            error: Any = unreadable
            place = _place_of_end(text[: error.position])
            _refuse(self.file, f"the character {text[error.position]!r}", "printable text", place)
        if root is None:
            _refuse(self.file, "nothing", "a mapping with the fields of a line")
        return root

    def _count(self, node: Node) -> None:
        self.values_read += 1
        if self.values_read > _MOST_VALUES:
            _refuse(
                self.file,
                f"more than {_MOST_VALUES} values, aliases written out",
                "a line that fits into memory",
                _mark(node),
            )

    def _data(self, node: Node, path: Path) -> object:
        self._count(node)
        self.values[path] = _mark(node)
        if not self._is_plain(node, path):
            return None
        if node.id == "scalar":
            return self._scalar(node, path)
        if id(node) in self.open:
            self._fault(node, path, "an alias that contains itself", "an alias of something else")
            return None
        self.open.add(id(node))
        if node.id == "sequence":
            data: object = [self._data(item, (*path, i)) for i, item in enumerate(node.value)]
        else:
            data = self._mapping(node, path)
        self.open.remove(id(node))
        return data

    def _mapping(self, node: Node, path: Path) -> dict[str, object]:
        data: dict[str, object] = {}
        for key, value in self._merged(node, path):
            data[key] = self._data(value, (*path, key))
        own: dict[str, Node] = {}
        for key_node, value in self._pairs(node, path):
            key = str(key_node.value)
            if key in own:
                first = _mark(own[key])[0]
                self._fault(
                    key_node, (*path, key), f'"{key}" a second time', f"each field once (first: line {first})"
                )
                continue
            own[key] = key_node
            data[key] = self._data(value, (*path, key))
            self.keys[(*path, key)] = _mark(key_node)
        return data

    def _pairs(self, node: Node, path: Path) -> Iterator[tuple[Node, Node]]:
        for key, value in node.value:
            if key.id != "scalar":
                self._fault(key, path, "a list or mapping as the name of a field", "a text")
            elif str(key.tag) != "tag:yaml.org,2002:merge":
                yield key, value

    def _merged(self, node: Node, path: Path) -> Iterator[tuple[str, Node]]:
        """Fields that ``<<: *anchor`` brings in; of several anchors the first one counts."""
        self._count(node)
        for key, value in node.value:
            if str(key.tag) != "tag:yaml.org,2002:merge":
                continue
            sources: list[Node] = value.value if value.id == "sequence" else [value]
            for source in reversed(sources):
                if source.id != "mapping" or id(source) in self.open:
                    self._fault(source, path, "<< before something else", "<< before the alias of a mapping")
                    continue
                yield from self._merged(source, path)
                for key_node, item in self._pairs(source, path):
                    yield str(key_node.value), item

    def _is_plain(self, node: Node, path: Path) -> bool:
        tag = str(node.tag)
        if tag not in _PLAIN_TAGS:
            self._fault(node, path, f"the tag {tag}", "plain YAML without tags of its own")
        return tag in _PLAIN_TAGS

    def _scalar(self, node: Node, path: Path) -> object:
        tag = str(node.tag)
        if tag.endswith("timestamp"):
            return str(node.value)
        try:
            return self.yaml.constructor.construct_object(node)
        except (ValueError, KeyError, OverflowError):
            self._fault(node, path, f'"{node.value}" with the tag {tag}', "a value that fits its tag")
            return None

    def _fault(self, node: Node, path: Path, found: str, allowed: str) -> None:
        self.faults.append(Fault(self.file, *_mark(node), format_path(path), found, allowed))


def _mark(node: Node) -> Mark:
    return (node.start_mark.line + 1, node.start_mark.column + 1)


def _place_of_end(text: str) -> Mark:
    """Line and column of what would follow the text."""
    return (text.count("\n") + 1, len(text) - text.rfind("\n"))
