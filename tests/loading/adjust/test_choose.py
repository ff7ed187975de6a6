"""The choice of fewest droppers, against trying all of them."""

from __future__ import annotations

from itertools import combinations, product

import numpy as np
import pytest

from catenaria.loading.choose import Adjustable

STEP, TOLERANCE = 0.005, 0.005


def small(deviation: list[float], least: float = 0.0, largest: float = 0.02) -> Adjustable:
    """Return six droppers that act on each other."""
    n = len(deviation)
    distance = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    slope = -0.5 * 0.4**distance
    pull_slope = -2000.0 * np.where(distance == 0, 1.0, np.where(distance == 1, -0.4, 0.0))
    return Adjustable(
        np.array(deviation), slope, np.full(n, 60.0), pull_slope, np.full(n, least), STEP, largest
    )


def by_trying(options: Adjustable, tolerance: float, at_most: int) -> tuple[int, float]:
    """Return the fewest droppers within the tolerance (or n + 1), and the least tolerance of so many."""
    n, most = options.count, round(options.largest / STEP)
    fewest, best = n + 1, np.inf
    for count in range(at_most + 1):
        for chosen in combinations(range(n), count):
            for steps in product([*range(-most, 0), *range(1, most + 1)], repeat=count):
                change = np.zeros(n)
                change[list(chosen)] = STEP * np.array(steps, dtype=np.float64)
                if ((options.pull + options.pull_slope @ change) < options.least_pull - 1e-9).any():
                    continue
                off = float(np.abs(options.deviation + options.slope @ change).max())
                best = min(best, off)
                if off <= tolerance + 1e-12:
                    fewest = min(fewest, count)
    return fewest, best


@pytest.mark.parametrize("seed", range(6))
def test_no_pair_and_no_single_dropper_does_better(seed: int) -> None:
    deviation = np.random.default_rng(seed).normal(0.0, 0.006, 6).tolist()
    options = small(deviation)
    fewest, best = by_trying(options, TOLERANCE, 2)
    choice = options.fewest(TOLERANCE)
    if fewest <= 2:
        assert choice is not None
        assert choice.count == choice.fewest == fewest
    else:
        assert choice is None or choice.count > 2
    reached = options.best_tolerance(2)
    assert reached == pytest.approx(best, abs=1e-6)


def test_changes_are_whole_steps_within_their_limits() -> None:
    options = small([0.012, 0.0, -0.009, 0.0, 0.0, 0.011])
    choice = options.fewest(TOLERANCE)
    assert choice is not None
    assert choice.count > 0
    np.testing.assert_allclose(choice.change / STEP, np.round(choice.change / STEP), atol=1e-12)
    assert np.abs(choice.change).max() <= options.largest
    assert np.abs(options.deviation + options.slope @ choice.change).max() <= TOLERANCE + 1e-9


def test_forces_forbid_what_heights_would_allow() -> None:
    deviation = [0.0, 0.0, 0.012, 0.0, 0.0, 0.0]  # too high: to be longer, and so to bear less
    free, bound = small(deviation), small(deviation, least=40.0)
    choice = free.fewest(TOLERANCE)
    assert choice is not None
    assert (free.pull + free.pull_slope @ choice.change).min() < 40.0
    held = bound.fewest(TOLERANCE)
    assert held is None or (bound.pull + bound.pull_slope @ held.change).min() >= 40.0 - 1e-6


def test_nothing_is_changed_within_the_tolerance() -> None:
    choice = small([0.004, -0.0049, 0.0, 0.003, 0.0, 0.0]).fewest(TOLERANCE)
    assert choice is not None
    assert choice.count == choice.fewest == 0


def test_what_cannot_be_reached_is_said() -> None:
    options = small([0.05, 0.0, 0.0, 0.0, 0.0, 0.0], largest=0.005)
    assert options.fewest(TOLERANCE) is None
    best = options.best_tolerance(6)
    assert best is not None
    assert TOLERANCE < best < 0.05


def test_deviations_about_a_change_are_those_without_it() -> None:
    options = small([0.01, 0.0, 0.0, 0.0, -0.01, 0.0])
    change = np.array([0.01, 0.0, 0.0, 0.0, 0.0, 0.0])
    there = options.deviation + options.slope @ change, options.pull + options.pull_slope @ change
    again = options.about(*there, change)
    np.testing.assert_allclose(again.deviation, options.deviation, atol=1e-15)
    np.testing.assert_allclose(again.pull, options.pull, atol=1e-12)
