"""Edits in the text of a line file: what is not edited stays, and what comes out says what was wanted."""

from __future__ import annotations

import copy
import json
import re
import time
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from catenaria.errors import InconsistentInputError
from catenaria.line.reading import read_tree, read_value
from catenaria.studio import text as text_module
from catenaria.studio.documents import EXAMPLES, Document, Tree, Written, as_yaml, example, replaced
from catenaria.studio.spans import span_count, with_span_after, without_span
from catenaria.studio.text import merged, patched
from catenaria.studio.tree_diff import aligned, same
from catenaria.studio.yaml_writing import Writer

VALUES = (
    65, 60.0, 2.5, 1e-7, True, None, "65 m", "a, b", "it's: #1", "", "true", "1e5", "two\nlines", "- x", "<<",
    [1, 2.5], {"kind": "weight", "of": [1, {"kN": "5 kN"}]}, {}, [], "é 😀", float("inf"), float("nan"),
)  # fmt: skip


def tree_of(text: str) -> Tree:
    tree: Any = read_value(text, None)
    return tree


def after(text: str, path: tuple[str | int, ...], value: object) -> str:
    """Return a text with one edit, which has to be possible without writing everything anew."""
    tree = tree_of(text)
    found = merged(text, tree, replaced(tree, path, value))
    assert found is not None
    return found


