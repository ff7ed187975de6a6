"""The stable names: the same everywhere, found late, and none that hides a builtin."""

from __future__ import annotations

import ast
import builtins
import doctest
import json
import subprocess
import sys
from pathlib import Path

import pytest

import catenaria
from catenaria import api

PACKAGE = Path(catenaria.__file__).parent
HEAVY = {"numpy", "scipy", "numba", "pydantic", "pandas", "matplotlib", "catenaria.api", "catenaria.errors"}


def names_in_stub(text: str) -> tuple[set[str], list[str]]:
    """Return the names that a stub imports, and its `__all__`."""
    imported: set[str] = set()
    listed: list[str] = []
    for node in ast.parse(text).body:
        if isinstance(node, ast.ImportFrom):
            imported |= {alias.asname or alias.name for alias in node.names}
        elif isinstance(node, ast.Assign):
            listed = ast.literal_eval(node.value)
    return imported, listed


def imported_by(statement: str) -> tuple[set[str], float]:
    """Return which modules a statement imports in a new interpreter, and its time [s]."""
    program = (
        "import json, sys, time; begin = time.perf_counter()\n"
        f"{statement}\n"
        "end = time.perf_counter(); print(json.dumps([list(sys.modules), end - begin]))"
    )
    run = subprocess.run(
        [sys.executable, "-c", program],
        env={"PYTHONPATH": str(PACKAGE.parent), "PATH": ""},
        capture_output=True,
        text=True,
        check=True,
    )
    modules, seconds = json.loads(run.stdout)
    return set(modules), seconds


def test_package_stub_and_home_have_the_same_names() -> None:
    imported, listed = names_in_stub((PACKAGE / "__init__.pyi").read_text(encoding="utf-8"))
    assert imported == set(listed) == set(catenaria.__all__) == set(api.__all__)
    assert set(dir(catenaria)) == {*catenaria.__all__, "__version__"}


def test_a_stub_that_lacks_a_name_is_noticed() -> None:
    text = (PACKAGE / "__init__.pyi").read_text(encoding="utf-8").replace("    solve,\n", "", 1)
    imported, listed = names_in_stub(text)
    assert imported != set(listed)


@pytest.mark.parametrize("name", catenaria.__all__)
def test_every_name_is_there_and_documented(name: str) -> None:
    value = getattr(catenaria, name)
    assert value is getattr(api, name)
    assert isinstance(value, tuple) or value.__doc__
    assert not hasattr(builtins, name)


def test_what_is_not_there() -> None:
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        catenaria.nothing  # noqa: B018  # pyright: ignore[reportAttributeAccessIssue]


def test_everything_can_be_imported_by_a_star() -> None:
    scope: dict[str, object] = {}
    exec("from catenaria import *", scope)
    assert set(catenaria.__all__) < set(scope)


def test_the_import_is_fast_and_imports_nothing() -> None:
    modules, seconds = imported_by("import catenaria")
    assert modules.isdisjoint(HEAVY)
    assert seconds < 0.05


def test_a_name_is_imported_when_it_is_used() -> None:
    modules, _ = imported_by("import catenaria; catenaria.solve")
    assert {"catenaria.api", "numpy"} <= modules
    assert modules.isdisjoint({"matplotlib", "pandas"})


def test_the_command_does_not_import_them() -> None:
    modules, _ = imported_by("import catenaria.cli.main")
    assert "catenaria.api" not in modules


def test_type_checkers_are_told() -> None:
    assert (PACKAGE / "py.typed").exists()


def test_the_example_of_the_package_runs() -> None:
    outcome = doctest.testmod(catenaria)
    assert (outcome.failed, outcome.attempted) == (0, 3)
