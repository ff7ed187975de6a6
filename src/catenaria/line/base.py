"""What all parts of a line file share: frozen models that name unknown and forgotten fields plainly."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, cast

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Problem:
    """Something wrong at a place of the file.

    Parameters
    ----------
    path : tuple of str and int
        Where, relative to the model that found it.
    found : object
        What stands there.
    allowed : str
        What may stand there.
    kind : str
        What is wrong: an ``unknown field``, a ``missing`` one, or the ``value``.
    """

    path: Path
    found: object
    allowed: str
    kind: Literal["unknown field", "missing", "value"] = "value"


def refuse(title: str, problems: Iterable[Problem]) -> None:
    """Raise all problems at once, each at its own place; do nothing if there are none.

    Raises
    ------
    pydantic.ValidationError
        A validator that raises it hands each entry on with its place, where a plain ValueError could only say
        one thing about the whole model.
    """
    details = [
        InitErrorDetails(
            type=PydanticCustomError(problem.kind, "{allowed}", {"allowed": problem.allowed}),
            loc=problem.path,
            input=problem.found,
        )
        for problem in problems
    ]
    if details:
        raise ValidationError.from_exception_data(title, details)


def closest(word: str, words: Iterable[str]) -> str:
    """Ask whether the most similar of `words` was meant; empty if none is similar.

    Examples
    --------
    >>> closest("densty", ["density", "area"])
    ' (did you mean density?)'
    """
    matches = difflib.get_close_matches(word, list(words), n=1)
    return f" (did you mean {matches[0]}?)" if matches else ""


def _meant(field: str, fields: Iterable[str]) -> str:
    """Say what an unknown field was probably meant to be: ``{force: 15,5 kN}`` has one named ``5 kN``."""
    if field[:1].isdigit():
        return " (a comma ends the field before it: use a point for decimals)"
    return closest(field, fields)


def exactly_one(first: str, second: str) -> dict[str, Any]:
    """JSON Schema saying that one of two fields must be given."""
    given = [
        {"required": [name], "properties": {name: {"not": {"type": "null"}}}} for name in (first, second)
    ]
    return {"oneOf": given}


class LineModel(BaseModel):
    """A part of the line file: frozen, without unknown fields."""

    model_config: ClassVar[ConfigDict] = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _known_fields(cls, data: object) -> object:
        """Compare the names that stand in the file with those of the model, before values are looked at."""
        if isinstance(data, cls):
            return data
        names = ", ".join(cls.model_fields)
        if not isinstance(data, Mapping):
            raise PydanticCustomError("value", "{allowed}", {"allowed": f"a mapping with the fields {names}"})
        given = cast("Mapping[object, object]", data)
        problems = [
            Problem(
                (str(key),), key, f"the fields {names}{_meant(str(key), cls.model_fields)}", "unknown field"
            )
            for key in given
            if key not in cls.model_fields
        ]
        problems += [
            Problem((name,), None, f"a value, for this field is needed: {field.description}", "missing")
            for name, field in cls.model_fields.items()
            if field.is_required() and name not in given
        ]
        refuse(cls.__name__, problems)
        return given
