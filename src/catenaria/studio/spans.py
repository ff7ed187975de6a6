"""Spans to add and to take away, each with the support behind it."""

from __future__ import annotations

from typing import Any, cast

from catenaria.errors import InconsistentInputError
from catenaria.studio.documents import Tree
from catenaria.studio.limits import MOST_ROWS


def span_count(tree: Tree) -> int:
    """Return the number of spans, 0 if there is no list of them."""
    return len(_listed(tree, "spans"))


def with_span_after(tree: Tree, index: int) -> Tree:
    """Return the line with a span like this one behind it, and a support like the one before it.

    The supports at the ends of the line stay there.

    Raises
    ------
    InconsistentInputError
        If the line has no supports at its ends, or as many as the studio takes.

    Examples
    --------
    >>> line = {"spans": [{"length": 60}, {"length": 50}], "supports": [{"name": n} for n in "ABC"]}
    >>> [support.get("name") for support in with_span_after(line, 1)["supports"]]
    ['A', 'B', None, 'C']
    """
    spans, supports = _parts(tree)
    if len(supports) >= MOST_ROWS:
        raise InconsistentInputError(f"the studio takes {MOST_ROWS} spans and supports at most")
    model = supports[min(max(index, 1), len(supports) - 1)]
    if isinstance(model, dict):
        fields = cast("dict[str, object]", model)
        model = {key: value for key, value in fields.items() if key != "name"}
    spans.insert(index + 1, spans[index])
    supports.insert(index + 1, model)
    return tree | {"spans": spans, "supports": supports}


def without_span(tree: Tree, index: int) -> Tree:
    """Return the line without a span and the support behind it, or before the last one.

    Raises
    ------
    InconsistentInputError
        If it is the only one, or the line has no supports at its ends.
    """
    spans, supports = _parts(tree)
    if len(spans) < 2:
        raise InconsistentInputError("the only span cannot be taken away")
    del spans[index]
    del supports[min(index + 1, len(supports) - 2)]
    return tree | {"spans": spans, "supports": supports}


def _parts(tree: Tree) -> tuple[list[Any], list[Any]]:
    spans, supports = _listed(tree, "spans"), _listed(tree, "supports")
    if len(supports) < 2:
        raise InconsistentInputError("the line needs a support at either end first")
    return spans, supports


def _listed(tree: Tree, field: str) -> list[Any]:
    value = tree.get(field)
    return list(cast("list[Any]", value)) if isinstance(value, list) else []
