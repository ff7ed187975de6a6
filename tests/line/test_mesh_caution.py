"""Meshes that are too coarse where wires bend are spoken of."""

from __future__ import annotations

from pathlib import Path

import pytest

from catenaria.line import Line, Mesh, load_line, mesh_caution, with_mesh

EXAMPLE = Path(__file__).parents[2] / "examples" / "yang2017_three_span.yaml"


@pytest.fixture(scope="module")
def line() -> Line:
    return load_line(EXAMPLE)


@pytest.mark.parametrize(
    "mesh", [Mesh(), Mesh(refine=2), Mesh(even=2000), Mesh(fine=(), largest_element=0.2)]
)
def test_fine_meshes_pass(line: Line, mesh: Mesh) -> None:
    assert mesh_caution(with_mesh(line, mesh)) is None


@pytest.mark.parametrize("mesh", [Mesh(fine=()), Mesh(even=130), Mesh(even=20), Mesh(fine=(0.5,))])
def test_coarse_meshes_do_not(line: Line, mesh: Mesh) -> None:
    caution = mesh_caution(with_mesh(line, mesh))
    assert caution is not None
    assert "within 0.14 m" in caution


def test_usual_strands_do_not_need_a_finer_mesh(line: Line) -> None:
    """A bronze strand of 70 mm^2 bends within 0.04 m; its error is 0.03 mm on the usual mesh."""
    strand = line.conductors["messenger"].model_copy(update={"bending_stiffness": 25.8})
    changed = line.model_copy(update={"conductors": {**line.conductors, "messenger": strand}})
    assert mesh_caution(changed) is None
    assert mesh_caution(with_mesh(changed, Mesh(fine=(0.15,)))) is not None


def test_limp_wires_need_a_finer_mesh(line: Line) -> None:
    limp = line.conductors["messenger"].model_copy(update={"bending_stiffness": 10.0})
    changed = line.model_copy(update={"conductors": {**line.conductors, "messenger": limp}})
    assert mesh_caution(changed) is not None
