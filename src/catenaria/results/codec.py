"""Dataclasses of arrays and plain values, taken apart for storage and put together again.

The walk follows the type hints of the dataclass, in both directions, so a class needs no storage code of its
own. Arrays are collected under their dotted path (``wires.0.profile.x``) and leave their type and shape
behind; all else becomes what JSON can hold. What a hint does not allow, and every number that is not finite,
is refused by path.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar, cast, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError

Arrays = dict[str, NDArray[Any]]
Key = TypeVar("Key", bound=Hashable)


def encode(value: Any, hint: Any, path: str = "") -> tuple[Any, Arrays]:
    """Take a value apart into a tree that JSON can hold and the arrays that it cannot.

    Parameters
    ----------
    value : object
        A dataclass, array, tuple, dict, str, int, float or bool.
    hint : type
        What `value` is declared to be; ``Any`` stands for plain JSON values.
    path : str
        Dotted path of `value` within the whole, used as name of arrays and in messages.

    Returns
    -------
    tree : object
        Nested dicts, lists, strings and numbers.
    arrays : dict
        C-ordered arrays by path.

    Raises
    ------
    InconsistentInputError
        If the value is not of the declared type, or holds NaN or infinity.

    Examples
    --------
    >>> encode(("contact wire", "messenger wire"), tuple[str, ...], "wire")
    (['contact wire', 'messenger wire'], {})
    >>> tree, arrays = encode(np.array([0.0, 65.0]), NDArray[np.float64], "supports.x")
    >>> tree, list(arrays)
    ({'array': 'float64', 'shape': [2]}, ['supports.x'])
    """
    origin = get_origin(hint)
    if origin is np.ndarray:
        array = np.asarray(_checked_array(value, hint, path), order="C")
        return {"array": array.dtype.name, "shape": list(array.shape)}, {path: array}
    if is_dataclass(hint):
        _require(isinstance(value, cast(type, hint)), path, f"{_name(hint)} expected, found {_kind(value)}")
        hints = get_type_hints(hint)
        return _encode_items(((f.name, getattr(value, f.name), hints[f.name]) for f in fields(hint)), path)
    if origin is tuple:
        _require(isinstance(value, tuple), path, f"tuple expected, found {_kind(value)}")
        trees, arrays = _encode_items(((i, item, get_args(hint)[0]) for i, item in enumerate(value)), path)
        return list(trees.values()), arrays
    if origin is dict:
        _require(_is_str_dict(value), path, f"dict with text keys expected, found {_kind(value)}")
        return _encode_items(((key, item, get_args(hint)[1]) for key, item in value.items()), path)
    return _plain(value, hint, path), {}


def decode(tree: Any, hint: Any, arrays: Mapping[str, NDArray[Any]], path: str = "") -> Any:
    """Put together what `encode` took apart.

    Parameters
    ----------
    tree, arrays
        As returned by `encode`.
    hint : type
        What the value is declared to be.
    path : str
        Dotted path of the value within the whole.

    Returns
    -------
    object
        A value of the declared type; its arrays are read-only.

    Raises
    ------
    InconsistentInputError
        If the tree does not fit the declared type, or an array is missing or differs from what the tree says
        of it.

    Examples
    --------
    >>> decode(["S1", "S2"], tuple[str, ...], {})
    ('S1', 'S2')
    """
    origin = get_origin(hint)
    if origin is np.ndarray:
        return _decode_array(tree, hint, arrays, path)
    if is_dataclass(hint):
        _require(_is_str_dict(tree), path, f"a group of fields expected, found {_kind(tree)}")
        hints = get_type_hints(hint)
        names = [f.name for f in fields(hint)]
        _require(set(tree) == set(names), path, _field_difference(set(tree), set(names)))
        parts = {name: decode(tree[name], hints[name], arrays, _join(path, name)) for name in names}
        return cast(Any, hint)(**parts)
    if origin is tuple:
        _require(isinstance(tree, list), path, f"a list expected, found {_kind(tree)}")
        item_hint = get_args(hint)[0]
        return tuple(decode(item, item_hint, arrays, _join(path, i)) for i, item in enumerate(tree))
    if origin is dict:
        _require(_is_str_dict(tree), path, f"a group of fields expected, found {_kind(tree)}")
        return {key: decode(item, get_args(hint)[1], arrays, _join(path, key)) for key, item in tree.items()}
    return _plain(tree, hint, path)


def _encode_items(items: Iterable[tuple[Key, Any, Any]], path: str) -> tuple[dict[Key, Any], Arrays]:
    trees: dict[Key, Any] = {}
    arrays: Arrays = {}
    for key, value, hint in items:
        trees[key], found = encode(value, hint, _join(path, key))
        arrays |= found
    return trees, arrays


def _decode_array(tree: Any, hint: Any, arrays: Mapping[str, NDArray[Any]], path: str) -> NDArray[Any]:
    _require(path in arrays, path, "the array is missing")
    array = _checked_array(arrays[path], hint, path).copy()
    found = {"array": array.dtype.name, "shape": list(array.shape)}
    _require(tree == found, path, f"{tree} expected, found {found}")
    array.flags.writeable = False
    return array


def _checked_array(value: Any, hint: Any, path: str) -> NDArray[Any]:
    dtype = np.dtype(get_args(get_args(hint)[1])[0])
    _require(isinstance(value, np.ndarray), path, f"array of {dtype} expected, found {_kind(value)}")
    array = cast(NDArray[Any], value)
    _require(array.dtype == dtype, path, f"array of {dtype} expected, found array of {array.dtype}")
    _require(bool(np.isfinite(array).all()), path, "the array holds NaN or infinity")
    return array


def _plain(value: Any, hint: Any, path: str) -> Any:
    """Return a leaf as the plain Python type of its hint; ``Any`` stands for JSON values of any depth."""
    if hint is Any:
        return _plain_any(value, path)
    message = f"{_name(hint)} expected, found {_kind(value)}"
    if hint is bool or hint is str:
        _require(isinstance(value, hint), path, message)
        return value
    allowed = {int: (int, np.integer), float: (int, float, np.integer, np.floating)}.get(hint, ())
    _require(isinstance(value, cast(Any, allowed)) and not isinstance(value, bool), path, message)
    _require(hint is int or abs(value) <= sys.float_info.max, path, f"the value is {value}")
    return hint(value)


def _plain_any(value: Any, path: str) -> Any:
    if _is_str_dict(value):
        return {key: _plain_any(item, _join(path, key)) for key, item in value.items()}
    if isinstance(value, list):
        return [_plain_any(item, _join(path, i)) for i, item in enumerate(cast(list[Any], value))]
    plain = value is None or isinstance(value, str | bool | int | float)
    _require(plain, path, f"plain JSON value expected, found {_kind(value)}")
    _require(not isinstance(value, float) or math.isfinite(value), path, f"the value is {value}")
    return value


def _field_difference(found: set[str], expected: set[str]) -> str:
    missing, unknown = sorted(expected - found), sorted(found - expected)
    return f"fields differ from those of this version (missing: {missing}, unknown: {unknown})"


def _is_str_dict(value: Any) -> bool:
    return isinstance(value, dict) and all(isinstance(key, str) for key in cast(dict[Any, Any], value))


def _join(path: str, key: object) -> str:
    return f"{path}.{key}" if path else str(key)


def _name(hint: Any) -> str:
    return getattr(hint, "__name__", str(hint))


def _kind(value: object) -> str:
    return type(value).__name__


def _require(condition: bool, path: str, message: str) -> None:
    if not condition:
        raise InconsistentInputError(f"{path or 'result'}: {message}")
