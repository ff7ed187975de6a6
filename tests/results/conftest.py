"""A small result with something in every field, built from the type hints so that new fields are covered."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from itertools import count
from typing import Any, cast, get_args, get_origin, get_type_hints

import numpy as np
import pytest

from catenaria.results import FormResult


def fill(hint: Any, counter: count[int]) -> Any:
    """Make a value of the hinted type; no two numbers or texts in the whole are equal."""
    if get_origin(hint) is np.ndarray:
        dtype = get_args(get_args(hint)[1])[0]
        return np.array([next(counter), next(counter), next(counter)]).astype(dtype)
    if is_dataclass(hint):
        hints = get_type_hints(hint)
        return cast(Any, hint)(**{field.name: fill(hints[field.name], counter) for field in fields(hint)})
    if get_origin(hint) is tuple:
        return tuple(fill(get_args(hint)[0], counter) for _ in range(2))
    if get_origin(hint) is dict:
        return {f"key {i}": fill(get_args(hint)[1], counter) for i in range(2)}
    if hint is Any:
        return {"list": [next(counter), 0.1, True, None, "text"], "name": "Ölfjord"}
    return f"text {next(counter)}" if hint is str else hint(next(counter))


@pytest.fixture
def result() -> FormResult:
    return fill(FormResult, count(1))
