"""Forms of structures as values: looked up by name, stored and read without loss."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.results.codec import decode, encode
from catenaria.results.structure import StructureForm
from catenaria.workflow import solve_structure

FILE = Path(__file__).parents[2] / "examples" / "yang2017_rod.yaml"


@pytest.fixture(scope="module")
def form() -> StructureForm:
    return solve_structure(FILE, "dynamic")


def test_by_name(form: StructureForm) -> None:
    assert form.cable("bar 2").name == "bar 2"
    np.testing.assert_array_equal(form.force("O"), form.joints.force[0])
    np.testing.assert_array_equal(form.position("P3"), form.joints.position[3])
    assert form.parameter("height 4") == form.controls.parameter[3]
    with pytest.raises(InconsistentInputError, match="'P5' among O, P1"):
        form.force("P5")


def test_stored_and_read(form: StructureForm) -> None:
    tree, arrays = encode(form, StructureForm)
    back = decode(tree, StructureForm, arrays)
    assert encode(back, StructureForm)[0] == tree
    np.testing.assert_array_equal(back.unknowns, form.unknowns)
    np.testing.assert_array_equal(back.histories[0].joint_force, form.histories[0].joint_force)
    with pytest.raises(InconsistentInputError, match="missing"):
        decode(tree, StructureForm, {name: arrays[name] for name in list(arrays)[1:]})
