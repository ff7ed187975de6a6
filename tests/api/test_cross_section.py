"""A line at one chainage against its tables and against a smooth curve through its points."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError, fields, replace
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import catenaria
from catenaria.results import Droppers


def worst_at_droppers(result: catenaria.Result) -> float:
    """Return by how much heights at droppers differ from those in the schedule [m]."""
    droppers, off = result.form.droppers, 0.0
    for i, chainage in enumerate(droppers.x.tolist()):
        here = result.at(chainage)
        off = max(
            off,
            abs(here.wire(droppers.lower_wire[i]).height - droppers.height[i]),
            abs(here.wire(droppers.upper_wire[i]).height - droppers.messenger_height[i]),
            abs(here.wire(droppers.lower_wire[i]).lateral - droppers.stagger_bottom[i]),
        )
    return off


@pytest.mark.parametrize("name", ["paper", "stitched"])
def test_at_droppers_it_is_the_schedule(name: str, request: pytest.FixtureRequest) -> None:
    result: catenaria.Result = request.getfixturevalue(name)
    assert worst_at_droppers(result) < 2e-6
    lifted = replace(result.form.droppers, height=result.form.droppers.height + 1e-5)
    assert worst_at_droppers(catenaria.Result(replace(result.form, droppers=lifted))) > 2e-6


@pytest.mark.parametrize("name", ["paper", "stitched"])
def test_between_points_it_is_as_close_as_it_says(name: str, request: pytest.FixtureRequest) -> None:
    result: catenaria.Result = request.getfixturevalue(name)
    for wire in ("contact wire", "messenger wire"):
        shape = result.form.wire(wire).profile
        smooth = CubicSpline(shape.chainage, shape.height)
        between = 0.5 * (shape.chainage[1:] + shape.chainage[:-1])
        found = np.array([result.at(c).wire(wire).height for c in between[::7].tolist()])
        off = float(np.abs(found - smooth(between[::7])).max())
        assert 1e-9 < off < 0.05e-3


def test_only_wires_that_are_there(stitched: catenaria.Result) -> None:
    both = ["contact wire", "messenger wire"]
    assert [wire.wire for wire in stitched.at(97.5).wires] == both
    assert [wire.wire for wire in stitched.at(130.0).wires] == [*both, "stitch wire S3"]
    with pytest.raises(catenaria.InconsistentInputError, match=r"no wire 'stitch wire S3' at 97\.500 m"):
        stitched.at(97.5).wire("stitch wire S3")


@pytest.mark.parametrize("chainage", [-5.0, 200.0, float("nan"), float("inf")])
def test_beyond_the_line(paper: catenaria.Result, chainage: float) -> None:
    with pytest.raises(catenaria.InconsistentInputError, match=r"from -0\.\d+ to 195\.\d+ m"):
        paper.at(chainage)


@pytest.mark.parametrize("chainage", ["97.5 m", None, [97.5], 1j])
def test_what_is_no_number(paper: catenaria.Result, chainage: Any) -> None:
    with pytest.raises(catenaria.InconsistentInputError, match="a number of metres"):
        paper.at(chainage)


@pytest.mark.parametrize("number", [97, np.float64(97.0), np.float32(97.0), np.int64(97)])
def test_every_kind_of_number(paper: catenaria.Result, number: Any) -> None:
    assert paper.at(number) == paper.at(97.0)


def test_the_nearest_dropper(paper: catenaria.Result) -> None:
    near = paper.at(65.0 + 13.5 + 4.7).dropper
    assert near is not None
    assert (near.lower_wire, near.upper_wire) == ("contact wire", "messenger wire")
    assert (near.span, near.number, near.chainage) == (2, 2, 78.5)
    row = paper.droppers.query("span == 2 and dropper == 2").iloc[0]
    assert (near.length, near.cut_length, near.force) == tuple(
        row[["length_m", "cut_length_m", "force_bottom_N"]]
    )
    farther = paper.at(65.0 + 13.5 + 4.8).dropper
    assert farther is not None
    assert farther.number == 3


def test_a_line_without_droppers(paper: catenaria.Result) -> None:
    droppers = paper.form.droppers
    none = Droppers(**{field.name: getattr(droppers, field.name)[:0] for field in fields(Droppers)})
    bare = catenaria.Result(replace(paper.form, droppers=none))
    assert bare.at(10.0).dropper is None
    assert "nearest" not in repr(bare.at(10.0))
    assert "droppers  none" in repr(bare)


def test_it_is_a_value(paper: catenaria.Result) -> None:
    here = paper.at(97.5)
    assert here == paper.at(97.5)
    assert here != paper.at(97.6)
    assert hash(here) == hash(pickle.loads(pickle.dumps(here)))
    with pytest.raises(FrozenInstanceError):
        here.chainage = 0.0  # pyright: ignore[reportAttributeAccessIssue]


def test_no_zero_has_a_sign(paper: catenaria.Result) -> None:
    for chainage in paper.form.droppers.x.tolist():
        assert "-0.0000" not in repr(paper.at(chainage))
