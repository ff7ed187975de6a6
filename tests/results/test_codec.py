"""A value taken apart and put together is the same value, and what does not fit is refused by name."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.results.codec import decode, encode


@dataclass(frozen=True)
class Inner:
    values: NDArray[np.float64]
    counts: NDArray[np.int64]


@dataclass(frozen=True)
class Outer:
    name: str
    number: float
    whole: int
    flag: bool
    parts: tuple[Inner, ...]
    labels: dict[str, str]
    echo: dict[str, Any]


LIST: Any = [1.0]
WHOLE: Any = np.array([1])

finite = st.floats(allow_nan=False, allow_infinity=False)
shapes = hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4)
plain = st.recursive(
    st.none() | st.booleans() | st.integers() | finite | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)
inner = st.builds(Inner, hnp.arrays(np.float64, shapes, elements=finite), hnp.arrays(np.int64, shapes))
outer = st.builds(
    Outer,
    st.text(),
    finite,
    st.integers(),
    st.booleans(),
    st.lists(inner, max_size=3).map(tuple),
    st.dictionaries(st.text(), st.text(), max_size=3),
    st.dictionaries(st.text(), plain, max_size=3),
)


def one(**changes: Any) -> Outer:
    values: dict[str, Any] = {
        "name": "a",
        "number": 1.5,
        "whole": 2,
        "flag": True,
        "parts": (Inner(np.array([1.0, 2.0]), np.array([3], dtype=np.int64)),),
        "labels": {"b": "c"},
        "echo": {},
    }
    return Outer(**(values | changes))


@given(outer)
def test_round_trip_keeps_every_bit(value: Outer) -> None:
    back = decode(*_swap(encode(value, Outer)))
    plain_fields = ("name", "number", "whole", "flag", "labels", "echo")
    assert [repr(getattr(back, name)) for name in plain_fields] == [
        repr(getattr(value, name)) for name in plain_fields
    ]
    assert len(back.parts) == len(value.parts)
    for before, after in zip(value.parts, back.parts, strict=True):
        for name in ("values", "counts"):
            x, y = getattr(before, name), getattr(after, name)
            assert (x.dtype, x.shape, x.tobytes()) == (y.dtype, y.shape, y.tobytes())


def _swap(encoded: tuple[Any, Any]) -> tuple[Any, Any, Any]:
    return encoded[0], Outer, encoded[1]


def test_negative_zero_subnormal_and_empty_survive() -> None:
    array = np.array([-0.0, 5e-324, -2.2e-310, math.pi])
    value = one(number=-0.0, parts=(Inner(array, np.zeros((0, 4), dtype=np.int64)),))
    back = decode(*_swap(encode(value, Outer)))
    assert math.copysign(1.0, back.number) == -1.0
    assert back.parts[0].values.tobytes() == array.tobytes()
    assert back.parts[0].counts.shape == (0, 4)


def test_decoded_arrays_are_read_only_copies() -> None:
    value = one()
    part = decode(*_swap(encode(value, Outer))).parts[0]
    value.parts[0].values[0] = 99.0
    assert part.values[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        part.values[0] = 5.0


def test_numpy_scalars_become_plain_numbers() -> None:
    tree, _ = encode(one(number=np.float64(2.5), whole=np.int64(7)), Outer)
    assert (type(tree["number"]), type(tree["whole"])) == (float, int)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"number": math.nan}, "number: the value is nan"),
        ({"number": 10**400}, "number: the value is 1000"),
        ({"number": "1.5"}, "number: float expected, found str"),
        ({"number": True}, "number: float expected, found bool"),
        ({"whole": 1.5}, "whole: int expected, found float"),
        ({"name": 3}, "name: str expected, found int"),
        ({"flag": 1}, "flag: bool expected, found int"),
        ({"parts": []}, "parts: tuple expected, found list"),
        ({"parts": (None,)}, "parts.0: Inner expected, found NoneType"),
        ({"parts": (Inner(LIST, np.array([1])),)}, "parts.0.values: array of float64 expected, found list"),
        (
            {"parts": (Inner(WHOLE, WHOLE),)},
            "parts.0.values: array of float64 expected, found array of int64",
        ),
        ({"parts": (Inner(np.array([np.nan]), np.array([1])),)}, "parts.0.values: the array holds NaN"),
        ({"parts": (Inner(np.array([np.inf]), np.array([1])),)}, "parts.0.values: the array holds NaN"),
        ({"labels": {1: "a"}}, "labels: dict with text keys expected"),
        ({"echo": {"a": [1.0, {"b": math.inf}]}}, "echo.a.1.b: the value is inf"),
        ({"echo": {"a": (1, 2)}}, "echo.a: plain JSON value expected, found tuple"),
    ],
)
def test_what_does_not_fit_is_refused_by_name(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InconsistentInputError) as caught:
        encode(one(**changes), Outer)
    assert str(caught.value).startswith(message)


def test_the_unchanged_value_is_accepted() -> None:
    """Negative control of the refusals above."""
    tree, arrays = encode(one(), Outer)
    assert tree["parts"][0]["values"] == {"array": "float64", "shape": [2]}
    assert list(arrays) == ["parts.0.values", "parts.0.counts"]


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("number", "x", "number: float expected, found str"),
        ("whole", 1.0, "whole: int expected"),
        ("parts", {}, "parts: a list expected"),
        ("labels", [], "labels: a group of fields expected"),
        ("echo", 3, "echo: a group of fields expected"),
        ("extra", 3, r"result: fields differ .* unknown: \['extra'\]"),
    ],
)
def test_a_tree_that_does_not_fit_is_refused(path: str, value: Any, message: str) -> None:
    tree, arrays = encode(one(), Outer)
    with pytest.raises(InconsistentInputError, match=message):
        decode(tree | {path: value}, Outer, arrays)


def test_a_missing_field_and_a_missing_or_different_array_are_refused() -> None:
    tree, arrays = encode(one(), Outer)
    with pytest.raises(InconsistentInputError, match=r"missing: \['name'\]"):
        decode({key: item for key, item in tree.items() if key != "name"}, Outer, arrays)
    with pytest.raises(InconsistentInputError, match=r"parts\.0\.values: the array is missing"):
        decode(tree, Outer, {})
    with pytest.raises(InconsistentInputError, match=r"parts\.0\.values: .*\[2\].* expected, found .*\[3\]"):
        decode(tree, Outer, arrays | {"parts.0.values": np.zeros(3)})
