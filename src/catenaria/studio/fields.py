"""Fields of forms: where each stands in a line file, its unit, and what is typed into it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, cast

from catenaria.errors import Fault
from catenaria.line.base import Path
from catenaria.line.dropper import Droppers
from catenaria.line.faults import value_at
from catenaria.line.load_units import TRAIN_SPEED
from catenaria.line.source import format_path
from catenaria.studio.documents import Tree, replaced
from catenaria.units import FORCE, LENGTH, Dimension, to_si

Kind = Literal["text", "quantity", "number", "list", "positions", "choice"]

_NUMBER: Final = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_LONGEST: Final = 200  # characters of a quantity
_DIMENSIONS: Final[dict[str, Dimension]] = {
    "m": LENGTH, "mm": LENGTH, "kN": FORCE, "N": FORCE, "km/h": TRAIN_SPEED,
}  # fmt: skip


@dataclass(frozen=True)
class Field:
    """One field of a form.

    Attributes
    ----------
    path : tuple of str and int
        Where its value stands.
    label : str
        What it is called.
    unit : str
        In which bare numbers are typed and shown; a text may name any other.
    kind : str
        How it is read.
    instead : path, optional
        A field that says the same and is taken away when this one is given.
    choices : tuple of str
        What may be chosen, or is proposed.
    hint : str
        What holds while nothing is given.
    alike : bool
        Whether all rows of a table may well have the same.
    """

    path: Path
    label: str
    unit: str = ""
    kind: Kind = "quantity"
    instead: Path | None = None
    choices: tuple[str, ...] = ()
    hint: str = ""
    alike: bool = True

    @property
    def name(self) -> str:
        """The path as faults write it."""
        return format_path(self.path)


def shown(field: Field, tree: Tree) -> str:
    """Return what a field shows: numbers in its unit, and what cannot be read as it stands.

    Examples
    --------
    >>> stagger = Field(("stagger",), "stagger", "mm")
    >>> shown(stagger, {"stagger": "0.2 m"}), shown(stagger, {"stagger": "20 kg"}), shown(stagger, {})
    ('200', '20 kg', '')
    """
    value = value_at(tree, field.path)
    if field.kind == "positions":
        return _positions_shown(field, value)
    if isinstance(value, list):
        return ", ".join(_shown(item, field.unit) for item in cast("list[object]", value))
    return _shown(value, field.unit)


def entered(field: Field, tree: Tree, text: str) -> Tree:
    """Return the line with what was typed into a field; nothing takes the field away.

    Examples
    --------
    >>> entered(Field(("stagger",), "stagger", "mm"), {}, "-200")
    {'stagger': '-200 mm'}
    >>> entered(Field(("length",), "length", "m"), {"length": "65 m"}, "60")
    {'length': '60 m'}
    >>> entered(Field(("stagger",), "stagger", "mm"), {}, "0.2 m")
    {'stagger': '0.2 m'}
    """
    text, old = text.strip(), value_at(tree, field.path)
    if not text:
        return replaced(tree, field.path, None)
    if field.instead is not None and value_at(tree, field.instead) is not None:
        tree = replaced(tree, field.instead, None)
    return replaced(tree, field.path, _read(field, text, _says_unit(old)))


def filled(column: Sequence[Field], tree: Tree) -> Tree:
    """Return the line with the value of a table's first row in all rows; nothing takes the fields away.

    Examples
    --------
    >>> column = [Field(("spans", i, "length"), "length", "m") for i in range(3)]
    >>> filled(column, {"spans": [{"length": "58 m"}, {"length": 65}, {}]})
    {'spans': [{'length': '58 m'}, {'length': '58 m'}, {'length': '58 m'}]}
    """
    value = value_at(tree, column[0].path)
    for field in column[1:]:
        if value is not None and field.instead is not None and value_at(tree, field.instead) is not None:
            tree = replaced(tree, field.instead, None)
        tree = replaced(tree, field.path, value)
    return tree


def message(field: Field, faults: Sequence[Fault]) -> str:
    """Return what is wrong with a field or with something in it, as the line file's faults say it."""
    own = [fault for fault in faults if _belongs(fault, field)]
    return "; ".join(dict.fromkeys(f"found {fault.found}; allowed: {fault.allowed}" for fault in own))


def unplaced(fields: Sequence[Field], faults: Sequence[Fault]) -> list[Fault]:
    """Return the faults that no field shows."""
    return [fault for fault in faults if not any(_belongs(fault, field) for field in fields)]


def _belongs(fault: Fault, field: Field) -> bool:
    """Return whether a fault is of a field, of something in it, or of a missing part that it would begin."""
    if fault.found == "nothing" and field.name.startswith(f"{fault.field}."):
        return True
    return fault.field == field.name or fault.field.startswith((f"{field.name}.", f"{field.name}["))


def _shown(value: object, unit: str) -> str:
    if value is None:
        return ""
    if isinstance(value, bool) or unit not in _DIMENSIONS or _is_long(value):
        return str(value)
    dimension = _DIMENSIONS[unit]
    try:
        return f"{to_si(value, dimension) / to_si(f'1 {unit}', dimension):.10g}"
    except ValueError:
        return str(value)


def _is_long(value: object) -> bool:
    """Return whether a text is too long for a quantity: reading a unit of many factors takes seconds."""
    return isinstance(value, str) and len(value) > _LONGEST


def _positions_shown(field: Field, value: object) -> str:
    try:
        positions: Sequence[Any] = Droppers.model_validate(value).x if value is not None else ()
    except (ValueError, RecursionError):  # which a unit of hundreds of factors leads to
        given = value_at(value, ("positions",))
        positions = cast("list[Any]", given) if isinstance(given, list) else [given or value]
    return ", ".join(_shown(position, field.unit) for position in positions)


def _says_unit(value: object) -> bool:
    """Return whether a quantity, or any in it, is written with its unit."""
    if isinstance(value, dict):
        return any(map(_says_unit, cast("dict[object, object]", value).values()))
    if isinstance(value, list):
        return any(map(_says_unit, cast("list[object]", value)))
    return isinstance(value, str)


def _read(field: Field, text: str, says_unit: bool) -> object:
    if field.kind == "positions":
        return {"positions": [_value(item, field.unit, says_unit) for item in _items(text)]}
    if field.kind == "list" and len(_items(text)) > 1:
        return [_value(item, field.unit, says_unit) for item in _items(text)]
    if field.kind == "number":
        return float(text) if _NUMBER.fullmatch(text) else text
    return _value(text, field.unit, says_unit)


def _items(text: str) -> list[str]:
    return [item for item in re.split(r"\s*[,;]\s*", text) if item]


def _value(text: str, unit: str, says_unit: bool) -> object:
    """Return what the line file shall hold: metres as numbers unless it says them, others with their unit."""
    if not unit or not _NUMBER.fullmatch(text):
        return text
    return float(text) if unit == "m" and not says_unit else f"{text} {unit}"
