"""Lengths that explain measured heights."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from catenaria.line.measured import MeasuredHeights
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.gauged import gauged_points
from catenaria.loading.identify import SCATTER, identify

Measure = Callable[..., MeasuredHeights]


def found(
    built: BuiltLine, measured: MeasuredHeights, noise: float = 0.0
) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    gauged = gauged_points(built.line, built.model, measured)
    height = np.array([row.height for row in measured.rows])
    return identify(built, gauged, height, noise).length - built.model.unknowns.start[built.model.length]


def test_as_many_heights_as_droppers_give_their_lengths(three_spans: BuiltLine, measure: Measure) -> None:
    errors = dict(enumerate(np.random.default_rng(5).normal(0.0, 0.005, 21).tolist()))
    lengths = found(three_spans, measure(three_spans, errors))
    np.testing.assert_allclose(lengths, list(errors.values()), atol=1e-8)


def test_heights_that_are_as_scheduled_change_nothing(three_spans: BuiltLine, measure: Measure) -> None:
    np.testing.assert_allclose(found(three_spans, measure(three_spans, {})), 0.0, atol=1e-9)


def test_of_all_explanations_the_least_change_is_taken(three_spans: BuiltLine, measure: Measure) -> None:
    lengths = found(three_spans, measure(three_spans, {4: 0.02}, every=2))
    assert lengths[4] == pytest.approx(0.02, abs=1e-3)
    assert np.abs(lengths[[1, 3, 5]]).max() < 1e-4
    assert np.linalg.norm(lengths) < 0.02  # the least change: what hangs beside a support takes part in it


def test_noise_is_weighed_against_the_scatter_of_lengths(one_span: BuiltLine, measure: Measure) -> None:
    # One length and its height, far from others: the most probable value of a normal prior and measurement.
    measured, noise = measure(one_span, {3: 0.010}), 0.005
    S = 0.5  # of a dropper between strings of the same tension
    expected = 0.010 * (S * SCATTER) ** 2 / ((S * SCATTER) ** 2 + noise**2)
    assert found(one_span, measured, noise)[3] == pytest.approx(expected, rel=0.02)
    assert found(one_span, measured)[3] == pytest.approx(0.010, abs=1e-8)


def test_a_slack_dropper_is_as_long_as_it_must_be_at_least(one_span: BuiltLine, measure: Measure) -> None:
    lengths = [found(one_span, measure(one_span, {3: error}))[3] for error in (0.09, 0.12)]
    assert lengths[0] == pytest.approx(lengths[1], abs=1e-6)
    assert 0.0 < lengths[0] < 0.09
