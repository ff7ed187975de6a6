"""Errors of installation from a file of their own."""

from __future__ import annotations

from pathlib import Path

from catenaria.errors import Fault, LineFileError
from catenaria.line.installation import Installation
from catenaria.line.installation_checks import installation_problems
from catenaria.line.line import Line
from catenaria.line.load import load_model
from catenaria.line.reading import read_tree
from catenaria.line.source import format_path


def load_installation(path: str | Path, line: Line) -> Installation:
    """Read a file with errors of installation, the same as the section `installation` of a line file.

    Parameters
    ----------
    path : path
        A YAML or JSON file.
    line : Line
        The line whose droppers, supports and wires it names.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong.
    """
    found = load_model(path, Installation)
    problems = tuple(installation_problems(found, line))
    if problems:
        source = read_tree(Path(path))[1]
        raise LineFileError(
            tuple(
                Fault(source.file, *source.mark(p.path), format_path(p.path), f'"{p.found}"', p.allowed)
                for p in problems
            )
        )
    return found
