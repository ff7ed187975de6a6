"""The extended force density method: its constraints' derivatives and its network."""

from __future__ import annotations

import numpy as np
import pytest

from catenaria.formfinding.strings.extended_force_density import _Network, _State, find_rest
from catenaria.formfinding.strings.task import StringLine, string_line
from catenaria.line import Line


@pytest.fixture(scope="module", params=["paper", "uneven"])
def any_task(request: pytest.FixtureRequest, task: StringLine, uneven: Line) -> StringLine:
    return task if request.param == "paper" else string_line(uneven, "test")


def test_there_are_as_many_constraints_as_branches(any_task: StringLine) -> None:
    network = _Network.of(any_task)
    g, _, _, g_q = network._constraints(*network.start())
    assert g.size == g_q.shape[0] == network.edge.shape[0]


def test_derivatives_of_constraints_are_exact(any_task: StringLine) -> None:
    """Against differences; weights are held by the pass, so that their change with z and q is left out."""
    network = _Network.of(any_task)
    rng = np.random.default_rng(2)
    q, x, z = network.start()
    x, z = x + 1e-3 * rng.normal(size=x.size), z + 1e-3 * rng.normal(size=z.size)
    direction = _State(rng.normal(size=q.size), rng.normal(size=x.size), rng.normal(size=z.size))

    def constraints(h: float) -> np.ndarray:
        parts = zip((q, x, z), direction, strict=True)
        return network._constraints(*(value + h * change for value, change in parts))[0]

    _, g_x, g_z, g_q = network._constraints(q, x, z)
    slope = g_q @ direction.q + g_x @ direction.x + g_z @ direction.z
    difference = (constraints(1e-6) - constraints(-1e-6)) / 2e-6
    np.testing.assert_allclose(slope, difference, atol=2e-4)
    assert np.abs(1.01 * slope - difference).max() > 2e-4


def test_newton_converges_in_a_few_passes(any_task: StringLine) -> None:
    assert find_rest(any_task).iterations <= 8


def test_branches_balance_the_loads(task: StringLine) -> None:
    """C^T Q C x = 0 and C^T Q C z = -p at free nodes, also where droppers join the wires."""
    network = _Network.of(task)
    state = network.start()
    for _ in range(6):
        load, _ = network.loads(state)
        state = network.step(state, load)
    C = network._branch_node(state.x.size)
    load, _ = network.loads(state)
    for coordinate, outer in ((state.x, 0.0 * load), (state.z, load)):
        residual = C.T @ (state.q * (C @ coordinate)) + outer
        np.testing.assert_allclose(residual[network.free], 0.0, atol=1e-6)
    off = C.T @ (1.001 * state.q * (C @ state.z)) + load
    assert np.abs(off[network.free]).max() > 0.01
