"""What a result shows: tables, figures, studies; and that it cannot be changed through them."""

from __future__ import annotations

import pickle
import re
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

import catenaria
from catenaria.results import NOT_AUDITED, NOT_REBUILT

SUFFIX = re.compile(r".*_(m|N|deg|degC|Nm|kg|s)$")


def test_tables_are_those_of_the_form(paper: catenaria.Result) -> None:
    form = paper.form
    np.testing.assert_array_equal(paper.droppers["length_m"], form.droppers.length)
    assert paper.wires["wire"].tolist() == [wire.name for wire in form.wires]
    np.testing.assert_array_equal(paper.supports["force_z_N"], form.supports.force_z)
    assert len(paper.controls) == len(form.controls.name)
    assert paper.arms.empty
    assert paper.table("counters")["steps"].tolist() == [counter.steps for counter in form.counters]
    with pytest.raises(catenaria.InconsistentInputError, match="there is no table 'screws'"):
        paper.table("screws")  # pyright: ignore[reportArgumentType]


def test_numbers_have_units(stitched: catenaria.Result) -> None:
    for table in (stitched.droppers, stitched.wires, stitched.supports, stitched.arms, stitched.profile()):
        floats = table.select_dtypes("float").columns
        assert len(floats) > 3
        assert [name for name in floats if not SUFFIX.fullmatch(name)] == []


def test_a_table_is_a_copy(paper: catenaria.Result) -> None:
    before = paper.form.droppers.length.copy()
    table = paper.droppers
    table.loc[:, "length_m"] = 0.0
    np.testing.assert_array_equal(paper.form.droppers.length, before)
    assert (paper.droppers["length_m"] > 0.0).all()


def test_a_result_is_a_value(paper: catenaria.Result) -> None:
    with pytest.raises(FrozenInstanceError):
        paper.form = paper.form  # pyright: ignore[reportAttributeAccessIssue]
    with pytest.raises(TypeError, match="unhashable"):
        hash(paper)
    assert pickle.loads(pickle.dumps(paper)) == paper


def test_a_profile_is_one_wire(stitched: catenaria.Result) -> None:
    shape = stitched.profile("stitch wire S3")
    np.testing.assert_array_equal(shape["height_m"], stitched.form.wire("stitch wire S3").profile.height)
    assert shape["chainage_m"].between(110.0, 150.0).all()
    with pytest.raises(catenaria.InconsistentInputError, match="there is no wire 'rope'"):
        stitched.profile("rope")


def test_the_line_is_the_one_that_was_solved(paper: catenaria.Result) -> None:
    assert (paper.name, paper.method) == ("Yang et al. 2017, three spans", "direct")
    other = catenaria.vary(paper.line, {"spans.1.length": "64 m"})
    assert other.spans[1].length == 64.0
    assert catenaria.solve(paper.line) == paper


def test_what_passed_was_checked(paper: catenaria.Result) -> None:
    form = paper.form
    assert paper.passed
    assert catenaria.Result(replace(form, rebuilt=NOT_REBUILT)).passed
    assert not catenaria.Result(replace(form, audit=NOT_AUDITED)).passed
    assert not catenaria.Result(replace(form, audit=replace(form.audit, findings=("wrong",)))).passed
    off = replace(form.rebuilt.height, change=form.rebuilt.height.change + 1.0)
    assert not catenaria.Result(replace(form, rebuilt=replace(form.rebuilt, height=off))).passed


@pytest.mark.parametrize("name", ["paper", "stitched"])
def test_figures(name: str, request: pytest.FixtureRequest) -> None:
    result: catenaria.Result = request.getfixturevalue(name)
    plot = result.plot
    figures = (plot.profile(), plot.plan(), plot.tension(), plot.tension("messenger wire"), plot.moments())
    assert all(isinstance(figure, Figure) for figure in figures)
    (line,) = [line for line in figures[0].axes[0].lines if line.get_label() == "messenger wire"]
    shape = result.form.wire("messenger wire").profile
    here = shape.chainage <= figures[0].axes[0].get_xlim()[1]
    np.testing.assert_array_equal(line.get_ydata(), shape.height[here])
    with pytest.raises(catenaria.InconsistentInputError):
        plot.tension("rope")


def test_load_cases_by_mapping(paper: catenaria.Result) -> None:
    push = {"push": [{"chainage": "97.5 m", "force": "10 N"}]}
    study = paper.under({"pushed": push, "calm": {}})
    (uplift,) = study.cases[0].pushed.uplift
    assert 0.003 < uplift < 0.008
    rest = study.cases[1].state.droppers.height
    np.testing.assert_allclose(rest, paper.form.droppers.height, rtol=0.0, atol=1e-8)
    same = catenaria.LoadCases.model_validate({"format": 1, "cases": {"pushed": push}})
    np.testing.assert_array_equal(paper.under(same).cases[0].pushed.uplift, [uplift])


@pytest.mark.parametrize(
    ("cases", "said"),
    [
        ({"hot": {"temperature": {"change": "40 m"}}}, "load cases: cases.hot.temperature.change"),
        ({}, "one load case or more"),
        ({"a/b": {}}, "one of a folder"),
        ({"pushed": {"push": [{"chainage": "9 km", "force": "10 N"}]}}, "load cases: cases.pushed.push"),
    ],
)
def test_a_wrong_case_is_told_by_its_place(paper: catenaria.Result, cases: dict, said: str) -> None:
    with pytest.raises(catenaria.LineFileError, match=said):
        paper.under(cases)


def test_elasticity(paper: catenaria.Result) -> None:
    study = paper.elasticity(10.0, 5.0, start=90.0, end=105.0)
    assert study.points.chainage[[0, -1]].tolist() == [90.0, 105.0]
    i = int(np.flatnonzero(study.points.chainage == 97.5)[0])
    (uplift,) = paper.under({"pushed": {"push": [{"chainage": 97.5, "force": 10.0}]}}).cases[0].pushed.uplift
    np.testing.assert_allclose(study.points.elasticity[i], uplift / 10.0, rtol=0.02)


def test_tolerance(paper: catenaria.Result) -> None:
    study = paper.tolerance(samples=50, model="linear", band=0.01, seed=3)
    assert (study.samples, study.model, study.tolerance, study.seed) == (50, "linear", 0.01, 3)
    assert (study.height.deviation > 0.0).all()
    again = paper.tolerance(samples=50, model="linear", band=0.01, seed=4)
    assert (study.height.mean != again.height.mean).any()


def test_methods_without_nodes_have_tables_too(paper_file: str) -> None:
    result = catenaria.solve(paper_file, "force density")
    assert isinstance(result.droppers, pd.DataFrame)
    assert result.passed
    assert "rebuild   none" in repr(result)
    with pytest.raises(catenaria.UnsupportedError):
        result.under({"calm": {}})
