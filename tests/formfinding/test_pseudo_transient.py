"""Steps from standstill find the rest of systems whose start has no stiffness; Newton's method does not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from catenaria.errors import NotConvergedError
from catenaria.formfinding.pseudo_transient import rest_by_steps
from catenaria.formfinding.static_problem import StaticProblem
from catenaria.solvers.newton import solve_newton
from catenaria.structure import Structure
from catenaria.structure.model import StructureModel, build_structure

HINGE = {"type": "spherical", "on": {"cable": "main", "point": "start"}}


def flexible(**changes: Any) -> StructureModel:
    """Return a cable without bending stiffness, level and free of strain between two hinges."""
    description: dict[str, Any] = {
        "format": 1,
        "gravity": 9.8,
        "sections": {"rope": {"EA": 1e5, "EJ": 0.0, "rhoA": 1.0}},
        "cables": {"main": {"section": "rope", "points": [[0, 0, 0], [10, 0, 0]], "elements": 10}},
        "joints": {"left": HINGE, "right": HINGE | {"on": {"cable": "main", "point": "end"}}},
        **changes,
    }
    return build_structure(Structure.model_validate(description))


def problem_of(model: StructureModel) -> StaticProblem:
    return StaticProblem(model.system, 1e-9, 1e-5)


def check_parabola(model: StructureModel, z: np.ndarray) -> None:
    """A flat rope that was straight: T^3 = EA (w L)^2/24, sag = w L^2/(8 T) (Irvine 1981)."""
    T = (1e5 * 98.0**2 / 24.0) ** (1.0 / 3.0)
    np.testing.assert_allclose(np.abs(z[model.joints[0].force[0]]), T, rtol=0.02)
    lowest = z[model.chains["main"].nodes[5, 2]]
    np.testing.assert_allclose(lowest, -9.8 * 100.0 / (8.0 * T), rtol=0.02)


def test_a_rope_without_any_stiffness_at_the_start() -> None:
    model = flexible()
    problem, z = problem_of(model), model.start
    with pytest.raises(NotConvergedError):
        solve_newton(problem, z)
    root, steps = rest_by_steps(problem, z)
    assert root.converged
    assert steps > 3
    check_parabola(model, root.y)
    assert np.abs(problem.residual(root.y)).max() < 1e-5
    with pytest.raises(AssertionError):
        check_parabola(model, 1.05 * root.y)


def test_what_has_no_rest_is_refused() -> None:
    """A cable that nothing holds falls, and the failure says so."""
    model = flexible(joints={})
    with pytest.raises(NotConvergedError, match="no way from the start"):
        rest_by_steps(problem_of(model), model.start)
