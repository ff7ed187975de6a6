"""A wire clamped at a material point."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.joints.clamps import Clamps
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]

WIRE = Chain(np.arange(18, dtype=np.int64).reshape(3, 6), np.array([0.0, 2.0, 5.0]), Section(1e6, 10.0, 1.0))
S, LA = np.array([18]), np.array([[19, 20, 21]])
X = np.array([[1.5, 0.2, -0.1]])
CLAMP = Clamps(WIRE, S, LA, np.array([0]), X)


def unknowns(s: float, force: FloatArray) -> FloatArray:
    """A straight wire along x, moved so that its point at s = 1.5 m is at X."""
    z = np.zeros(22)
    z[WIRE.nodes[:, 0]] = WIRE.knots
    z[WIRE.nodes[:, 1:3]] = X[0, 1:]
    z[WIRE.nodes[:, 3]] = 1.0
    z[S], z[LA[0]] = s, force
    return z


def residual(z: FloatArray) -> FloatArray:
    f = np.zeros(z.size)
    CLAMP.add_residual(State.at_rest(z), f)
    return f


def test_holds_the_material_point_and_no_other() -> None:
    held = residual(unknowns(1.5, np.zeros(3)))
    np.testing.assert_allclose(held, 0.0, atol=1e-15)
    other = residual(unknowns(1.6, np.zeros(3)))
    np.testing.assert_allclose(other[LA[0]], [0.1, 0.0, 0.0], atol=1e-15)


def test_the_force_acts_on_the_wire_where_it_is_clamped() -> None:
    force = np.array([300.0, -20.0, 50.0])
    f = residual(unknowns(1.5, force))
    on_wire = f[WIRE.nodes]
    np.testing.assert_allclose(on_wire[:, :3].sum(axis=0), force)
    arms = WIRE.knots[:, None] * on_wire[:, :3] + on_wire[:, 3:]
    np.testing.assert_allclose(arms.sum(axis=0), 1.5 * force)


def test_does_not_let_the_wire_slide() -> None:
    """Unlike a sliding joint it has no equation for s: a force along the wire stays."""
    f = residual(unknowns(1.5, np.array([300.0, 0.0, 0.0])))
    assert f[S] == 0.0
    with pytest.raises(AssertionError):
        np.testing.assert_allclose(f[WIRE.nodes], 0.0)


def test_moves_on_to_the_element_that_fits() -> None:
    moved = CLAMP.relocate(unknowns(2.5, np.zeros(3)))
    assert moved is not None
    assert moved.element.tolist() == [1]
    assert CLAMP.relocate(unknowns(1.0, np.zeros(3))) is None
