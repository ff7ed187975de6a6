"""The JSON Schema of exported tables, which explains every column."""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any, Final

from catenaria.export.tables_json import EXPORTED, FORMAT, VERSION

_UNITS: Final = {
    "_per_m": "1/m",
    "_Nm": "N m",
    "_mm": "mm",
    "_m": "m",
    "_N": "N",
    "_kg": "kg",
    "_degC": "degrees Celsius",
    "_deg": "degrees",
}
_KINDS: Final[dict[str, dict[str, Any]]] = {
    "text": {"type": "string"},
    "count": {"type": "integer", "minimum": 1},
    "mask": {"type": "boolean"},
}


def tables_schema() -> dict[str, Any]:
    """Return the JSON Schema (draft 2020-12) of what `write_tables_json` writes.

    Examples
    --------
    >>> schema = tables_schema()
    >>> length = schema["properties"]["tables"]["properties"]["droppers"]["properties"]["cut_length_m"]
    >>> length["description"]
    'Unstressed length less what the clamps bridge. In m.'
    >>> length["items"]
    {'type': ['number', 'null']}
    """
    text = files("catenaria.export").joinpath("columns.json").read_text(encoding="utf-8")
    described: dict[str, Any] = json.loads(text)
    tables = {name: _table(described["tables"][name], described) for name in EXPORTED}
    verdict = _object(
        {
            "done": {"type": "boolean", "description": "Whether there was one."},
            "passed": {"type": "boolean", "description": "Whether nothing was wrong."},
            "findings": {"type": "array", "items": {"type": "string"}, "description": "What was wrong."},
        },
        "The audit of forces and lengths, or the rebuild from the found lengths.",
    )
    fields: dict[str, Any] = {
        "format": {"const": FORMAT},
        "version": {"const": VERSION},
        "line": {"type": "string", "description": "Name of the line."},
        "method": {"type": "string", "description": "How its form was found."},
        "stop_reason": {"type": "string", "description": "Why the computation ended."},
        "versions": {
            "type": "object",
            "additionalProperties": {"type": "string"},
            "description": "Of catenaria and the libraries that it computed with.",
        },
        "audit": verdict,
        "rebuilt": verdict,
        "tables": _object(tables, "All tables, as columns of equal length."),
    }
    head = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Tables of a catenaria result",
    }
    return head | _object(
        fields, "What was found for an overhead contact line, in SI units; angles in degrees."
    )


def _object(properties: dict[str, Any], description: str) -> dict[str, Any]:
    return {
        "type": "object",
        "description": description,
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
    }


def _table(table: dict[str, Any], described: dict[str, Any]) -> dict[str, Any]:
    columns = {
        name: _column(name, text or described["common"][name]) for name, text in table["columns"].items()
    }
    return _object(columns, table["description"])


def _column(name: str, text: str) -> dict[str, Any]:
    """Return the schema of a column; its text begins with its kind unless it holds numbers."""
    kind, _, rest = text.partition(": ")
    if kind in _KINDS:
        return {"type": "array", "description": rest, "items": _KINDS[kind]}
    unit = next((f" In {unit}." for suffix, unit in _UNITS.items() if name.endswith(suffix)), "")
    return {"type": "array", "description": text + unit, "items": {"type": ["number", "null"]}}
