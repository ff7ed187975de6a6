"""Distributions of errors: quantiles, moments, and streams of random numbers."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from catenaria.line.installation import DistributionKind
from catenaria.loading.distributions import Distributions

SAMPLES = 40_000


def one(kind: DistributionKind, scale: float = 2.0, mean: float = 0.5, clip: float = np.inf) -> Distributions:
    return Distributions((kind,), np.array([mean]), np.array([scale]), np.array([clip]))


PEERS = {
    "normal": (one("normal"), stats.norm(0.5, 2.0)),
    "cut normal": (one("normal", clip=1.5), stats.truncnorm(-1.5, 1.5, 0.5, 2.0)),
    "uniform": (one("uniform"), stats.uniform(-1.5, 4.0)),
    "triangular": (one("triangular"), stats.triang(0.5, -1.5, 4.0)),
}


@pytest.mark.parametrize("name", PEERS)
def test_quantiles_and_deviations_are_those_of_another_library(name: str) -> None:
    own, peer = PEERS[name]
    u = np.linspace(0.001, 0.999, 200)
    assert own.value(u[:, None])[:, 0] == pytest.approx(peer.ppf(u), abs=1e-12)
    assert own.deviation[0] == pytest.approx(peer.std(), rel=1e-12)


@pytest.mark.parametrize("name", PEERS)
def test_samples_are_distributed_so(name: str) -> None:
    own, peer = PEERS[name]
    x = own.draw(3, 0, SAMPLES)[:, 0]
    assert stats.kstest(np.asarray(peer.cdf(x)), "uniform").pvalue > 1e-3
    wrong = stats.norm(0.6, 2.0) if name == "normal" else stats.norm(peer.mean(), peer.std())
    assert stats.kstest(np.asarray(wrong.cdf(x)), "uniform").pvalue < 1e-3  # the test can tell


def test_a_sample_does_not_depend_on_how_many_are_drawn_at_once() -> None:
    many = Distributions.concatenate([one("normal"), one("uniform"), one("triangular")])
    whole = many.draw(7, 0, 300)
    parts = [many.draw(7, first, 50) for first in range(0, 300, 50)]
    assert np.array_equal(np.concatenate(parts), whole)
    assert np.array_equal(many.draw(7, 0, 1000)[:300], whole)
    assert not np.array_equal(many.draw(8, 0, 300), whole)
    assert np.unique(whole[:, 0]).size == 300


def test_errors_are_independent_of_each_other_and_from_sample_to_sample() -> None:
    many = Distributions.concatenate([one("normal")] * 3)
    x = many.draw(1, 0, SAMPLES)
    r = np.corrcoef(np.column_stack((x[1:], x[:-1])), rowvar=False)
    assert np.abs(r - np.eye(6)).max() < 5.0 / np.sqrt(SAMPLES)


def test_nothing_scatters_without_scale_and_nothing_is_drawn_of_nothing() -> None:
    assert np.array_equal(one("normal", scale=0.0).draw(1, 0, 5), np.full((5, 1), 0.5))
    assert Distributions.concatenate([]).draw(1, 10, 5).shape == (5, 0)


def test_values_are_finite_at_the_ends() -> None:
    ends = np.array([2.0**-54, 1.0 - 2.0**-53])[:, None]
    for own, _ in PEERS.values():
        assert np.isfinite(own.value(ends)).all()
