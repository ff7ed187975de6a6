"""The textbook's wire under wind: its differential equation, its extremes, its printed formulas."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from catenaria.catenary.blow_off import BlownSpan

SPANS = [
    BlownSpan(60.0, 0.2, 0.2, 8.0, 12e3),
    BlownSpan(60.0, 0.2, -0.2, 8.0, 12e3),
    BlownSpan(50.0, -0.3, 0.1, -9.0, 15e3),
    BlownSpan(50.0, 0.2, 0.3, 5.0, 10e3, 1.0 / 900.0),
]


def check_course(span: BlownSpan, curvature: float) -> None:
    """H y'' = -q' in a straight, and the track bends away by its curvature; ends stay where they are."""
    x = np.linspace(0.0, span.length, 7)
    h = 0.01
    bend = (span.lateral(x + h) - 2.0 * span.lateral(x) + span.lateral(x - h)) / h**2
    np.testing.assert_allclose(bend, -span.load / span.tension - curvature, rtol=1e-6)
    np.testing.assert_allclose(
        span.lateral([0.0, span.length]), [span.stagger_start, span.stagger_end], atol=1e-15
    )


@pytest.mark.parametrize("span", SPANS)
def test_course(span: BlownSpan) -> None:
    check_course(span, span.curvature)
    with pytest.raises(AssertionError):
        check_course(replace(span, curvature=span.curvature + 1e-4), span.curvature)


@pytest.mark.parametrize("span", SPANS)
def test_furthest_is_the_largest_of_many_points(span: BlownSpan) -> None:
    x = np.linspace(0.0, span.length, 60001)
    y = span.lateral(x)
    i = int(np.argmax(np.abs(y)))
    place, lateral = span.furthest
    assert lateral == pytest.approx(float(y[i]), abs=1e-9)
    assert place == pytest.approx(float(x[i]), abs=2e-3)


def test_printed_formula() -> None:
    """The vertex is at q' a^2/(8 H) + (b1 + b2)/2 + H (b1 - b2)^2/(2 q' a^2)."""
    a, b1, b2, q, H = 60.0, 0.2, -0.1, 8.0, 12e3
    printed = q * a**2 / (8.0 * H) + (b1 + b2) / 2.0 + H * (b1 - b2) ** 2 / (2.0 * q * a**2)
    assert abs(b2 - b1) < q * a**2 / (2.0 * H)
    assert BlownSpan(a, b1, b2, q, H).furthest[1] == pytest.approx(printed, rel=1e-12)
    assert BlownSpan(a, b1, b2, 1.01 * q, H).furthest[1] != pytest.approx(printed, rel=1e-3)


def test_without_wind_a_support_is_furthest() -> None:
    assert BlownSpan(60.0, 0.1, -0.3, 0.0, 12e3).furthest == pytest.approx((60.0, -0.3))
    assert BlownSpan(60.0, 0.3, -0.1, 0.1, 12e3).furthest == pytest.approx(
        (0.0, 0.3)
    )  # the vertex is outside
