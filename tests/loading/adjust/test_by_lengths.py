"""Derivatives by dropper lengths, against differences and against strings."""

from __future__ import annotations

import numpy as np

from catenaria.loading.built_line import BuiltLine
from catenaria.loading.by_lengths import Response, respond
from catenaria.loading.gauged import GaugedPoints


def at_droppers(built: BuiltLine) -> GaugedPoints:
    droppers, z = built.model.layout.droppers, built.model.unknowns.start
    frame = droppers.frame
    return GaugedPoints(droppers.lower, z[built.model.lower_s], frame.chainage, frame.origin, frame.up)


def scheduled(built: BuiltLine) -> Response:
    return respond(built, at_droppers(built), built.model.unknowns.start[built.model.length])


def test_a_line_with_its_scheduled_lengths_rests_where_it_was_found(three_spans: BuiltLine) -> None:
    found = scheduled(three_spans)
    np.testing.assert_allclose(found.height, three_spans.at_rest.height, atol=1e-10)
    np.testing.assert_allclose(found.pull, three_spans.at_rest.dropper_pull, atol=1e-5)
    np.testing.assert_array_equal(found.gauged, found.height)


def test_slopes_are_limits_of_differences(three_spans: BuiltLine) -> None:
    found, points = scheduled(three_spans), at_droppers(three_spans)
    way = np.random.default_rng(3).normal(size=found.length.size)
    above, below = (respond(three_spans, points, found.length + e * way, found) for e in (1e-4, -1e-4))
    for field in ("height", "pull", "gauged"):
        slope = (getattr(above, field) - getattr(below, field)) / 2e-4
        predicted = getattr(found, f"{field}_slope") @ way
        scale = np.abs(slope).max()
        np.testing.assert_allclose(predicted, slope, atol=1e-5 * scale)
        assert np.abs(predicted + slope).max() > scale  # the wrong sign would be noticed


def test_a_longer_dropper_lowers_its_clamp_as_that_between_two_strings(three_spans: BuiltLine) -> None:
    # Lengths keep the strings' distances elsewhere and loads their weighted sum of deflections, so that a
    # kink of both by d lowers the lower one by T2 / (T1 + T2) d, and nothing else moves.
    found = scheduled(three_spans)
    inside = [2, 3, 4]  # droppers of the first span with others on both sides
    tensions = [wire.tension.force for wire in three_spans.model.layout.wires]
    expected = -tensions[1] / sum(tensions)
    np.testing.assert_allclose(np.diag(found.height_slope)[inside], expected, rtol=0.01)
    beside = found.height_slope[inside, [1, 2, 3]]
    assert np.abs(beside).max() < 0.005


def test_a_dropper_that_may_push_tells_its_length(one_span: BuiltLine) -> None:
    found, points = scheduled(one_span), at_droppers(one_span)
    longer = found.length.copy()
    longer[3] += 0.08
    pushed = respond(one_span, points, longer, found)
    assert pushed.pull[3] < 0.0
    assert pushed.height_slope[3, 3] < -0.3  # a slack one would say 0
