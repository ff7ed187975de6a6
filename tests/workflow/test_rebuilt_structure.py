"""A structure built from what was found comes back to it; one with another length does not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.results.structure import StructureForm
from catenaria.structure import Structure, load_structure
from catenaria.validation import example_file
from catenaria.workflow.rebuilt_structure import rebuilt_structure
from catenaria.workflow.solve_structure import solve_structure


@pytest.fixture(scope="module")
def structure() -> Structure:
    return load_structure(example_file("yang2017_three_cables.yaml"))


@pytest.fixture(scope="module")
def found(structure: Structure) -> StructureForm:
    return solve_structure(structure)


def check_same(rebuilt: StructureForm, found: StructureForm) -> None:
    """0.2 mm and 3 N: nodes of the rebuilt cables lie elsewhere, in elements of 0.85 m."""
    for joint in ("A", "D"):
        np.testing.assert_allclose(rebuilt.position(joint), found.position(joint), atol=0.2e-3)
    for joint in ("end of cable 1", "end of cable 2", "A", "D"):
        np.testing.assert_allclose(
            np.linalg.norm(rebuilt.force(joint)), np.linalg.norm(found.force(joint)), atol=3.0
        )


def test_it_comes_back_without_controls(structure: Structure, found: StructureForm) -> None:
    built = rebuilt_structure(structure, found)
    assert set(built.cables) == {"cable 1", "cable 2", "cable 3"}
    assert not built.controls
    check_same(solve_structure(built), found)


def test_it_starts_somewhere_else(structure: Structure, found: StructureForm) -> None:
    lowest = min(point[2] for point in rebuilt_structure(structure, found).cables["cable 1"].points)
    assert lowest == pytest.approx(found.position("A")[2] - 0.01)


def test_another_length_does_not_come_back(structure: Structure, found: StructureForm) -> None:
    """Negative control: cable 3 is cut 5 mm too short."""
    built = rebuilt_structure(structure, found)
    cable = built.cables["cable 3"]
    shorter = cable.model_copy(update={"unstressed_length": cable.length - 5e-3})
    changed = built.model_copy(update={"cables": built.cables | {"cable 3": shorter}})
    with pytest.raises(AssertionError):
        check_same(solve_structure(changed), found)


def test_another_tension_does_not_come_back(structure: Structure, found: StructureForm) -> None:
    """Negative control: cable 2 was found 1 mm shorter than it is built."""
    cables = tuple(
        replace(cable, unstressed_length=cable.unstressed_length - 1e-3) if cable.name == "cable 2" else cable
        for cable in found.cables
    )
    with pytest.raises(AssertionError):
        check_same(solve_structure(rebuilt_structure(structure, replace(found, cables=cables))), found)
