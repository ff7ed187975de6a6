"""Rounded dropper lengths, and the heights that follow."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from catenaria.discretise.spatial.loaded import with_dropper_lengths
from catenaria.errors import InconsistentInputError
from catenaria.formfinding.direct import Direct
from catenaria.line import Line, load_line
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.rounding import round_droppers
from catenaria.numerics.rounding import rounded_half_up
from catenaria.results import FormResult, load_result, save_result
from catenaria.results.rounding import RoundingStudy

EXAMPLES = Path(__file__).parents[2] / "examples"
Found = tuple[Line, FormResult]


@pytest.fixture(scope="module")
def found() -> Found:
    tree = load_line(EXAMPLES / "yang2017_three_span.yaml").model_dump(mode="json")
    tree["dropper"] |= {"clamp_height_top": 0.0123, "clamp_height_bottom": 0.0211}
    line = Line.model_validate(tree)
    return line, Direct().find_form(line)


def test_halves_go_up() -> None:
    lengths = np.array([0.0125, 0.0124999, 1.0, 1.2025, 0.3 * 3])
    assert rounded_half_up(lengths, 0.005).tolist() == [0.015, 0.010, 1.0, 1.205, 0.9]
    assert rounded_half_up(np.array([0.5, 1.5, 2.5]), 1.0).tolist() == [1.0, 2.0, 3.0]  # not to even ones


@pytest.mark.parametrize("step", [0.001, 0.005, 0.01])
def test_heights_are_those_of_the_line_with_rounded_cut_lengths(found: Found, step: float) -> None:
    [rounded] = round_droppers(*found, [step]).rounded
    droppers = found[1].droppers
    multiple = rounded.cut_length / step
    assert multiple == pytest.approx(np.round(multiple), abs=1e-9)
    assert np.abs(rounded.change).max() <= 0.5 * step + 1e-9
    assert rounded.cut_length == pytest.approx(droppers.cut_length + rounded.change)
    built = BuiltLine.of(*found)
    length = droppers.unstressed_length + rounded.change
    other = built.under(model=with_dropper_lengths(built.model, length))
    assert rounded.height == pytest.approx(other.height, abs=1e-9)
    assert rounded.force == pytest.approx(other.dropper_pull, abs=1e-4)
    assert rounded.height_error == pytest.approx(rounded.height - droppers.target_height)
    assert np.abs(rounded.height_error).max() > 0.1 * step


def test_finer_steps_err_less_and_the_finest_not_at_all(found: Found) -> None:
    study = round_droppers(*found, [0.01, 0.001, 1e-8])
    largest = [np.abs(rounded.height_error).max() for rounded in study.rounded]
    assert largest[0] > 3.0 * largest[1] > 1e3 * largest[2]
    assert largest[2] < 2e-8


def test_the_line_goes_down_by_what_all_droppers_are_longer(found: Found) -> None:
    [rounded] = round_droppers(*found, [0.004]).rounded
    up = rounded.height_change @ rounded.change
    assert up < 0.0  # longer droppers, lower wire


@pytest.mark.parametrize("step", [0.0, -0.001, 30.0, float("nan")])
def test_steps_that_leave_nothing_are_refused(found: Found, step: float) -> None:
    with pytest.raises(InconsistentInputError, match=r"step above 0|nothing is left"):
        round_droppers(*found, [step])


def test_a_study_is_kept_to_the_last_bit(found: Found, tmp_path: Path) -> None:
    study = round_droppers(*found, [0.005, 0.01])
    save_result(study, tmp_path)
    again = load_result(tmp_path, RoundingStudy)
    assert [rounded.step for rounded in again.rounded] == [0.005, 0.01]
    assert np.array_equal(again.rounded[1].height, study.rounded[1].height)
    assert again.supports == study.supports
