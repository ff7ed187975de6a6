"""Pydantic's findings in plain words, with the place in the file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final, cast

from pydantic_core import ErrorDetails

from catenaria.errors import Fault
from catenaria.line.base import Path, closest
from catenaria.line.source import Source, format_path

_PLAIN: Final = {
    "string_type": "a text; put quotes around a number that is one",
    "bool_type": "true or false",
    "int_type": "a whole number",
    "float_type": "a finite number",
    "float_parsing": "a finite number",
    "finite_number": "a finite number",
    "greater_than": "more than {gt:g}",
    "greater_than_equal": "{ge:g} or more",
    "less_than_equal": "{le:g} or less",
    "tuple_type": "a list",
    "too_short": "a list of {min_length} or more",
    "dict_type": "a mapping",
}


def faults_of(problems: Mapping[Path, ErrorDetails], tree: object, source: Source) -> tuple[Fault, ...]:
    """Describe each problem by what stands in the file and what may stand there.

    Parameters
    ----------
    problems : mapping of path to pydantic's description
        What is wrong.
    tree : object
        What stands in the file.
    source : Source
        Where it stands.

    Returns
    -------
    tuple of Fault
        In the order of the file. What YAML aliases repeat is one fault.
    """
    faults: dict[object, Fault] = {}
    for place, problem in problems.items():
        fault = _fault(place, problem, tree, source)
        where = (fault.line, fault.column, place[-1:]) if fault.line else place  # a mapping has no lines
        faults.setdefault((where, fault.found, fault.allowed), fault)
    return tuple(sorted(faults.values(), key=lambda fault: (fault.line, fault.column)))


def place_of(problem: ErrorDetails) -> Path:
    """Path in the file: pydantic's without the steps in brackets that are its own."""
    return tuple(step for step in problem["loc"] if not str(step).startswith("["))


def value_at(tree: object, place: Path) -> object:
    """What stands at a place of the file; None if there is nothing."""
    node: Any = tree
    for step in place:
        has_step = (isinstance(node, dict) and step in node) or (
            isinstance(node, list) and isinstance(step, int)
        )
        if not has_step:
            return None
        node = cast("Any", node)[step]
    return node


def _fault(place: Path, problem: ErrorDetails, tree: object, source: Source) -> Fault:
    unknown_field = problem["type"] == "unknown field"
    mark = source.keys.get(place) if unknown_field else None
    found = _describe(place[-1] if unknown_field else value_at(tree, place))
    return Fault(source.file, *(mark or source.mark(place)), format_path(place), found, _allowed(problem))


def _describe(value: object) -> str:
    """Say in a few words what stands in the file."""
    match value:
        case None:
            return "nothing"
        case bool():
            return str(value).lower()
        case str():
            return f'"{value if len(value) <= 60 else value[:57] + "..."}"'
        case dict():
            return "a mapping"
        case []:
            return "an empty list"
        case list():
            return f"a list of {len(cast('list[object]', value))}"
        case _:
            return str(value)


def _allowed(problem: ErrorDetails) -> str:
    """Translate pydantic's errors; those of the models already say what is allowed."""
    context, kind = problem.get("ctx", {}), problem["type"]
    if kind in ("quantity", "missing", "value", "unknown field"):
        return str(context["allowed"])
    if kind == "literal_error":
        names = str(context["expected"]).replace("'", "").replace(" or ", ", ").split(", ")
        return " or ".join(names) + closest(str(problem["input"]), names)
    return _PLAIN[kind].format(**context) if kind in _PLAIN else problem["msg"]
