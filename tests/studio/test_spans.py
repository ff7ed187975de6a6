"""Spans that are added and taken away: lines stay lines."""

from __future__ import annotations

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.studio.documents import EXAMPLES, Document, Tree, example
from catenaria.studio.limits import MOST_ROWS
from catenaria.studio.solve import solved
from catenaria.studio.spans import span_count, with_span_after, without_span


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("index", [0, 1, -1])
def test_a_line_can_grow_and_shrink_anywhere(name: str, index: int) -> None:
    document = example(name)
    count = span_count(document.tree)
    at = index % count
    longer = with_span_after(document.tree, at)
    assert (len(longer["spans"]), len(longer["supports"])) == (count + 1, count + 2)
    assert longer["supports"][-1] == document.tree["supports"][-1]
    assert longer["supports"][0] == document.tree["supports"][0]
    shorter = without_span(longer, at)
    assert (len(shorter["spans"]), len(shorter["supports"])) == (count, count + 1)
    assert span_count(document.tree) == count


def test_a_longer_line_is_solved(paper: Document) -> None:
    longer = solved(Document("longer", with_span_after(paper.tree, 1))).result
    assert longer is not None
    assert sorted(set(longer.droppers.span.tolist())) == [1, 2, 3, 4]


def test_the_only_span_stays(paper: Document) -> None:
    tree = without_span(without_span(paper.tree, 2), 0)
    assert span_count(tree) == 1
    with pytest.raises(InconsistentInputError, match="only span"):
        without_span(tree, 0)


@pytest.mark.parametrize("tree", [{}, {"spans": [{}], "supports": [{}]}, {"spans": "none", "supports": 7}])
def test_spans_need_supports(tree: dict[str, object]) -> None:
    for change in (with_span_after, without_span):
        with pytest.raises(InconsistentInputError, match="support at either end"):
            change(tree, 0)


def test_a_line_with_too_few_supports_can_still_be_repaired() -> None:
    tree = {"spans": [{}, {}, {}], "supports": [{"name": "A"}, {"name": "B"}]}
    assert without_span(tree, 2)["supports"] == [{"name": "B"}]


def test_a_table_does_not_grow_without_end() -> None:
    def line(supports: int) -> Tree:
        return {"spans": [{}] * (supports - 1), "supports": [{}] * supports}

    assert span_count(with_span_after(line(MOST_ROWS - 1), 0)) == MOST_ROWS - 1
    with pytest.raises(InconsistentInputError, match=str(MOST_ROWS)):
        with_span_after(line(MOST_ROWS), 0)
