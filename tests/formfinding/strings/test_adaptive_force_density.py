"""The adaptive force density method: its linear system and its rate of convergence."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.formfinding.strings import adaptive_force_density
from catenaria.formfinding.strings.adaptive_force_density import _Network, find_rest
from catenaria.formfinding.strings.task import StringLine


def test_the_banded_solve_is_that_of_the_network(task: StringLine) -> None:
    net = _Network.of(task)
    z, _, _ = net.start()
    rng = np.random.default_rng(5)
    q, load = rng.uniform(10.0, 20.0, net.edge.shape[0]), rng.uniform(1.0, 2.0, z.size)
    found = net._solve(q, load, z)
    C = np.zeros((q.size, z.size))
    branch = np.arange(q.size)
    C[branch, net.edge[:, 0]], C[branch, net.edge[:, 1]] = -1.0, 1.0
    residual = C.T @ (q * (C @ found)) + load
    free = net.place >= 0
    np.testing.assert_allclose(residual[free], 0.0, atol=1e-10)
    np.testing.assert_array_equal(found[~free], z[~free])
    off = C.T @ (1.001 * q * (C @ found)) + load
    assert np.abs(off[free]).max() > 1e-4


def test_errors_shrink_as_densities_and_stiffness_say(
    task: StringLine, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The slowest error shrinks by 1 - lambda, the smallest eigenvalue of (K + Q)^-1 Q."""

    def passes(enough: float) -> int:
        monkeypatch.setattr(adaptive_force_density, "_ENOUGH", enough)
        return find_rest(task).iterations

    a_digit = 0.5 * (passes(1e-7) - passes(1e-5))
    found = find_rest(task).found
    contact, messenger = found.contact, found.messenger
    length = messenger.r[messenger.clamp, 2] - contact.r[contact.clamp, 2]
    Q = np.diag(contact.force[contact.clamp, 2] / length)
    h = np.diff(task.contact.joints(task.x).x)
    K = 15e3 * (np.diag(1.0 / h[:-1] + 1.0 / h[1:]) - np.diag(1.0 / h[1:-1], 1) - np.diag(1.0 / h[1:-1], -1))
    slowest = float(np.min(np.linalg.eigvals(np.linalg.solve(K + Q, Q)).real))
    assert a_digit == pytest.approx(-np.log(10.0) / np.log1p(-slowest), rel=0.1)


def test_an_end_without_agreement_is_a_failure(task: StringLine, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adaptive_force_density, "_MOST", 50)
    with pytest.raises(NotConvergedError, match=r"mm off after 50 passes.*extended"):
        find_rest(task)
