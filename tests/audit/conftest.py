"""The paper's three-span line as two methods find it, and ways to corrupt it."""

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


@pytest.fixture
def corrupted(paper: FormResult) -> Callable[[str, Callable[[Any], Any]], FormResult]:
    """Change the value at a dotted path of the paper's result; arrays come as copies."""

    def corrupt(path: str, change: Callable[[Any], Any]) -> FormResult:
        def on_copy(value: Any) -> Any:
            return change(value.copy() if isinstance(value, np.ndarray) else value)

        return put(paper, path.split("."), on_copy)

    return corrupt
