"""Supports as springs: a force that is the gradient of the energy, normal to the wire; exact stiffness."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.formfinding.elastic_supports import ElasticSupports
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]

STIFFNESS = 1e3


@pytest.fixture
def z() -> FloatArray:
    """Four nodes of a wire that winds through space."""
    generator = np.random.default_rng(5)
    nodes = np.zeros((4, 6))
    nodes[:, 0], nodes[:, 3] = 2.0 * np.arange(4.0), 1.0
    return (nodes + 0.1 * generator.normal(size=nodes.shape)).ravel()


@pytest.fixture
def supports() -> ElasticSupports:
    """Two springs to points beside the wire."""
    wire = Chain(np.arange(24).reshape(4, 6), 2.0 * np.arange(4.0), Section(1e6, 10.0, 1.0))
    X = np.array([[1.2, 0.3, -0.2], [4.5, -0.2, 0.4]])
    return ElasticSupports(wire, X, np.array([1.0, 4.6]), STIFFNESS)


def energy(supports: ElasticSupports, z: FloatArray) -> float:
    """Return k/2 times the smallest squared distances, found by looking everywhere."""
    s = np.linspace(0.0, supports.wire.knots[-1], 20_001)
    r = supports.wire.evaluate(z, s).r
    return sum(0.5 * STIFFNESS * float(np.min(np.sum((r - X) ** 2, axis=1))) for X in supports.X)


def gradient(supports: ElasticSupports, z: FloatArray) -> FloatArray:
    f = np.zeros(z.size)
    supports.add_residual(State(0.0, z, z, z), f)
    return f


def check_gradient(supports: ElasticSupports, z: FloatArray, at: FloatArray) -> None:
    """The gradient at `at` is that of the energy at z."""
    h, eye = 1e-3, np.eye(z.size)
    numeric = [(energy(supports, z + h * e) - energy(supports, z - h * e)) / (2.0 * h) for e in eye]
    # h^2 of the difference quotient, and the spacing of the search
    np.testing.assert_allclose(gradient(supports, at), numeric, atol=2e-3 * STIFFNESS)


def test_the_force_is_the_gradient_of_the_smallest_distance(supports: ElasticSupports, z: FloatArray) -> None:
    check_gradient(supports, z, z)


def test_another_place_would_be_noticed(supports: ElasticSupports, z: FloatArray) -> None:
    with pytest.raises(AssertionError):
        check_gradient(supports, z, z + 0.02)


def test_the_force_is_normal_to_the_wire(supports: ElasticSupports, z: FloatArray) -> None:
    s, point = supports.closest(z)
    force = supports.force(point)
    assert np.abs(np.sum(force * point.r1, axis=1)).max() < 1e-12 * STIFFNESS
    aside = supports.wire.evaluate(z, s + 0.1)
    assert np.abs(np.sum(supports.force(point) * aside.r1, axis=1)).max() > 1e-3 * STIFFNESS


def check_stiffness(supports: ElasticSupports, other: ElasticSupports, z: FloatArray) -> None:
    """The stiffness of one is the derivative of the force of the other."""
    dofs, matrices = supports.stiffness(z)
    K = np.zeros((z.size, z.size))
    for row, matrix in zip(dofs, matrices, strict=True):
        K[np.ix_(row, row)] += matrix
    h, eye = 1e-6, np.eye(z.size)
    numeric = np.array([(gradient(other, z + h * e) - gradient(other, z - h * e)) / (2.0 * h) for e in eye])
    np.testing.assert_allclose(K, numeric, atol=1e-7 * STIFFNESS)
    np.testing.assert_allclose(K, K.T, atol=1e-12 * STIFFNESS)


def test_the_stiffness_is_exact(supports: ElasticSupports, z: FloatArray) -> None:
    check_stiffness(supports, supports, z)


def test_a_softer_spring_would_be_noticed(supports: ElasticSupports, z: FloatArray) -> None:
    with pytest.raises(AssertionError):
        check_stiffness(replace(supports, k=(1.0 - 1e-5) * STIFFNESS), supports, z)


def test_it_does_not_matter_where_the_search_begins(supports: ElasticSupports, z: FloatArray) -> None:
    elsewhere = replace(supports, s=supports.s + np.array([0.4, -0.5]))
    np.testing.assert_allclose(elsewhere.closest(z)[0], supports.closest(z)[0], atol=1e-9)


def test_a_point_without_a_closest_one_is_refused(supports: ElasticSupports) -> None:
    """A straight wire has a closest point at once; a motion that blew up has none."""
    straight = np.zeros((4, 6))
    straight[:, 0], straight[:, 3] = 2.0 * np.arange(4.0), 1.0
    np.testing.assert_allclose(supports.closest(straight.ravel())[0], supports.X[:, 0], atol=1e-9)
    with pytest.raises(NotConvergedError, match="lost a support"):
        supports.closest(np.full(24, np.nan))
