"""Files that are no line file at all: one clear fault, never a traceback."""

from __future__ import annotations

from pathlib import Path

import pytest

from catenaria.errors import LineFileError
from catenaria.line import load_line
from catenaria.line.reading import read_tree

# Name of the file, its bytes, line and column of the fault, and words in what was found.
BAD = [
    ("a.yaml", b"", (0, 0), "nothing"),
    ("a.yaml", b"# only a comment\n", (0, 0), "nothing"),
    ("a.yaml", b"- 1\n- 2\n", (1, 1), "a list of 2"),
    ("a.yaml", b"just text", (1, 1), '"just text"'),
    ("a.yaml", b"42", (1, 1), "42"),
    ("a.yaml", b"format: [1, 2\nname: x\n", (2, 5), "YAML error"),
    ("a.yaml", b"format: 1\n\tname: x\n", (2, 1), "YAML error"),
    ("a.yaml", b"format: 1: 2\n", (1, 10), "YAML error"),
    ("a.yaml", b"format: *nowhere\n", (1, 9), "undefined alias"),
    ("a.yaml", b"format: 1\n---\nformat: 1\n", (2, 1), "another document"),
    ("a.yaml", b"name: a\nname: b\n", (2, 1), '"name" a second time'),
    ("a.yaml", b"name: \x07\n", (1, 7), "the character"),
    ("a.yaml", b"ok: 1\nname: caf\xe9\n", (2, 10), "byte 0xe9"),
    ("a.yaml", b"\xff\xfef\x00", (1, 1), "byte 0xff"),
    ("a.yaml", b"name: &a [*a]\n", (1, 7), "contains itself"),
    ("a.yaml", b"name: !!python/name:os.system x\n", (1, 7), "the tag"),
    ("a.yaml", b"format: !!int one\n", (1, 9), "with the tag"),
    ("a.yaml", b"? [1, 2]\n: 3\n", (1, 3), "as the name of a field"),
    ("a.yaml", b"<<: 3\n", (1, 5), "<<"),
    ("a.yaml", b"[" * 3000, (0, 0), "nested too deeply"),
    ("a.json", b"", (1, 1), "JSON error"),
    ("a.json", b"{'format': 1}", (1, 2), "JSON error"),
    ("a.json", b'{"format": 1,\n}', (2, 1), "JSON error"),
    ("a.json", b'{"gravity": NaN}', (0, 0), "NaN"),
    ("a.json", b'{"name": "a",\n "name": "b"}', (2, 2), '"name" a second time'),
    ("a.json", b"[" * 100_000, (0, 0), "nested too deeply"),
    ("a.json", b'{"gravity": ' + b"9" * 5000 + b"}", (0, 0), "a number that JSON does not have"),
]


@pytest.mark.parametrize(("name", "content", "mark", "found"), BAD)
def test_one_clear_fault(
    tmp_path: Path, name: str, content: bytes, mark: tuple[int, int], found: str
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(LineFileError) as caught:
        load_line(path)
    (fault,) = caught.value.faults
    assert (fault.file, (fault.line, fault.column)) == (str(path), mark)
    assert found in fault.found
    assert fault.allowed


def test_no_file_and_no_regular_file(tmp_path: Path) -> None:
    for path, found in ((tmp_path / "none.yaml", "no such file"), (tmp_path, "a directory")):
        with pytest.raises(LineFileError, match=found):
            load_line(path)


def test_all_second_fields_are_named(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("a: {b: 1, b: 2}\nc: 1\nc: 2\nc: 3\n")
    with pytest.raises(LineFileError) as caught:
        read_tree(path)
    assert [fault.field for fault in caught.value.faults] == ["a.b", "c", "c"]


def test_plain_yaml_is_read_as_yaml_1_2(tmp_path: Path) -> None:
    """Negative control: the reader refuses nothing that YAML means."""
    path = tmp_path / "a.yaml"
    path.write_text(
        "a: [yes, 010, 1e3, ~, 2020-01-01, 'x', 1_000]\nb: &m {c: 1}\nd: {<<: *m, e: 2}\n1: one\n"
    )
    tree, source = read_tree(path)
    assert tree == {
        "a": ["yes", 10, 1000.0, None, "2020-01-01", "x", 1000],
        "b": {"c": 1},
        "d": {"c": 1, "e": 2},
        "1": "one",
    }
    assert source.values["a", 3] == (1, 20)
    assert source.keys["d", "e"] == (3, 13)


def test_of_several_merged_mappings_the_first_counts_and_own_fields_most(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("p: &p {x: 1, y: 1, z: 1}\nq: &q {x: 2, y: 2, w: 2}\nr: {<<: [*p, *q], y: 3}\n")
    tree, _ = read_tree(path)
    assert isinstance(tree, dict)
    assert tree["r"] == {"x": 1, "y": 3, "z": 1, "w": 2}
