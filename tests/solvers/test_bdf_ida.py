"""SUNDIALS IDA (scikit-sundae) on an index-reduced form as an independent reference for the index-3 runs."""

from __future__ import annotations

import numpy as np
import pytest
from sksundae.ida import IDA  # pyright: ignore[reportMissingImports]  # compiled, without stubs

from catenaria.solvers import Options, Start, integrate

GRAVITY = 9.81


@pytest.fixture
def chain(base_problem, to_sparse):
    """Point masses of 1 kg on rigid links of 1 m, hung at the origin: positions, then multipliers."""

    class Chain(base_problem):
        def __init__(self, links, error, newton):
            self.links = links
            super().__init__([2] * (2 * links) + [0] * links, range(2 * links, 3 * links), error, newton)

        def constraints(self, q):
            """Return g = (|d_i|^2 - 1) / 2 and its Jacobian."""
            n = self.links
            d = np.diff(q.reshape(n, 2), axis=0, prepend=0.0)
            G = np.zeros((n, 2 * n))
            for i in range(n):
                G[i, 2 * i : 2 * i + 2] = d[i]
                if i:
                    G[i, 2 * i - 2 : 2 * i] = -d[i]
            return 0.5 * ((d * d).sum(axis=1) - 1.0), G

        def residual(self, t, y, yd, ydd):
            n = 2 * self.links
            g, G = self.constraints(y[:n])
            dynamic = ydd[:n] + G.T @ y[n:]
            dynamic[1::2] += GRAVITY
            return np.concatenate((dynamic, g))

        def jacobian(self, t, y, yd, ydd, c1, c2):
            n = 2 * self.links
            _, G = self.constraints(y[:n])
            la = np.append(y[n:], 0.0)
            K = np.kron(np.diag(la[:-1] + la[1:]) - np.diag(la[1:-1], 1) - np.diag(la[1:-1], -1), np.eye(2))
            matrix = np.block([[K + c2 * np.eye(n), G.T], [G, np.zeros((self.links, self.links))]])
            return to_sparse(matrix)

    return Chain


def index_one(problem):
    """Return the residual of q' = v, v' + G' la = f, G v' + |d'|^2 = 0 and the size of its unknowns."""
    n = 2 * problem.links

    def residual(t, y, yd, out):
        q, v, la = y[:n], y[n : 2 * n], y[2 * n :]
        _, G = problem.constraints(q)
        rates = np.diff(v.reshape(-1, 2), axis=0, prepend=0.0)
        out[:n] = yd[:n] - v
        out[n : 2 * n] = yd[n : 2 * n] + G.T @ la
        out[n + 1 : 2 * n : 2] += GRAVITY
        out[2 * n :] = G @ yd[n : 2 * n] + (rates * rates).sum(axis=1)

    return residual, n


def reference(problem, q, t_end):
    """Return q, v, la at t_end by IDA, started at rest with consistent accelerations."""
    residual, n = index_one(problem)
    m = problem.links
    _, G = problem.constraints(q)
    gravity = np.tile([0.0, -GRAVITY], m)
    la = np.linalg.solve(G @ G.T, G @ gravity)
    y = np.concatenate((q, np.zeros(n), la))
    yd = np.concatenate((np.zeros(n), gravity - G.T @ la, np.zeros(m)))
    solver = IDA(
        residual, algebraic_idx=np.arange(2 * n, 2 * n + m), rtol=1e-10, atol=1e-10, max_num_steps=100_000
    )
    solution = solver.solve(np.array([0.0, t_end]), y, yd)
    assert solution.success
    end = solution.y[-1]
    return end[:n], end[n : 2 * n], end[2 * n :], la


@pytest.mark.parametrize(("links", "t_end"), [(1, 1.5), (4, 1.0)])
def test_pendulum_and_chain_agree_with_ida(chain, links, t_end):
    """Positions to 1 um, velocities and multipliers (relative) to five digits."""
    problem = chain(links, 1e-8, 1e-12)
    q = np.ravel([[0.8 * (i + 1), -0.6 * (i + 1)] for i in range(links)])
    q_ref, v_ref, la_ref, la_start = reference(problem, q, t_end)
    begin = Start(0.0, np.concatenate((q, la_start)), np.zeros(3 * links))
    solution = integrate(problem, begin, t_end, Options(max_order=5, max_step=2e-3))
    n = 2 * links
    assert np.abs(solution.y[-1, :n] - q_ref).max() < 1e-6
    assert np.abs(solution.yd[-1, :n] - v_ref).max() < 5e-6
    assert np.abs(solution.y[-1, n:] - la_ref).max() < 5e-6 * np.abs(la_ref).max()
    assert np.abs(q_ref - q).max() > 0.1


def test_negative_control_another_gravity_does_not_agree(chain, monkeypatch):
    problem = chain(1, 1e-6, 1e-10)
    q = np.array([0.8, -0.6])
    q_ref, _, _, la = reference(problem, q, 1.0)
    monkeypatch.setitem(globals(), "GRAVITY", 1.001 * GRAVITY)
    solution = integrate(problem, Start(0.0, np.array([*q, *la]), np.zeros(3)), 1.0)
    assert np.abs(solution.y[-1, :2] - q_ref).max() > 1e-4
