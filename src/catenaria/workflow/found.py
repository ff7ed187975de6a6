"""A line and where it was found, from whatever a study is asked of."""

from __future__ import annotations

import os
from pathlib import Path

from catenaria.line import Line, load_line
from catenaria.results import FormResult, load_result
from catenaria.workflow.solve import solve

RESULT_NAME = "result.json"


def found(source: FormResult | Line | str | os.PathLike[str]) -> tuple[Line, FormResult]:
    """Return a line and where it was found, from a result, its folder, a line or a line file."""
    if isinstance(source, FormResult):
        return Line.model_validate(source.inputs), source
    if isinstance(source, Line):
        return source, solve(source)
    path = Path(source)
    if path.is_dir() or path.name == RESULT_NAME:
        result = load_result(path)
        return Line.model_validate(result.inputs), result
    line = load_line(path)
    return line, solve(line)
