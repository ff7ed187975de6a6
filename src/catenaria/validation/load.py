"""The cases that come with the package, and the example files that they compute."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from pydantic import ValidationError

from catenaria.errors import InconsistentInputError
from catenaria.line.base import closest
from catenaria.line.reading import read_tree
from catenaria.validation.case import Case

_PACKAGE = Path(str(files("catenaria")))
CASES = _PACKAGE / "validation" / "cases"

# Where examples are: an installed package brings them along, in a checkout they stand beside the sources.
FOLDERS = (_PACKAGE / "examples", _PACKAGE.parents[1] / "examples")


def case_names() -> tuple[str, ...]:
    """Return the names of all cases.

    Examples
    --------
    >>> "three_spans" in case_names()
    True
    """
    return tuple(sorted(path.stem for path in CASES.glob("*.yaml")))


def load_case(name: str) -> Case:
    """Read a case.

    Parameters
    ----------
    name : str
        One of `case_names`.

    Raises
    ------
    InconsistentInputError
        If there is no such case, or it contradicts itself.

    Examples
    --------
    >>> load_case("three_spans").runs["direct"].file
    'yang2017_three_span.yaml'
    """
    names = case_names()
    if name not in names:
        raise InconsistentInputError(
            f"there is no case {name!r}{closest(name, names)}; there is {', '.join(names)}"
        )
    return read_case(CASES / f"{name}.yaml")


def read_case(path: Path) -> Case:
    """Read the file of a case.

    Raises
    ------
    InconsistentInputError
        If it contradicts itself.
    """
    tree, _ = read_tree(path)
    try:
        return Case.model_validate(tree)
    except ValidationError as error:
        raise InconsistentInputError(f"{path}: {error}") from error


def example_file(name: str) -> Path:
    """Return the path of an example that comes with the package.

    Raises
    ------
    InconsistentInputError
        If there is no such example.
    """
    for folder in FOLDERS:
        if (folder / name).is_file():
            return folder / name
    raise InconsistentInputError(f"there is no example {name}")
