"""What is described, with some of its values replaced."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar, cast

from catenaria.errors import InconsistentInputError, LineFileError
from catenaria.line.base import LineModel
from catenaria.line.load import model_from

Described = TypeVar("Described", bound=LineModel)


def vary(described: Described, change: Mapping[str, Any]) -> Described:
    """Return a copy in which some values are replaced, checked like what stands in a file.

    Parameters
    ----------
    described : Line or any part of one
        The original.
    change : mapping of str to object
        New values by dotted path, for example ``{"messenger_wire.tension.force": "15.5 kN"}``; a step into a
        list is a number, counted from 0.

    Raises
    ------
    InconsistentInputError
        If there is no such place, or a value does not fit.
    """
    data = described.model_dump(mode="json")
    for path, value in change.items():
        _replace(data, path.split("."), path, value)
    try:
        return model_from(data, type(described), type(described).__name__)
    except LineFileError as error:
        raise InconsistentInputError(f"the changed values do not fit: {error}") from error


def _replace(place: object, steps: list[str], path: str, value: object) -> None:
    step, *rest = steps
    if isinstance(place, dict) and step in place:
        key: Any = step
    elif isinstance(place, list) and step.isdigit() and int(step) < len(cast("list[object]", place)):
        key = int(step)
    else:
        raise InconsistentInputError(f"there is no {path} to be changed")
    parent = cast("dict[Any, object]", place)
    if rest:
        _replace(parent[key], rest, path, value)
    else:
        parent[key] = value
