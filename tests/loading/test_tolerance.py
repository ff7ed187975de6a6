"""Tolerance studies: what is counted and how, whoever computes it."""

from __future__ import annotations

from concurrent.futures.process import BrokenProcessPool
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import stats

from catenaria.errors import InconsistentInputError, InfeasibleError, NotConvergedError
from catenaria.formfinding.direct import Direct
from catenaria.line import Line, load_line
from catenaria.line.installation import Installation
from catenaria.loading.installed import InstalledLine
from catenaria.loading.tolerance import Options, study_tolerances, with_seed
from catenaria.results import FormResult, load_result, save_result
from catenaria.results.tolerance import ToleranceStudy

EXAMPLES = Path(__file__).parents[2] / "examples"
NORMAL: dict[str, Any] = {"distribution": "normal", "scale": 1e-3}
LENGTHS = Installation.model_validate({"dropper_length": NORMAL})
SOME = Installation.model_validate(
    {
        "dropper_length": NORMAL,
        "messenger_height": {"distribution": "uniform", "scale": 3e-3},
        "tension": {"distribution": "triangular", "fraction": 0.01},
    }
)
Found = tuple[Line, FormResult]


@pytest.fixture(scope="module")
def found() -> Found:
    line = load_line(EXAMPLES / "yang2017_three_span.yaml")
    return line, Direct().find_form(line)


@pytest.fixture(scope="module")
def study(found: Found) -> ToleranceStudy:
    return study_tolerances(*found, SOME, Options(samples=1000))


def equal(one: Any, other: Any) -> bool:
    """Return whether two studies are the same to the last bit."""
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other)
    if hasattr(one, "__dataclass_fields__"):
        return all(equal(getattr(one, f.name), getattr(other, f.name)) for f in fields(one))
    return one == other


def scaled(errors: Installation, factor: float) -> Installation:
    tree = errors.model_dump()
    tree["dropper_length"]["scale"] *= factor
    return Installation.model_validate(tree)


def test_the_same_seed_gives_the_same_study_whoever_computes_it(found: Found) -> None:
    studies = [study_tolerances(*found, SOME, Options(samples=150, workers=w)) for w in (1, 2, 3)]
    assert equal(studies[0], studies[1])
    assert equal(studies[0], studies[2])
    other = study_tolerances(*found, with_seed(SOME, 2), Options(samples=150))
    assert not equal(studies[0], other)


def test_more_samples_begin_with_the_same_ones(found: Found, study: ToleranceStudy) -> None:
    few = study_tolerances(*found, SOME, Options(samples=130))
    assert np.array_equal(study.worst[:130], few.worst)


def test_nothing_scatters_without_errors(found: Found) -> None:
    study = study_tolerances(*found, Installation(), Options(samples=3))
    assert study.height.mean == pytest.approx(study.wanted_height, abs=1e-9)
    assert not study.height.deviation.any()
    assert not study.elasticity.deviation.any()
    assert study.importance.group == study.errors.name == ()
    assert study.count_of("leaving") == study.count_of("slack") == study.count_of("no rest") == 0


def test_normal_errors_give_normal_heights_of_the_deviation_that_is_closed(found: Found) -> None:
    study = study_tolerances(*found, LENGTHS, Options(samples=3000))
    slope = study.errors.sensitivity
    closed = 1e-3 * np.sqrt(np.einsum("ik,ik->i", slope, slope))
    assert study.height.deviation == pytest.approx(closed, rel=0.06)
    levels = closed[:, None] * stats.norm.ppf([0.05, 0.95])
    assert study.height.percentile[:, [1, 5]] - study.wanted_height[:, None] == pytest.approx(
        levels, abs=0.1 * closed.max()
    )
    flat = {"distribution": "uniform", "scale": 1e-3 * np.sqrt(3.0)}  # as large, but not normal
    known = Installation.model_validate({"contact_height": flat})
    flat_study = study_tolerances(*found, known, Options(samples=3000))
    first = (
        flat_study.height.percentile[0, [0, 6]] - flat_study.wanted_height[0]
    ) / flat_study.height.deviation[0]
    assert np.abs(first).max() < 2.0  # 2.33 of a normal one


def test_twice_the_errors_are_twice_the_band(found: Found) -> None:
    bands = [
        study_tolerances(*found, scaled(LENGTHS, factor), Options(samples=300)).height.deviation
        for factor in (1.0, 2.0)
    ]
    assert bands[1] == pytest.approx(2.0 * bands[0], rel=2e-3)
    assert bands[1] != pytest.approx(2.1 * bands[0], rel=2e-3)


def test_the_linearised_line_is_stated_beside_the_nonlinear_one(found: Found, study: ToleranceStudy) -> None:
    linear = study_tolerances(*found, SOME, Options(samples=1000, model="linear"))
    assert equal(linear.height, study.linear_height)
    assert np.array_equal(linear.worst, study.linear_worst)
    assert linear.difference == linear.largest_difference == 0.0
    assert 0.0 < study.difference < study.largest_difference < 0.1e-3
    off = np.abs(study.worst - study.linear_worst).max()
    assert 0.0 < off <= study.largest_difference + 1e-12


