"""Shares of variance, sensitivity indices and confidence limits against what is known of them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from catenaria.loading.importance import (
    confidence_limits,
    first_order_index,
    rank_correlation,
    shares,
    variance_parts,
)

N = 20_000


@pytest.fixture(scope="module")
def x() -> np.ndarray:
    return np.random.default_rng(5).uniform(-np.pi, np.pi, (N, 3))


def test_indices_of_a_sum_are_its_shares_of_variance(x: np.ndarray) -> None:
    y = 3.0 * x[:, 0] + x[:, 1]
    assert first_order_index(x[:, 0], y) == pytest.approx(0.9, abs=0.01)
    assert first_order_index(x[:, 1], y) == pytest.approx(0.1, abs=0.02)
    assert first_order_index(x[:, 2], y) == pytest.approx(0.0, abs=0.01)


def test_indices_of_ishigamis_function_are_the_closed_ones(x: np.ndarray) -> None:
    a, b = 7.0, 0.1  # Ishigami & Homma 1990
    y = np.sin(x[:, 0]) + a * np.sin(x[:, 1]) ** 2 + b * x[:, 2] ** 4 * np.sin(x[:, 0])
    total = 0.5 + a**2 / 8 + b * np.pi**4 / 5 + b**2 * np.pi**8 / 18
    closed = (0.5 * (1 + b * np.pi**4 / 5) ** 2 / total, a**2 / 8 / total, 0.0)
    assert [first_order_index(x[:, i], y) for i in range(3)] == pytest.approx(closed, abs=0.02)
    assert abs(rank_correlation(x[:, 1], y)) < 0.05  # which ranks do not see


def test_ranks_see_what_is_monotonous(x: np.ndarray) -> None:
    assert rank_correlation(x[:, 0], np.exp(x[:, 0])) == pytest.approx(1.0)
    assert rank_correlation(x[:, 0], -(x[:, 0] ** 3)) == pytest.approx(-1.0)
    y = x[:, 0] + x[:, 1]
    assert rank_correlation(x[:, 0], y) == pytest.approx(stats.spearmanr(x[:, 0], y).statistic, abs=1e-12)


def test_what_is_constant_has_no_share() -> None:
    one = np.ones(100)
    assert first_order_index(np.arange(100.0), one) == rank_correlation(one, np.arange(100.0)) == 0.0
    parts = variance_parts(np.zeros((2, 3)), np.ones(3))
    assert not shares(parts, [np.array([True, False, True])]).any()


def test_parts_of_the_variance_are_those_of_independent_errors() -> None:
    slope, deviation = np.array([[1.0, 2.0, 0.0], [0.0, 1.0, 3.0]]), np.array([2.0, 1.0, 1.0])
    parts = variance_parts(slope, deviation)
    assert np.array_equal(parts, [[4.0, 4.0, 0.0], [0.0, 1.0, 9.0]])
    groups = [np.array([True, True, False]), np.array([False, False, True])]
    assert shares(parts, groups) == pytest.approx(np.array([[1.0, 0.1], [0.0, 0.9]]))


@pytest.mark.parametrize(("count", "samples"), [(0, 50), (1, 50), (17, 50), (50, 50), (13, 10_000)])
def test_limits_are_those_of_another_library(count: int, samples: int) -> None:
    lower, upper = confidence_limits(np.array([count]), samples)
    peer = stats.binomtest(count, samples).proportion_ci(0.95, method="exact")
    assert (lower[0], upper[0]) == pytest.approx((peer.low, peer.high), rel=1e-9)


def test_limits_hold_in_nineteen_of_twenty_cases() -> None:
    p, samples = 0.13, 400
    counts = np.random.default_rng(2).binomial(samples, p, 4000)
    lower, upper = confidence_limits(counts, samples)
    assert 0.945 < np.mean((lower <= p) & (p <= upper)) < 0.97
    narrow = confidence_limits(counts, samples, 0.8)
    assert np.mean((narrow[0] <= p) & (p <= narrow[1])) < 0.9
