"""Another mesh for a line: what replaces what, and how wrong options are told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from catenaria.errors import LineFileError
from catenaria.line import Line, Mesh, load_line, read_mesh, with_mesh


@pytest.fixture(scope="module")
def line(example_path: Path) -> Line:
    return load_line(example_path)


def told(*options: str) -> list[str]:
    with pytest.raises(LineFileError) as caught:
        read_mesh(options)
    return [str(fault) for fault in caught.value.faults]


@pytest.mark.parametrize(
    ("option", "field", "value"),
    [
        ("refine=2", "refine", 2),
        ("largest_element=1.2m", "largest_element", 1.2),
        ("largest_element = 60 cm", "largest_element", 0.6),
        ("largest_element=1", "largest_element", 1.0),
        ("fine=[5 cm, 0.1, 300 mm]", "fine", (0.05, 0.1, 0.3)),
        ("fine=[]", "fine", ()),
        ("gauss_points=4", "gauss_points", 4),
    ],
)
def test_values_are_read_as_in_a_file(option: str, field: str, value: object) -> None:
    mesh = read_mesh([option])
    assert mesh.model_fields_set == {field}
    assert getattr(mesh, field) == pytest.approx(value)


def test_only_what_is_given_is_replaced(line: Line) -> None:
    own = Mesh(fine=(0.2,), largest_element=3.0)
    before = with_mesh(line, own)
    after = with_mesh(before, read_mesh(["refine=3", "largest_element=1 m"]))
    assert after.solver.mesh.fine == (0.2,)
    assert (after.solver.mesh.refine, after.solver.mesh.largest_element) == (3, 1.0)
    assert after.model_copy(update={"solver": line.solver}) == line
    assert after.source is line.source
    assert before.solver.mesh.refine == 1


def test_the_defaults_of_an_option_do_not_replace(line: Line) -> None:
    """Negative control of what is given: a mesh with all fields replaces all."""
    own = with_mesh(line, Mesh(fine=(0.2,)))
    assert with_mesh(own, Mesh()).solver.mesh.fine == (0.2,)
    assert with_mesh(own, Mesh.model_validate(Mesh().model_dump())).solver.mesh == Mesh()


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ("refine=0", "--mesh: refine: found 0; allowed: 1 or more"),
        ("refine=1.5", "--mesh: refine: found 1.5; allowed: a whole number"),
        ("refine=two", '--mesh: refine: found "two"; allowed: a whole number'),
        ("refine=", '--mesh: refine: found ""; allowed: a whole number'),
        ("largest_element=2 kg", '--mesh: largest_element: found "2 kg"; allowed: a length'),
        ("largest_element=0", "--mesh: largest_element: found 0; allowed: "),
        ("fine=[0.3, 0.1]", "--mesh: fine[1]: found 0.1; allowed: more than 0.3 m: distances ascend"),
        ("fine=[0.3", '--mesh: fine: found "[0.3"; allowed: a list'),
        ("gauss_points=3", "--mesh: gauss_points: found 3; allowed: 4 or more"),
        ("refin=2", "--mesh: refin: found 'refin=2'; allowed: KEY=VALUE with one of the fields fine, "),
        ("refine", "--mesh: refine: found 'refine'; allowed: KEY=VALUE"),
        ("=2", "--mesh: the option: found '=2'; allowed: KEY=VALUE"),
    ],
)
def test_a_wrong_option_is_told_by_its_name(option: str, message: str) -> None:
    (fault,) = told(option)
    assert fault.startswith(message)


def test_a_likely_name_is_asked_for() -> None:
    (fault,) = told("refin=2")
    assert fault.endswith("(did you mean refine?)")


def test_all_faults_are_told_at_once() -> None:
    assert len(told("refine=0", "largest_element=2 kg")) == 2
    assert len(told("refin=0", "largest=2", "refine=1")) == 2


def test_a_field_cannot_be_given_twice() -> None:
    assert told("refine=2", "refine=3") == [
        "--mesh: refine: found the field a second time; allowed: each field once"
    ]


def test_nothing_given_changes_nothing(line: Line) -> None:
    assert with_mesh(line, read_mesh([])) == line


def test_a_mesh_is_checked_in_python_too() -> None:
    wrong: Any = {"refine": 0}
    with pytest.raises(ValueError, match="greater than or equal to 1"):
        Mesh(**wrong)


def test_only_another_name_is_a_slip_of_the_pen() -> None:
    assert told("refin=2")[0].endswith("(did you mean refine?)")
    assert "did you mean" not in told("refine")[0]
