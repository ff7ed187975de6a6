"""Measured rows and the points of the line that they name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.errors import LineFileError
from catenaria.line.measured import MeasuredHeight, MeasuredHeights
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.gauged import gauged_points

MARKS = {name: (7, 3) for name in ("span", "dropper", "chainage_m", "height_m", "lower_wire")}
ROW = MeasuredHeight(0.002, 2, 3, float("nan"), "", MARKS)


def test_a_dropper_and_its_chainage_are_the_same_point(three_spans: BuiltLine) -> None:
    rows = (ROW, replace(ROW, span=0, number=0, chainage=88.0, wire="contact wire"))
    points = gauged_points(three_spans.line, three_spans.model, MeasuredHeights("h.csv", rows))
    np.testing.assert_allclose(points.chainage, 88.0)
    np.testing.assert_allclose(points.s[0], points.s[1], atol=1e-9)
    heights = points.height(three_spans.model, three_spans.at_rest.z)
    np.testing.assert_allclose(heights, three_spans.at_rest.height[9], atol=1e-9)


def test_between_droppers_the_wire_sags(three_spans: BuiltLine) -> None:
    rows = (replace(ROW, span=0, number=0, chainage=92.75),)
    points = gauged_points(three_spans.line, three_spans.model, MeasuredHeights("h.csv", rows))
    sag = 9.8 * 7710.0 * 120e-6 * 9.5**2 / (8.0 * 15e3)  # of a string; bending stiffness makes it less
    assert -sag < points.height(three_spans.model, three_spans.at_rest.z)[0] < -0.7 * sag


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        ((replace(ROW, span=4),), "h.csv:7:3: span: found 4; allowed: spans with droppers, 1 to 3"),
        ((replace(ROW, number=8),), "dropper: found 8; allowed: 1 to 7 in span 2"),
        ((ROW, replace(ROW, height=0.001)), "dropper 3 of span 2 again; allowed: each dropper once"),
        ((replace(ROW, height=5.5),), "height_m: found 5.5; allowed: metres above the track"),
        ((replace(ROW, height=2.0),), "within 0.5 m of the 0.000 m"),
        ((replace(ROW, wire="contct wire"),), "contact wire (did you mean contact wire?)"),
        ((replace(ROW, span=0, chainage=200.0),), "chainage_m: found 200; allowed: 0 to 195"),
    ],
)
def test_what_the_line_does_not_have_is_refused(
    three_spans: BuiltLine, rows: tuple[MeasuredHeight, ...], expected: str
) -> None:
    with pytest.raises(LineFileError) as caught:
        gauged_points(three_spans.line, three_spans.model, MeasuredHeights("h.csv", rows))
    assert expected in str(caught.value)
