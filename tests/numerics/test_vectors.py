"""Sizes of vectors against those of numpy."""

from __future__ import annotations

import numpy as np

from catenaria.numerics.vectors import cross_sizes, sizes


def test_sizes_are_those_of_numpy() -> None:
    a, b = np.random.default_rng(3).normal(size=(2, 50, 3))
    np.testing.assert_allclose(sizes(a), np.linalg.norm(a, axis=1), rtol=1e-14)
    np.testing.assert_allclose(cross_sizes(a, b), np.linalg.norm(np.cross(a, b), axis=1), rtol=1e-12)
    assert not np.allclose(cross_sizes(a, b), cross_sizes(a, b[:, ::-1]))
