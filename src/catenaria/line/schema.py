"""JSON Schema of the line file."""

from __future__ import annotations

from typing import Any

from catenaria.line.line import Line


def schema() -> dict[str, Any]:
    """Describe the line file as JSON Schema (2020-12), for people and for editors.

    Returns
    -------
    dict
        With a title and a description for every field.

    Examples
    --------
    >>> schema()["properties"]["gravity"]["description"]
    'Acceleration of gravity.'
    """
    line = Line.model_json_schema()
    for model in (line, *line["$defs"].values()):
        model["description"] = model["description"].split("\n\n")[0].replace("\n", " ")
    line["title"] = "catenaria line file"
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **line}
