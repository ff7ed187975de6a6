"""From a file to a `Line`, or to a list of everything that is wrong with the file."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import Any, TypeVar, cast

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from catenaria.errors import LineFileError, UnsupportedError
from catenaria.line.base import LineModel, Path
from catenaria.line.faults import faults_of, place_of, value_at
from catenaria.line.line import Line
from catenaria.line.reading import read_tree
from catenaria.line.source import Source
from catenaria.units import UNKNOWN

Model = TypeVar("Model", bound=LineModel)


def load_line(path: str | FilePath) -> Line:
    """Read and check a line file.

    Parameters
    ----------
    path : str or pathlib.Path
        A YAML file, or a JSON file with the suffix ``.json``.

    Returns
    -------
    Line
        With every quantity in SI.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong, in the order of the file.
    UnsupportedError
        If the file describes a free structure.
    """
    return load_model(path, Line)


def load_model(path: str | FilePath, model: type[Model]) -> Model:
    """Read and check a file that describes a line or anything else that is made of the same kind of models.

    Parameters
    ----------
    path : str or pathlib.Path
        A YAML file, or a JSON file with the suffix ``.json``.
    model : type
        What it describes.

    Returns
    -------
    Model
        With every quantity in SI; its validation has had the `Source` as context.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong, in the order of the file.
    """
    tree, source = read_tree(FilePath(path))
    return _checked(tree, model, source)


def model_from(fields: Mapping[str, object], model: type[Model], name: str = "mapping") -> Model:
    """Check what would stand in a file, given as a mapping.

    Parameters
    ----------
    fields : mapping of str to object
        Dictionaries, lists, texts and numbers, as a file would hold them.
    model : type
        What they describe.
    name : str
        What faults call the mapping.

    Returns
    -------
    Model
        With every quantity in SI.

    Raises
    ------
    LineFileError
        With one `Fault` for each thing that is wrong, without lines and columns.

    Examples
    --------
    >>> from catenaria.line.tension import Tension
    >>> model_from({"force": "15 kN"}, Tension).force
    15000.0
    """
    return _checked(dict(fields), model, Source(name))


def _checked(tree: object, model: type[Model], source: Source) -> Model:
    try:
        return model.model_validate(tree, context=source)
    except ValidationError as error:
        problems = _all_problems(model, tree, error)
    if model is Line and _is_structure(tree):
        raise UnsupportedError(
            f"{source.file} describes a free structure, not a line: "
            "catenaria.workflow.solve_structure solves it"
        )
    raise LineFileError(faults_of(problems, tree, source))


def _is_structure(tree: object) -> bool:
    return isinstance(tree, dict) and {"cables", "sections"} <= tree.keys()


def _all_problems(model: type[LineModel], tree: object, error: ValidationError) -> dict[Path, ErrorDetails]:
    """Collect the problems behind the problems.

    What does not fit together is found only where the parts are right. Values whose fault is known are
    therefore replaced by an unknown that fits wherever a quantity does, and the rest is checked again until
    nothing new appears.
    """
    tree = copy.deepcopy(tree)
    problems: dict[Path, ErrorDetails] = {}
    while True:
        found = {place_of(problem): problem for problem in error.errors(include_url=False)}
        new = {place: problem for place, problem in found.items() if not _is_known(place, problems)}
        if not new:
            return problems
        problems |= new
        for place, problem in new.items():
            _neutralise(tree, place, problem["type"])
        try:
            model.model_validate(tree)
        except ValidationError as behind:
            error = behind
        else:
            return problems


def _is_known(place: Path, problems: dict[Path, ErrorDetails]) -> bool:
    return any(place[:depth] in problems for depth in range(len(place) + 1))


def _neutralise(tree: object, place: Path, kind: str) -> None:
    """Put an unknown in the place of a faulty value, or take away what has a default."""
    if not place:
        return
    parent = value_at(tree, place[:-1])
    key: Any = place[-1]
    if isinstance(parent, dict) and kind not in ("quantity", "missing", "value"):
        cast("dict[str, object]", parent).pop(key, None)
    elif isinstance(parent, dict | list):
        cast("dict[str, object]", parent)[key] = UNKNOWN
