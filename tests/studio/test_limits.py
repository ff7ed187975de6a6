"""Lines that are too large for the studio."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import numpy as np
import pytest

from catenaria import workflow
from catenaria.errors import LineFileError, UnsupportedError
from catenaria.line import Line
from catenaria.line.load import model_from
from catenaria.studio import solve
from catenaria.studio.documents import EXAMPLES, Document, example, replaced, uploaded
from catenaria.studio.limits import (
    AT_ONCE,
    MOST_ELEMENTS,
    MOST_MARKS,
    MOST_ROWS,
    element_bound,
    refuse_long_tables,
    refuse_long_waits,
    refuse_slow_text,
)
from catenaria.studio.solve import LatestWins, outcomes


def line_of(document: Document) -> Line:
    return model_from(document.tree, Line, document.name)


@pytest.mark.parametrize("name", ["yang2017_three_span", "curve_800m", "compound", "two_contact_wires_3kv"])
def test_the_bound_is_above_the_elements_that_there_are(name: str) -> None:
    line = line_of(example(name))
    form = workflow.find(line)
    wires = {wire.name for wire in form.wires}
    count = sum(
        int(nodes) - 1
        for stage in form.stages
        for chain, nodes in zip(stage.chain, stage.node_count.tolist(), strict=True)
        if chain in wires
    )
    assert 0.9 * count < element_bound(line) < 4 * count


def test_examples_are_far_from_the_limit() -> None:
    assert max(element_bound(line_of(example(name))) for name in EXAMPLES) < 0.2 * MOST_ELEMENTS


@pytest.mark.parametrize("field", ["refine", "even"])
def test_a_mesh_that_takes_minutes_is_refused_before_anything_is_computed(
    paper: Document, field: str
) -> None:
    tree = replaced(paper.tree, ("solver", "mesh", field), 10**9)
    with pytest.raises(UnsupportedError, match="catenaria solve"):
        refuse_long_waits(line_of(Document("large", tree)))
    (outcome,) = outcomes(Document("large", tree))
    assert outcome.result is None
    assert "elements" in outcome.message


def test_many_droppers_are_counted(paper: Document) -> None:
    positions = np.linspace(1.0, 64.0, 1000).round(4).tolist()
    tree = paper.tree
    for i in range(3):
        tree = replaced(tree, ("spans", i, "droppers"), {"positions": positions})
        tree = replaced(tree, ("spans", i, "contact_wire_height"), None)
    assert element_bound(line_of(Document("dense", tree))) > 3 * 1000


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a: 0x" + "f" * 6000, "6002 digits"),
        ("%YAML 1.1\n---\na: 1" + ":1" * 5000, "10001 digits"),
        ("a: 1." + "1" * 5000, "5002 digits"),
        ("a: [" + "1," * MOST_MARKS + "1]", f"{MOST_MARKS + 1} commas"),
        ("a: 1\n" * (MOST_MARKS // 2 + 1), "commas, colons and lines"),
    ],
)
def test_a_text_that_takes_long_to_read_is_refused_before_it_is_read(text: str, found: str) -> None:
    began = time.perf_counter()
    with pytest.raises(LineFileError, match=found):
        uploaded("line.yaml", text.encode())
    with pytest.raises(LineFileError, match=found):
        Document("line", {}).rewritten(text)
    assert time.perf_counter() - began < 10.0  # reading them takes from half a minute to minutes


@pytest.mark.parametrize(
    "text", ["a: 0x" + "f" * 900, "a: [" + "1," * 5000 + "1]", "# " + "-" * 5000 + "\n", "a: " + "x" * 5000]
)
def test_other_texts_are_not(text: str) -> None:
    refuse_slow_text(text, "line.yaml")


def test_the_place_of_a_long_number_is_told() -> None:
    with pytest.raises(LineFileError) as caught:
        refuse_slow_text("a: 1\nb: 0x" + "f" * 6000, "line.yaml")
    (fault,) = caught.value.faults
    assert (fault.file, fault.line, fault.column) == ("line.yaml", 2, 4)


def test_examples_are_read() -> None:
    for name in EXAMPLES:
        document = example(name)
        assert document.rewritten(document.text).tree == document.tree


def test_tables_that_no_page_takes_are_refused() -> None:
    refuse_long_tables({"spans": [{}] * MOST_ROWS, "supports": 3}, "line.yaml")
    rows = ", ".join(["*s"] * MOST_ROWS)
    with pytest.raises(LineFileError, match="catenaria solve"):
        uploaded("line.yaml", f"spans: [&s {{length: 60}}, {rows}]".encode())


@pytest.mark.parametrize("bounded", [True, False])
def test_pages_share_a_bounded_number_of_computations(bounded: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    if not bounded:
        monkeypatch.setattr(solve, "SOLVING", threading.Semaphore(4 * AT_ONCE))
    most, now, lock, ended = [0], [0], threading.Lock(), threading.Semaphore(0)

    def work(item: int) -> Iterator[int]:
        with lock:
            now[0] += 1
            most[0] = max(most[0], now[0])
        time.sleep(0.2)
        with lock:
            now[0] -= 1
        yield item

    for page in range(4 * AT_ONCE):
        LatestWins(work, lambda _: ended.release()).submit(page)
    assert all(ended.acquire(timeout=10.0) for _ in range(4 * AT_ONCE))
    assert (most[0] == AT_ONCE) is bounded