def paths(node: object, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    children = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [path, *(below for key, child in children for below in paths(child, (*path, key)))]


def put(tree: Tree, path: tuple[Any, ...], value: object) -> Tree:
    tree = copy.deepcopy(tree)
    parent: Any = tree
    for step in path[:-1]:
        parent = parent[step]
    parent[path[-1]] = value
    return tree


def removed(tree: Tree, path: tuple[Any, ...]) -> Tree:
    tree = copy.deepcopy(tree)
    parent: Any = tree
    for step in path[:-1]:
        parent = parent[step]
    del parent[path[-1]]
    return tree


@st.composite
def edits(draw: st.DrawFn, tree: Tree) -> Tree:
    """Draw a tree that some edits make of another one."""
    for _ in range(draw(st.integers(1, 4))):
        path = draw(st.sampled_from(paths(tree)[1:]))
        span = draw(st.integers(0, max(span_count(tree) - 1, 0)))
        value = draw(st.sampled_from(VALUES))
        kind = draw(st.sampled_from(["value", "field", "take", "form", "add span", "take span"]))
        try:
            match kind:
                case "value":
                    tree = put(tree, path, value)
                case "field":
                    tree = put(tree, (*path[:-1], "added" if isinstance(path[-1], str) else path[-1]), value)
                case "take" if len(tree) > 1:
                    tree = removed(tree, path)
                case "form" if value is not None:
                    tree = replaced(tree, path, value)
                case "add span":
                    tree = with_span_after(tree, span)
                case _:
                    tree = without_span(tree, span)
        except (InconsistentInputError, IndexError):
            continue
    return tree


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_without_an_edit_not_a_byte_changes(name: str, newline: str) -> None:
    text = example(name).text.replace("\n", newline)
    assert merged(text, tree_of(text), tree_of(text)) == text
    undone = replaced(replaced(tree_of(text), ("name",), "x"), ("name",), tree_of(text)["name"])
    assert merged(text, tree_of(text), undone) == text


@pytest.mark.parametrize("name", EXAMPLES)
def test_random_edits_are_what_the_text_says(name: str, tmp_path: Path) -> None:
    document = example(name)
    headings = [line for line in document.text.splitlines() if line.startswith("#")]

    @settings(derandomize=True, deadline=None, max_examples=30)
    @given(edits(document.tree))
    def holds(tree: Tree) -> None:
        found = patched(document.text, document.tree, tree)  # without the net below
        assert found is not None
        file = tmp_path / "line.yaml"
        file.write_text(found, encoding="utf-8", newline="")
        assert same(read_tree(file)[0], tree)
        assert [line for line in found.splitlines() if line.startswith("#")] == headings
        assert document.edited(tree).text == found

    holds()


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_edited_value_is_all_that_changes(name: str) -> None:
    document = example(name)
    text = document.edited(replaced(document.tree, ("contact_wire", "tension", "force"), "17 kN")).text
    pairs = zip(document.text.splitlines(), text.splitlines(), strict=True)
    ((before, now),) = [(one, other) for one, other in pairs if one != other]
    assert now == re.sub(r"\d[\d.]* kN", "17 kN", before, count=1)


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_wrong_text_is_not_given_out(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Break the merge: whoever edits one of many that share an alias would edit all of them."""
    document = example(name)
    shared = document.text.index("- &")
    assert document.text.index("\n  - *", shared) > shared
    tree = replaced(document.tree, ("spans", 0, "length"), 61.5)
    right = document.edited(tree).text
    monkeypatch.setattr(text_module, "names", lambda values, wanted: {})
    monkeypatch.setattr(Writer, "alias", lambda self, value, like, at: "as it was")
    wrong = patched(document.text, document.tree, tree)
    assert wrong is not None
    assert not same(read_value(wrong, None), tree)
    assert merged(document.text, document.tree, tree) is None
    assert document.edited(tree).text == as_yaml(document.edited(tree)) != right
    assert same(read_value(document.edited(tree).text, None), tree)


SHARED = """\
spans:
  # the first one
  - &span   # like most
    length: 65 m
    droppers: {positions: [4, 13.5]}   # two
  - *span   # second
  # the third one
  - *span
"""


def test_an_alias_that_is_edited_gets_its_own_copy() -> None:
    assert after(SHARED, ("spans", 1, "length"), 60.0) == SHARED.replace(
        "  - *span   # second\n",
        "  - length: 60  # second\n    droppers: {positions: [4, 13.5]}\n",
    )


def test_an_anchor_moves_on_when_what_it_names_is_edited() -> None:
    assert after(SHARED, ("spans", 0, "length"), "60 m") == (
        "spans:\n  # the first one\n  -   # like most\n    length: 60 m\n"
        "    droppers: {positions: [4, 13.5]}   # two\n"
        "  - &span   # second\n    length: 65 m\n    droppers: {positions: [4, 13.5]}\n"
        "  # the third one\n  - *span\n"
    )


def test_aliases_follow_when_all_are_edited_alike() -> None:
    tree = tree_of(SHARED)
    for i in range(3):
        tree = replaced(tree, ("spans", i, "length"), "60 m")
    assert merged(SHARED, tree_of(SHARED), tree) == SHARED.replace("65 m", "60 m")


def test_spans_come_and_go_without_the_comments_of_others() -> None:
    tree = tree_of(SHARED)
    spans = tree["spans"]
    fewer = merged(SHARED, tree, {"spans": spans[:2]})
    assert fewer == SHARED.replace("  # the third one\n  - *span\n", "  # the third one\n")
    more = merged(SHARED, tree, {"spans": [*spans, spans[2]]})
    assert more == SHARED + "  - *span\n"
    other = merged(SHARED, tree, {"spans": [*spans[:2], {"length": "50 m"}, spans[2], spans[0]]})
    assert other is not None
    assert other == SHARED.replace("# second\n", "# second\n  - length: 50 m\n  - *span\n")


MERGED = """\
supports:
  - &end   # first
    stagger: 200 mm
    contact_wire: {height: 5.5 m}
  - <<: *end   # last
    stagger: -200 mm
"""


def test_what_is_taken_over_is_stated_where_it_differs() -> None:
    assert after(MERGED, ("supports", 1, "contact_wire", "height"), "5 m") == (
        MERGED + "    contact_wire: {height: 5 m}\n"
    )
    assert after(MERGED, ("supports", 0, "contact_wire", "height"), "5 m") == (
        MERGED.replace("5.5 m", "5 m") + "    contact_wire: {height: 5.5 m}\n"
    )
    assert after(MERGED, ("supports", 0, "name"), "A") == (
        MERGED.replace("5.5 m}\n  - <<: *end   # last\n    stagger", "5.5 m}\n    name: A\n  - stagger")
        + "    contact_wire: {height: 5.5 m}\n"
    )


@pytest.mark.parametrize(
    ("text", "path", "value", "expected"),
    [
        ("a: 65.0  # m\n", ("a",), 60.0, "a: 60.0  # m\n"),
        ("a: 65    # m\n", ("a",), 7.0, "a: 7     # m\n"),
        ("a: 65 # m\n", ("a",), 100.25, "a: 100.25 # m\n"),
        ("a: [4, 10.5]\n", ("a",), [4.0, 10.5, 17.0], "a: [4, 10.5, 17]\n"),
        ("a: [10.50, 4.0]\n", ("a",), [10.5, 4.0, 17.0], "a: [10.50, 4.0, 17.0]\n"),
        ("a: [4, 10,\n    16]  # m\n", ("a",), [4, 16], "a: [4, 16]  # m\n"),
        ("a: 'x'\nb: \"y\"\n", ("b",), "it's", "a: 'x'\nb: \"it's\"\n"),
        ("a: 'x'\n", ("a",), "it's", "a: 'it''s'\n"),
        ("a: plain\n", ("a",), "5", "a: '5'\n"),
        ("a: |\n  two\n  lines\nb: 1\n", ("a",), "one", "a: one\nb: 1\n"),
        ("a: {b: 1, c: 2}\n", ("a", "b"), None, "a: {c: 2}\n"),
        ("a: {b: 1, c: 2}\n", ("a", "c"), None, "a: {b: 1}\n"),
        ("a: {b: 1}\n", ("a", "c"), "x", "a: {b: 1, c: x}\n"),
        ("a:\n  b: 1   # b\nc: 2\n", ("a", "d"), 3, "a:\n  b: 1   # b\n  d: 3\nc: 2\n"),
        ("a:\n  b: 1   # b\nc: 2", ("a", "b"), None, "c: 2"),
        ("a: 1", ("b", "c"), "5 kN", "a: 1\nb: {c: 5 kN}"),
        ("a:\n- b: 1\n  c: 2\n", ("a", 0, "b"), None, "a:\n- c: 2\n"),
        ("a:\n- b: 1\n  # of c\n  c: 2\n", ("a", 0, "b"), None, "a:\n-\n  # of c\n  c: 2\n"),
        ("a:\n  first: 1\nb: 2\n", ("a",), {"positions": [1, 2]}, "a:\n  positions: [1, 2]\nb: 2\n"),
        ("a: {first: 1}\n", ("a",), {"positions": [1]}, "a: {positions: [1]}\n"),
        ("a:\nb: 1\n", ("a",), "x", "a: x\nb: 1\n"),
        ("a: &x 1\nb: *x\n", ("a",), 2, "a: 2\nb: &x 1\n"),
        ("a:\n  - &x\n    b: 1\nc: *x\n", ("a", 0, "b"), 2, "a:\n  - b: 2\nc: &x\n  b: 1\n"),
        ("a: 1\r\nb:\r\n  c: 2\r\n", ("b", "d"), 3, "a: 1\r\nb:\r\n  c: 2\r\n  d: 3\r\n"),
    ],
)  # fmt: skip
def test_edits_are_written_in_the_manner_of_the_file(
    text: str, path: tuple[str | int, ...], value: object, expected: str
) -> None:
    assert after(text, path, value) == expected


@pytest.mark.parametrize("value", VALUES)
@pytest.mark.parametrize("text", ["a: x\n", "{a: 'x'}\n", '{"a": "x"}', "a: 1.0\n"])
def test_every_value_is_read_as_what_it_is(text: str, value: object) -> None:
    found = merged(text, tree_of(text), {"a": value})
    assert found is not None
    assert same(read_value(found, None), {"a": value})


@pytest.mark.parametrize(
    "text", ["? a\n: 1\n? b\n: 2\n", "&k a: 1\nb: *k\n*k : 3\n", "%YAML 1.2\n---\na: 1\nb: 2\n...\n"]
)
def test_unusual_yaml_is_written_anew_rather_than_wrong(text: str) -> None:
    tree: Any = read_value(text, {"a": 1, "b": 2})
    for path in paths(tree)[1:]:
        edited = Document("odd", tree, Written(text, tree)).edited(removed(tree, path))
        assert same(read_value(edited.text, None), edited.tree)


def test_json_stays_json() -> None:
    text = '{"a": 65.0, "b": ["é"]}'
    document = Document("line", json.loads(text), Written(text, json.loads(text)), ".json")
    assert document.text == text
    edited = document.edited(replaced(document.tree, ("a",), 60.0))
    assert json.loads(edited.text) == {"a": 60.0, "b": ["é"]}
    assert "é" in edited.text


def test_long_lists_are_paired_in_their_order_at_once() -> None:
    began = time.perf_counter()
    pairs = aligned(range(30_000), range(-20_000, 0))
    assert time.perf_counter() - began < 2.0
    assert pairs[:2] == [(0, 0), (1, 1)]
    assert pairs[-1] == (29_999, None)
    assert [j for _, j in pairs if j is not None] == [*range(20_000)]
    assert aligned(range(30_000), [*range(20_000), *range(20_001, 30_000)])[20_000] == (20_000, None)


def test_few_items_change_when_lists_are_paired() -> None:
    long = [*"LRLRLRLR"]
    assert [(i, j) for i, j in aligned(long, [*"LXLRLRYR"]) if i != j] == []
    assert [(i, j) for i, j in aligned(long, [*"LRLRXLRLR"]) if i is None] == [(None, 4)]
    assert aligned([], [1]) == [(None, 0)]
    assert aligned([float("nan")], [float("nan"), True]) == [(0, 0), (None, 1)]
    assert not same(True, 1)
