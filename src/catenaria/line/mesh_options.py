"""Another mesh for a line, from Python or from options of the command line."""

from __future__ import annotations

from collections.abc import Sequence

from pydantic import ValidationError

from catenaria.errors import Fault, LineFileError
from catenaria.line.base import closest
from catenaria.line.faults import faults_of, place_of
from catenaria.line.line import Line
from catenaria.line.reading import read_value
from catenaria.line.solver import Mesh
from catenaria.line.source import Source

_OPTION = "--mesh"
_NAMES = ", ".join(Mesh.model_fields)


def with_mesh(line: Line, mesh: Mesh) -> Line:
    """Return the line with some fields of its mesh replaced.

    Parameters
    ----------
    line : Line
        The line.
    mesh : Mesh
        The fields that were given when it was made replace those of the line; the others stay as they are.

    Returns
    -------
    Line
    """
    given = {name: getattr(mesh, name) for name in mesh.model_fields_set}
    merged = line.solver.mesh.model_copy(update=given)
    return line.model_copy(update={"solver": line.solver.model_copy(update={"mesh": merged})})


def read_mesh(options: Sequence[str]) -> Mesh:
    """Read texts like ``refine=2`` or ``largest_element=1.2 m``, checked as in a line file.

    Parameters
    ----------
    options : sequence of str
        A field of `Mesh` and its value as in YAML, each.

    Returns
    -------
    Mesh
        For `with_mesh`.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong.

    Examples
    --------
    >>> mesh = read_mesh(["refine=2", "fine=[10 cm, 0.3]"])
    >>> mesh.refine, mesh.fine
    (2, (0.1, 0.3))
    """
    tree: dict[str, object] = {}
    faults: list[Fault] = []
    for option in options:
        name, equals, text = (part.strip() for part in option.partition("="))
        if not equals or name not in Mesh.model_fields:
            meant = "" if name in Mesh.model_fields else closest(name, Mesh.model_fields)
            allowed = f"KEY=VALUE with one of the fields {_NAMES}{meant}"
            faults.append(_fault(name or "the option", repr(option), allowed))
        elif name in tree:
            faults.append(_fault(name, "the field a second time", "each field once"))
        else:
            tree[name] = read_value(text, text)
    if faults:
        raise LineFileError(tuple(faults))
    try:
        return Mesh.model_validate(tree)
    except ValidationError as error:
        problems = {place_of(problem): problem for problem in error.errors(include_url=False)}
        raise LineFileError(faults_of(problems, tree, Source(_OPTION))) from error


def _fault(field: str, found: str, allowed: str) -> Fault:
    return Fault(_OPTION, 0, 0, field, found, allowed)
