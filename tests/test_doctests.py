"""Every example in a docstring of the package runs and prints what it says."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

import catenaria

MODULES = sorted(module.name for module in pkgutil.walk_packages(catenaria.__path__, "catenaria."))
OPTIONS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def failures(module: object, options: int = OPTIONS) -> tuple[int, int]:
    """Return how many examples of a module failed and how many there are."""
    outcome = doctest.testmod(module, optionflags=options)  # pyright: ignore[reportArgumentType]
    return outcome.failed, outcome.attempted


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_module(name: str) -> None:
    failed, _ = failures(importlib.import_module(name))
    assert failed == 0


def test_there_are_examples() -> None:
    found = [test for name in MODULES for test in doctest.DocTestFinder().find(importlib.import_module(name))]
    assert sum(len(test.examples) for test in found) > 35


def test_a_wrong_example_fails(capsys: pytest.CaptureFixture[str]) -> None:
    module = type(catenaria)("wrong")
    module.__doc__ = ">>> 1 + 1\n3\n"
    assert failures(module) == (1, 1)
    assert "Expected" in capsys.readouterr().out
