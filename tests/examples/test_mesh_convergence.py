"""The study of meshes: differences fall as elements do, and the mesh of the file is good enough."""

from __future__ import annotations

import runpy
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from catenaria.line import Mesh, load_line

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def example() -> dict[str, Any]:
    return runpy.run_path(str(EXAMPLES / "mesh_convergence.py"))


def check_converges(rows: list[Any]) -> None:
    """Halving the elements takes at least half of every difference away."""
    for coarse, fine in pairwise(rows):
        assert fine.unknowns > coarse.unknowns
        assert fine.length < 0.5 * coarse.length
        assert fine.force < 0.5 * coarse.force
        assert fine.height < 0.5 * coarse.height


@pytest.fixture(scope="module")
def graded(example: dict[str, Any]) -> list[Any]:
    return example["study"](
        load_line(example["LINE"]), {str(n): Mesh(refine=n) for n in (1, 2, 4)}, Mesh(refine=8)
    )


@pytest.fixture(scope="module")
def even(example: dict[str, Any]) -> list[Any]:
    sizes = (2.4, 1.2, 0.6)
    meshes = {str(size): Mesh(fine=(), largest_element=size) for size in sizes}
    return example["study"](load_line(example["LINE"]), meshes, Mesh(refine=8))


def test_differences_fall_with_the_elements(graded: list[Any], even: list[Any]) -> None:
    check_converges(graded)
    check_converges(even)


def test_a_study_in_the_wrong_order_would_be_noticed(graded: list[Any]) -> None:
    with pytest.raises(AssertionError):
        check_converges(graded[::-1])


def test_the_mesh_of_the_file_is_good_to_a_twentieth_of_a_millimetre(
    graded: list[Any], even: list[Any]
) -> None:
    assert graded[0].length < 0.05e-3
    assert graded[0].force < 0.01
    assert even[0].length > 1e-3  # bending beside supports and clamps is missed


def test_the_table_is_printed(example: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    example["main"]()
    out = capsys.readouterr().out
    assert all(name in out for name in example["MESHES"])
