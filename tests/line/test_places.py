"""Line and column of values, found by searching the text, in every style of YAML and JSON."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from catenaria.errors import LineFileError
from catenaria.line import load_line
from catenaria.line.source import Source, format_path

Write = Callable[..., Path]
MARKER = "7 furlong"


def place(text: str, spot: str) -> tuple[int, int]:
    before = text[: text.index(spot)]
    return before.count("\n") + 1, len(before) - before.rfind("\n")


def places(path: Path) -> list[tuple[int, int, str]]:
    with pytest.raises(LineFileError) as caught:
        load_line(path)
    return [(fault.line, fault.column, fault.field) for fault in caught.value.faults]


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    indent=st.sampled_from([None, 0, 1, 2, 7, "\t"]),
    span=st.integers(0, 2),
    dropper=st.integers(0, 6),
    suffix=st.sampled_from([".json", ".yaml"]),
)
def test_nested_lists(
    write: Write, tree: dict[str, Any], indent: int | str | None, span: int, dropper: int, suffix: str
) -> None:
    spoilt = copy.deepcopy(tree)
    spoilt["spans"][span]["droppers"]["positions"][dropper] = MARKER
    text = json.dumps(spoilt, indent=indent)
    if suffix == ".yaml":
        text = text.replace("\t", "  ")
    expected = (*place(text, f'"{MARKER}"'), f"spans[{span}].droppers.positions[{dropper}]")
    assert places(write(text, f"line{suffix}")) == [expected]


ROW = "droppers: {positions: [4, 13.5, 23, 32.5, 42, 51.5, 61]}"
STYLES = {
    "flow": "droppers: {positions: [4, 13.5,    7 furlong, 30]}",
    "flow over lines": "droppers: {positions: [4,\n      13.5,\n\n      7 furlong,  # a comment\n      30]}",
    "block": "droppers:\n      positions:\n        - 4\n        - 13.5\n        -    7 furlong\n        - 30",
    "block, list as far left as its key": (
        "droppers:\n      positions:\n      - 4\n      - 5\n      - 7 furlong"
    ),
    "double quotes": 'droppers: {"positions": [4, 13.5, "7 furlong", 30]}',
    "single quotes": "droppers: {positions: [4, 13.5, '7 furlong', 30]}",
    "after letters of several bytes": "droppers: {positions: [4, 5 µm, 7 furlong]}",
}


@pytest.mark.parametrize("style", STYLES)
def test_styles(write: Write, example_text: str, style: str) -> None:
    assert ROW in example_text
    text = example_text.replace(ROW, STYLES[style])
    quote = {"double quotes": '"', "single quotes": "'"}.get(style, "")
    expected = (*place(text, f"{quote}7 furlong"), "spans[0].droppers.positions[2]")
    assert expected in places(write(text))


def test_an_aliased_value_stands_where_it_is_written(write: Write, example_text: str) -> None:
    text = example_text.replace("tail: 0.5 m   # ours\n", "tail: &h 2.4 N\n")
    text = text.replace("largest_element: 2.4 m", "largest_element: *h")
    assert text.count("*h") == 1
    fields = {field: mark for *mark, field in places(write(text))}
    assert set(fields) == {"messenger_wire.tail", "solver.mesh.largest_element"}
    assert [tuple(mark) for mark in fields.values()] == [place(text, "&h 2.4 N")] * 2


def test_what_is_missing_stands_at_what_lacks_it() -> None:
    source = Source("line.yaml", {(): (1, 1), ("spans",): (5, 3), ("spans", 0): (5, 5)}, {})
    assert source.mark(("spans", 0, "droppers", "count")) == (5, 5)
    assert source.mark(("spans", 1)) == (5, 3)
    assert Source().mark(("spans",)) == (0, 0)


def test_paths_read_like_python() -> None:
    assert format_path(("spans", 1, "droppers", "positions", 3)) == "spans[1].droppers.positions[3]"
    assert format_path(()) == "the file"