def test_probabilities_are_counted(study: ToleranceStudy) -> None:
    count = np.count_nonzero(study.worst > study.tolerance)
    assert study.count_of("leaving") == count
    share, low, high = study.event("leaving")
    assert low < share == count / 1000 < high
    worst_dropper = study.outside.count.max()
    assert worst_dropper <= count <= study.outside.count.sum()


def test_shares_add_up_and_samples_agree_with_them(study: ToleranceStudy) -> None:
    of = study.importance
    assert of.group == ("dropper length", "messenger height", "tension")
    assert of.count.tolist() == [21, 4, 2]
    assert of.share.sum() == pytest.approx(1.0)
    assert of.share_at.sum(axis=0) == pytest.approx(1.0)
    assert of.sampled_share == pytest.approx(of.share, abs=0.05)
    assert study.errors.share.sum() == pytest.approx(1.0)
    assert np.argmax(of.share) == np.argmin(of.leaving_without)
    parts = [study.errors.share[[group == g for group in study.errors.group]].sum() for g in of.group]
    assert of.share == pytest.approx(parts)


def test_a_group_without_errors_takes_its_share_away(found: Found) -> None:
    whole = study_tolerances(*found, SOME, Options(samples=1000, model="linear", tolerance=2e-3))
    less = SOME.model_copy(update={"messenger_height": None})
    without = study_tolerances(*found, less, Options(samples=1000, model="linear", tolerance=2e-3))
    i = whole.importance.group.index("messenger height")
    low, high = without.event("leaving")[1:]
    assert low - 0.03 < whole.importance.leaving_without[i] < high + 0.03
    assert whole.event("leaving")[0] > high


def test_samples_without_rest_are_counted_and_count_as_leaving(
    found: Found, monkeypatch: pytest.MonkeyPatch
) -> None:
    rest = InstalledLine.rest

    def fails(self: InstalledLine, p: np.ndarray) -> np.ndarray:
        if p[0] > 1e-3:
            raise NotConvergedError("a test", "nothing")
        return rest(self, p)

    monkeypatch.setattr(InstalledLine, "rest", fails)
    study = study_tolerances(*found, LENGTHS, Options(samples=200, tolerance=0.02))
    failed = study.count_of("no rest")
    assert 10 < failed < 60
    assert study.count_of("leaving") == failed
    assert study.count_of("leaving, linear") == 0
    assert study.worst.size == 200 - failed
    assert np.isfinite(study.height.mean).all()


def test_a_study_without_any_rest_is_refused(found: Found, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(self: InstalledLine, p: np.ndarray) -> np.ndarray:
        raise NotConvergedError("a test", "nothing")

    monkeypatch.setattr(InstalledLine, "rest", fails)
    with pytest.raises(InfeasibleError, match="not one sample"):
        study_tolerances(*found, LENGTHS, Options(samples=5))


def test_slack_droppers_are_counted(found: Found) -> None:
    known = {"droppers": [{"span": 2, "dropper": 3, "length": 0.2}]}
    errors = Installation.model_validate({"dropper_length": NORMAL, "known": known})
    study = study_tolerances(*found, errors, Options(samples=20))
    assert study.count_of("slack") == 20
    assert np.flatnonzero(study.slack).tolist() == [9]
    assert study.slack[9] == 20
    assert study.force.maximum[9] == pytest.approx(0.0, abs=1e-6)
    assert study.largest_difference > 5e-3  # the linearised line has droppers that push


def test_a_worker_that_dies_is_told(found: Found, monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(waiting: Any, return_when: str) -> Any:
        raise BrokenProcessPool

    monkeypatch.setattr("catenaria.loading.samples.wait", breaks)
    with pytest.raises(NotConvergedError, match="worker process has ended"):
        study_tolerances(*found, LENGTHS, Options(samples=10, workers=2))


def test_progress_is_told(found: Found) -> None:
    told: list[tuple[int, int]] = []
    study_tolerances(*found, LENGTHS, Options(samples=100), lambda done, of: told.append((done, of)))
    assert told[-1] == (100, 100)
    assert [done for done, _ in told] == sorted({done for done, _ in told})


@pytest.mark.parametrize(
    "options", [{"samples": 1}, {"workers": 0}, {"tolerance": 0.0}, {"tolerance": float("nan")}]
)
def test_options_that_make_no_study_are_refused(options: dict[str, Any]) -> None:
    with pytest.raises(InconsistentInputError):
        Options(**options)


def test_more_samples_than_memory_are_refused(found: Found) -> None:
    with pytest.raises(InconsistentInputError, match="too much memory: at most"):
        study_tolerances(*found, LENGTHS, Options(samples=10**7, model="linear"))


def test_a_study_is_kept_to_the_last_bit(study: ToleranceStudy, tmp_path: Path) -> None:
    save_result(study, tmp_path)
    again = load_result(tmp_path, ToleranceStudy)
    assert equal(again, study)
    assert not equal(again, replace(study, seed=3))
    with pytest.raises(InconsistentInputError, match="not a catenaria form-finding result"):
        load_result(tmp_path)
