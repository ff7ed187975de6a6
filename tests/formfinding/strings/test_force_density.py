"""The force density method: equilibrium of its nodes, and convergence with its elements."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.formfinding.strings import force_density, separated
from catenaria.formfinding.strings.task import StringLine


def test_fewer_nodes_leave_an_error_of_second_order(
    task: StringLine, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Lumped weight acts at the middle of an element, which is not quite where it is."""
    exact = separated.find_rest(task).found

    def error(largest: float) -> float:
        monkeypatch.setattr(force_density, "_LARGEST", largest)
        found = force_density.find_rest(task).found
        return float(np.max(np.abs(found.messenger.r - exact.messenger.r)))

    coarse, fine = error(10.0), error(2.5)
    assert fine < coarse / 10.0
    assert 1e-9 < coarse < 1e-5


def test_nodes_are_in_equilibrium_for_given_densities() -> None:
    """D z = -p - D_f z_f against a dense branch-node matrix, [18]."""
    rng = np.random.default_rng(3)
    n = 12
    q, load, z = rng.uniform(5.0, 9.0, n - 1), rng.uniform(1.0, 2.0, n), rng.normal(size=n)
    fixed = np.zeros(n, dtype=np.bool_)
    fixed[[0, 4, 5, n - 1]] = True
    found = force_density._heights(q, load, z, fixed)
    C = np.diff(np.eye(n), axis=0)
    residual = C.T @ (q * (C @ found)) + load
    np.testing.assert_allclose(residual[~fixed], 0.0, atol=1e-12)
    np.testing.assert_array_equal(found[fixed], z[fixed])
    off = force_density._heights(1.01 * q, load, z, fixed)
    assert np.abs(C.T @ (q * (C @ off)) + load)[~fixed].max() > 1e-3
