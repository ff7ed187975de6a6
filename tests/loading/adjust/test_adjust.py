"""From measured heights to corrected lengths: what was done wrong is undone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import combinations, product

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import with_dropper_lengths
from catenaria.errors import InconsistentInputError, InfeasibleError, NotConvergedError, UnsupportedError
from catenaria.line.measured import MeasuredHeights
from catenaria.loading import adjust as adjusting
from catenaria.loading.adjust import adjust
from catenaria.loading.adjustment_limits import AdjustmentLimits
from catenaria.loading.built_line import BuiltLine
from catenaria.results.adjustment import Adjustment

Measure = Callable[..., MeasuredHeights]

ERRORS = {3: 0.030, 8: -0.020, 15: 0.015, 20: -0.025}


def changes(study: Adjustment) -> dict[int, float]:
    return {
        int(i): round(float(study.droppers.change[i]), 9) for i in np.flatnonzero(study.droppers.adjusted)
    }


def undone(errors: dict[int, float]) -> dict[int, float]:
    return {i: -error for i, error in errors.items()}


def test_exactly_the_wrong_droppers_are_corrected(three_spans: BuiltLine, measure: Measure) -> None:
    study = adjust(three_spans, measure(three_spans, ERRORS), AdjustmentLimits(at_most=4))
    assert changes(study) == undone(ERRORS)
    assert study.fewest == 4
    assert study.largest_deviation(study.droppers.height_before) > 0.010
    assert study.largest_deviation(study.droppers.height_after) < 1e-7


@pytest.mark.parametrize("seed", range(3))
def test_so_they_are_in_spite_of_noise(three_spans: BuiltLine, measure: Measure, seed: int) -> None:
    noise = np.random.default_rng(seed).normal(0.0, 0.0005, 21)
    measured = measure(three_spans, ERRORS, noise)
    study = adjust(three_spans, measured, AdjustmentLimits(noise=0.0005))
    assert changes(study) == undone(ERRORS)
    assert study.largest_deviation(study.droppers.height_after) < 0.002


def test_there_is_nothing_to_do_within_the_tolerance(three_spans: BuiltLine, measure: Measure) -> None:
    study = adjust(three_spans, measure(three_spans, {3: 0.008}), AdjustmentLimits())
    assert changes(study) == {}
    assert study.count == study.fewest == 0
    assert study.largest_deviation(study.droppers.height_before) > 0.003


def test_predicted_heights_are_those_at_rest(three_spans: BuiltLine, measure: Measure) -> None:
    study = adjust(three_spans, measure(three_spans, ERRORS), AdjustmentLimits())
    droppers = study.droppers
    np.testing.assert_allclose(droppers.height_predicted, droppers.height_after, atol=5e-5)
    rest = three_spans.under(model=with_dropper_lengths(three_spans.model, droppers.new_length))
    np.testing.assert_allclose(rest.height, droppers.height_after, atol=1e-9)
    assert np.abs(rest.height - droppers.height_before).max() > 0.005


def test_mirrored_heights_give_mirrored_changes(three_spans: BuiltLine, measure: Measure) -> None:
    mirrored = {20 - i: error for i, error in ERRORS.items()}
    ways = [adjust(three_spans, measure(three_spans, e), AdjustmentLimits()) for e in (ERRORS, mirrored)]
    np.testing.assert_allclose(ways[0].droppers.change, ways[1].droppers.change[::-1], atol=1e-9)
    assert not np.allclose(ways[0].droppers.change, ways[1].droppers.change)


def test_no_single_dropper_would_do(one_span: BuiltLine, measure: Measure) -> None:
    errors, tolerance = {2: 0.022, 4: -0.018}, 0.005
    study = adjust(one_span, measure(one_span, errors), AdjustmentLimits(tolerance))
    assert study.count == study.fewest == 2
    present, wanted = study.droppers.present_length, study.droppers.wanted_height
    steps = [0.005 * k for k in range(-6, 7)]
    good: dict[int, set[tuple[int, ...]]] = {1: set(), 2: set()}
    for count, found in good.items():
        for chosen in combinations(range(present.size), count):
            for grid in map(np.array, product(steps, repeat=count)):
                linear = study.droppers.height_before - wanted - 0.5 * _put(present.size, chosen, grid)
                if np.abs(linear).max() > 1.4 * tolerance:
                    continue  # far off by the law of strings: not worth a nonlinear rest
                length = present + _put(present.size, chosen, grid)
                rest = one_span.under(model=with_dropper_lengths(one_span.model, length))
                if np.abs(rest.height - wanted).max() <= tolerance:
                    found.add(chosen)
    assert good[1] == set()
    assert tuple(np.flatnonzero(study.droppers.adjusted).tolist()) in good[2]


def _put(n: int, chosen: tuple[int, ...], values: NDArray[np.float64]) -> NDArray[np.float64]:
    change = np.zeros(n)
    change[list(chosen)] = values
    return change


def test_heights_that_are_not_as_predicted_are_no_result(
    three_spans: BuiltLine, measure: Measure, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(adjusting, "_AGREES", 0.0)
    with pytest.raises(NotConvergedError, match="after 12 linearisations"):
        adjust(three_spans, measure(three_spans, ERRORS), AdjustmentLimits())


def test_too_few_droppers_are_refused_with_what_would_do(three_spans: BuiltLine, measure: Measure) -> None:
    with pytest.raises(
        InfeasibleError, match=r"at most 3 changes .* 4 droppers would do; .* for 3 is 7\.5 mm"
    ):
        adjust(three_spans, measure(three_spans, ERRORS), AdjustmentLimits(at_most=3))
    within = adjust(three_spans, measure(three_spans, ERRORS), AdjustmentLimits(0.0075, at_most=3))
    assert within.count == 3


def test_a_tolerance_that_steps_cannot_reach_is_refused(one_span: BuiltLine, measure: Measure) -> None:
    limits = AdjustmentLimits(tolerance=0.0002, step=0.010)
    with pytest.raises(InfeasibleError, match=r"no changes of dropper lengths .* in steps of 10 mm"):
        adjust(one_span, measure(one_span, {3: 0.013}), limits)
    assert adjust(one_span, measure(one_span, {3: 0.013}), replace(limits, step=0.001)).count == 1


def test_a_slack_dropper_is_said_to_be_slack_and_made_taut(one_span: BuiltLine, measure: Measure) -> None:
    study = adjust(one_span, measure(one_span, {3: 0.09}), AdjustmentLimits(least_force=20.0))
    assert np.flatnonzero(study.droppers.force_before < 1e-3).tolist() == [3]
    assert study.droppers.change[3] < -0.02
    assert study.droppers.force_after.min() > 20.0


def test_heights_may_be_measured_anywhere_on_the_contact_wire(
    three_spans: BuiltLine, measure: Measure
) -> None:
    at_droppers = measure(three_spans, ERRORS)
    x = three_spans.model.layout.droppers.frame.chainage.tolist()
    rows = zip(at_droppers.rows, x, strict=True)
    by_chainage = tuple(replace(row, span=0, number=0, chainage=c) for row, c in rows)
    study = adjust(three_spans, replace(at_droppers, rows=by_chainage), AdjustmentLimits())
    assert changes(study) == undone(ERRORS)
    assert study.points.number.tolist() == [0] * 21


def test_unmeasured_droppers_are_taken_as_scheduled(three_spans: BuiltLine, measure: Measure) -> None:
    study = adjust(three_spans, measure(three_spans, {4: 0.03, 9: 0.03}, every=2), AdjustmentLimits())
    assert changes(study) == undone({4: 0.03})  # nobody has looked at dropper 9
    assert study.points.height.size == 11


@pytest.mark.parametrize(
    ("field", "value"),
    [("tolerance", 0.0), ("step", -0.005), ("at_most", -1), ("noise", -1e-3), ("largest_change", 0.001)],
)
def test_limits_that_make_no_sense_are_refused(field: str, value: float) -> None:
    with pytest.raises(InconsistentInputError, match=r"adjust|largest change"):
        replace(AdjustmentLimits(), **{field: value})


def test_slack_by_the_schedule_is_refused(one_span: BuiltLine, measure: Measure) -> None:
    length = one_span.model.unknowns.start[one_span.model.length].copy()
    length[3] += 0.09
    slack = one_span.with_model(with_dropper_lengths(one_span.model, length))
    with pytest.raises(UnsupportedError, match="slack by the schedule"):
        adjust(slack, measure(one_span, {}), AdjustmentLimits())
