"""Small models and a dense Newton method for the tests of the mechanics layer.

The Newton method is deliberately not the package's own: no fault of the solvers may hide one here.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, UnknownsBuilder

LATE = 1e9  # a time at which every ramp is over


def _lay_wire(
    builder: UnknownsBuilder,
    start: Sequence[float],
    end: Sequence[float],
    knots: np.ndarray,
    section: Section,
) -> Chain:
    """Add a straight wire from start to end whose unstressed arc length is knots[-1] - knots[0]."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    slope = (b - a) / (knots[-1] - knots[0])
    nodes = np.array([builder.add_node(a + (s - knots[0]) * slope, slope) for s in knots])
    return Chain(nodes, knots, section)


def _solve_statics(
    system: System,
    z: np.ndarray,
    fixed: Sequence[int] | np.ndarray = (),
    load: np.ndarray | None = None,
    longest_step: float = 0.5,
) -> tuple[System, np.ndarray]:
    """Return system and equilibrium; unknowns in `fixed` keep their value, `load` is a dead load."""
    z = z.copy()
    free = np.setdiff1d(np.arange(z.size), np.asarray(fixed, dtype=int))
    bounded = ~system.unknowns.where(Kind.MULTIPLIER)[free]
    load = np.zeros(z.size) if load is None else load
    for _ in range(100):
        state = State.at_rest(z, LATE)
        jacobian = system.jacobian(state).toarray()[np.ix_(free, free)]
        step = np.linalg.solve(jacobian, (load - system.residual(state))[free])
        size = np.abs(step[bounded]).max()
        z[free] += step * min(1.0, longest_step / max(size, 1e-300))
        moved = system.relocate(z)  # at once: a cubic continued over several short elements leads nowhere
        if moved is None and size < 1e-9:
            return system, z
        system = system if moved is None else moved
    raise AssertionError("the test's Newton method did not converge")


@pytest.fixture(scope="session")
def lay_wire() -> Callable[..., Chain]:
    """Give `_lay_wire` to tests."""
    return _lay_wire


@pytest.fixture(scope="session")
def solve_statics() -> Callable[..., tuple[System, np.ndarray]]:
    """Give `_solve_statics` to tests."""
    return _solve_statics


@pytest.fixture(scope="session")
def turn() -> np.ndarray:
    """Return one generic rotation by about 2.2 rad, shape (3, 3)."""
    axis = np.array([0.5, -0.62, 0.31])
    axis /= np.linalg.norm(axis)
    cross = np.cross(np.eye(3), -axis)
    return np.eye(3) + np.sin(2.2) * cross + (1.0 - np.cos(2.2)) * cross @ cross
