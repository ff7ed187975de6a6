"""Forms of structures as values: looked up by name, stored and read without loss."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from catenaria.errors import InconsistentInputError
from catenaria.results import load_result, save_result
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


def test_stored_and_read(form: StructureForm, tmp_path: Path) -> None:
    save_result(form, tmp_path / "one")
    back = load_result(tmp_path / "one", StructureForm)
    assert back.inputs == form.inputs
    assert back.counters == form.counters
    np.testing.assert_array_equal(back.histories[0].joint_force, form.histories[0].joint_force)
    save_result(back, tmp_path / "two")
    for name in ("result.json", "result.npz"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_it_is_not_taken_for_a_line(form: StructureForm, tmp_path: Path) -> None:
    save_result(form, tmp_path)
    with pytest.raises(InconsistentInputError, match="is not a catenaria form-finding result"):
        load_result(tmp_path)
