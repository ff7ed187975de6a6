"""The audit's own mechanics against closed forms: quadrature, cubics, strain energy, weight."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from catenaria.audit.curve import Curve, shape_functions
from catenaria.audit.energy import elastic_force, nodal_residual, weight
from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.audit.stated import Conductor

FloatArray = NDArray[np.float64]

WIRE = Conductor("contact", 15.6e6, 400.0, 0.9252)


def straight(stretch: float = 1.0, length: float = 2.0) -> Curve:
    s = np.array([0.0, 0.7 * length, length])
    along = np.array([1.0, 0.0, 0.0])
    return Curve(s, stretch * np.outer(s, along), stretch * np.tile(along, (3, 1)))


def bent(seed: int = 3) -> Curve:
    """A generic configuration in space, strained by some per cent."""
    noise = np.random.default_rng(seed).normal(size=(2, 3, 3))
    plain = straight(1.01)
    return Curve(plain.s, plain.r + 0.03 * noise[0], plain.r1 + 0.05 * noise[1])


@pytest.mark.parametrize("degree", range(14))
def test_quadrature_is_exact_to_degree_13(degree: int) -> None:
    points, weights = clenshaw_curtis(12)
    assert weights @ points**degree == pytest.approx(1.0 / (degree + 1), abs=1e-14)


def test_quadrature_is_not_exact_beyond() -> None:
    points, weights = clenshaw_curtis(4)
    assert abs(weights @ points**6 - 1.0 / 7.0) > 1e-4


def test_a_cubic_is_reproduced_with_its_derivatives() -> None:
    coefficient = np.random.default_rng(1).normal(size=(4, 3))

    def cubic(s: FloatArray, order: int) -> FloatArray:
        powers = np.polynomial.polynomial.polyder(coefficient, order)
        return np.asarray(np.polynomial.polynomial.polyval(s, powers).T, dtype=np.float64)

    s = np.array([0.0, 0.8, 2.0])
    curve = Curve(s, cubic(s, 0), cubic(s, 1))
    at = np.linspace(0.0, 2.0, 11)
    points = curve.at(at)
    np.testing.assert_allclose(points.r, cubic(at, 0), atol=1e-13)
    np.testing.assert_allclose(points.r1, cubic(at, 1), atol=1e-13)
    np.testing.assert_allclose(points.r2, cubic(at, 2), atol=1e-12)


def test_shape_functions_add_up_to_one() -> None:
    N = shape_functions(np.linspace(0.0, 1.0, 5), np.array(2.0), 0)
    np.testing.assert_allclose(N[:, 0] + N[:, 2], 1.0, atol=1e-15)


def test_a_uniformly_stretched_wire_pulls_with_the_closed_form() -> None:
    """Force EA eps |r'| at both ends, none inside."""
    x = 1.002
    force = WIRE.EA * 0.5 * (x**2 - 1.0) * x
    residual = nodal_residual(straight(x), WIRE, 0.0, np.empty(0), np.empty((0, 3)))
    np.testing.assert_allclose(residual[:, 0, 0], [-force, 0.0, force], rtol=1e-11, atol=1e-6)
    np.testing.assert_allclose(residual[:, 1], 0.0, atol=1e-6)


def test_small_deflections_meet_the_stiffness_of_a_beam() -> None:
    """12 EJ/L^3, 6 EJ/L^2, 4 EJ/L and 2 EJ/L of Euler-Bernoulli; strains are of second order."""
    L, w = 1.5, 1e-7
    EJ = WIRE.EJ
    beam = (
        EJ
        / L**3
        * np.array(
            [
                [12.0, 6.0 * L, -12.0, 6.0 * L],
                [6.0 * L, 4.0 * L**2, -6.0 * L, 2.0 * L**2],
                [-12.0, -6.0 * L, 12.0, -6.0 * L],
                [6.0 * L, 2.0 * L**2, -6.0 * L, 4.0 * L**2],
            ]
        )
    )
    for k in range(4):
        q = np.zeros(4)
        q[k] = w
        r = np.array([[0.0, 0.0, q[0]], [L, 0.0, q[2]]])
        r1 = np.array([[1.0, 0.0, q[1]], [1.0, 0.0, q[3]]])
        force = elastic_force(Curve(np.array([0.0, L]), r, r1), WIRE)[0, :, 2]
        np.testing.assert_allclose(force / w, beam[:, k], rtol=1e-6, atol=1e-6 * EJ)


def check_rigid(force: FloatArray, curve: Curve) -> None:
    """An energy that does not change in rigid motion has neither resultant force nor resultant moment."""
    q = curve.q
    np.testing.assert_allclose(force[:, 0] + force[:, 2], 0.0, atol=1e-6)
    np.testing.assert_allclose(np.cross(q, force).sum(axis=1), 0.0, atol=1e-6)


def test_inner_forces_are_in_balance() -> None:
    check_rigid(elastic_force(bent(), WIRE), bent())


def test_a_force_that_does_not_come_from_an_energy_is_noticed() -> None:
    force = elastic_force(bent(), WIRE)
    force[0, 1, 2] *= 1.0 + 1e-6
    with pytest.raises(AssertionError):
        check_rigid(force, bent())


def test_complex_step_meets_differences_of_the_energy() -> None:
    """Work of the forces over a small motion is the change of the energy, integrated separately."""
    direction = np.random.default_rng(5).normal(size=(2, 3, 3))

    def energy(h: float) -> float:
        plain = bent()
        curve = Curve(plain.s, plain.r + h * direction[0], plain.r1 + h * direction[1])
        points, weights = np.polynomial.legendre.leggauss(20)
        total = 0.0
        for s, L in zip(curve.s, curve.L, strict=False):
            at = curve.at(s + 0.5 * L * (points + 1.0))
            a = np.sum(at.r1**2, axis=1)
            kappa = np.linalg.norm(np.cross(at.r1, at.r2), axis=1) / a**1.5
            density = 0.5 * WIRE.EA * (0.5 * (a - 1.0)) ** 2 + 0.5 * WIRE.EJ * kappa**2
            total += 0.5 * L * float(weights @ density)
        return total

    force = nodal_residual(bent(), WIRE, 0.0, np.empty(0), np.empty((0, 3)))
    work = np.sum(force[:, 0] * direction[0]) + np.sum(force[:, 1] * direction[1])
    h = 1e-5
    assert (energy(h) - energy(-h)) / (2.0 * h) == pytest.approx(work, rel=1e-6)


def test_weight_is_that_of_the_unstressed_length() -> None:
    load = weight(bent(), WIRE.rhoA, 9.8)
    assert (load[:, 0] + load[:, 2]).sum(axis=0) == pytest.approx([0.0, 0.0, -9.8 * 0.9252 * 2.0], rel=1e-12)


def test_a_joint_that_takes_the_load_leaves_no_residual_force() -> None:
    """Shape functions of a point add up to one: total residual is elastic (none) less load less joint."""
    curve = bent()
    lift = np.array([[0.0, 0.0, 9.8 * 0.9252 * 2.0]])
    residual = nodal_residual(curve, WIRE, 9.8, np.array([0.9]), lift)
    np.testing.assert_allclose(residual[:, 0].sum(axis=0), 0.0, atol=1e-7)
