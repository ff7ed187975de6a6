"""The extended force density method: its constraints' derivatives and its network."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
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


def test_a_deep_pre_sag_between_few_droppers_is_found(
    vary: Callable[[dict[str, Any]], Line], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Newton's method begins with forces that fit the kinks of the contact wire, and is lost without."""
    both = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 0.92}}
    line = vary(
        {
            "spans": (
                {
                    "length": 54.3,
                    "droppers": {"positions": (7.6, 28.6, 49.6)},
                    "contact_wire_height": (0.0, -0.162, 0.0),
                },
            ),
            "supports": (both, both),
            "contact_wire.tension.force": 6.6e3,
            "messenger_wire.tension.force": 7.6e3,
        }
    )
    task = string_line(line, "test")
    assert find_rest(task).iterations <= 8
    network = _Network.of(task)
    start = network.start()
    weight = 0.5 * task.contact.w * (np.diff(task.x, prepend=0.0) + np.diff(task.x, append=54.3))
    length = np.diff(start.z[network.edge[network.droppers]], axis=1)[:, 0] + task.height  # to a level wire
    level = _State(np.append(start.q[: -task.x.size], weight / length), start.x, start.z)
    monkeypatch.setattr(_Network, "start", lambda _: level)
    with pytest.raises(NotConvergedError, match="catenary equations"):
        find_rest(task)


def test_a_first_guess_upside_down_is_no_refusal(vary: Callable[[dict[str, Any]], Line]) -> None:
    """A low contact wire carries part of itself, so that the messenger hangs higher than was guessed."""
    both = {"contact_wire": {"height": 0.0}, "messenger_wire": {"height": 0.39}}
    span = {"length": 65.0, "droppers": {"positions": (4.0, 20.0, 45.0, 61.0)}, "contact_wire_height": -0.05}
    task = string_line(vary({"spans": (span,), "supports": (both, both)}), "test")
    network = _Network.of(task)
    start = network.start()
    assert np.min(np.diff(start.z[network.edge[network.droppers]], axis=1)) < 0.0
    assert np.min(find_rest(task).found.unstressed) > 0.0
