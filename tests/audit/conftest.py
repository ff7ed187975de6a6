"""The paper's three-span line as two methods find it, lines in space, and ways to corrupt all of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from catenaria.results import FormResult
from catenaria.workflow import solve

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"

Change = Callable[[Any], Any]


@pytest.fixture(scope="session")
def paper() -> FormResult:
    return solve(EXAMPLE, method="dynamic")


@pytest.fixture(scope="session")
def direct() -> FormResult:
    return solve(EXAMPLE, method="direct")


def put(whole: Any, path: list[str], change: Callable[[Any], Any]) -> Any:
    """Return a copy with the value at a path replaced by what the function makes of it."""
    if not path:
        return change(whole)
    name, *rest = path
    if isinstance(whole, tuple | list):
        items = list(whole)
        items[int(name)] = put(items[int(name)], rest, change)
        return type(whole)(items)
    if isinstance(whole, dict):
        return whole | {name: put(whole[name], rest, change)}
    return replace(whole, **{name: put(getattr(whole, name), rest, change)})


@pytest.fixture(scope="session")
def curve() -> FormResult:
    """A line in a canted curve with one of every kind of support."""
    return solve(Path(__file__).with_name("every_support.yaml"), method="direct")


@pytest.fixture(scope="session")
def compound() -> FormResult:
    """A straight line with two contact wires, an auxiliary messenger and mid-point anchors."""
    return solve(Path(__file__).with_name("compound.yaml"), method="direct")


@pytest.fixture(scope="session")
def altered() -> Callable[[FormResult, str, Change], FormResult]:
    """Change the value at a dotted path of a result; arrays come as copies."""

    def alter(result: FormResult, path: str, change: Change) -> FormResult:
        def on_copy(value: Any) -> Any:
            return change(value.copy() if isinstance(value, np.ndarray) else value)

        return put(result, path.split("."), on_copy)

    return alter


@pytest.fixture
def corrupted(
    paper: FormResult, altered: Callable[[FormResult, str, Change], FormResult]
) -> Callable[[str, Change], FormResult]:
    """Change the value at a dotted path of the paper's result."""

    def corrupt(path: str, change: Change) -> FormResult:
        return altered(paper, path, change)

    return corrupt
