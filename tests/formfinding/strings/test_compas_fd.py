"""The force density method against compas_fd, which is not ours; collected where that is installed."""

from __future__ import annotations

from importlib import import_module

import numpy as np

from catenaria.formfinding.strings import force_density


def test_heights_for_given_densities_are_those_of_compas_fd() -> None:
    """A chain that is held at some nodes, with uneven densities and loads."""
    rng = np.random.default_rng(7)
    n = 40
    q, load, z = rng.uniform(5e3, 9e3, n - 1), rng.uniform(5.0, 9.0, n), rng.normal(size=n)
    fixed = np.zeros(n, dtype=np.bool_)
    fixed[[0, 13, 14, n - 1]] = True
    found = force_density._heights(q, load, z, fixed)

    def theirs(density: np.ndarray) -> np.ndarray:
        result = import_module("compas_fd.solvers").fd_numpy(
            vertices=np.column_stack((np.arange(n, dtype=np.float64), np.zeros(n), z)),
            fixed=np.flatnonzero(fixed).tolist(),
            edges=[(i, i + 1) for i in range(n - 1)],
            forcedensities=density.tolist(),
            loads=np.column_stack((np.zeros((n, 2)), -load)),
        )
        return np.array(result.vertices)[:, 2]

    np.testing.assert_allclose(found, theirs(q), rtol=0.0, atol=1e-12)
    assert np.abs(found - theirs(1.001 * q)).max() > 1e-6
