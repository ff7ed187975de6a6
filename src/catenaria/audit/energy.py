"""Strain energy and weight of a wire, and the forces that hold every node in balance with them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.curve import INTERVALS, Curve, shape_functions
from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.audit.stated import Conductor

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

STEP = 1e-30  # complex steps have no cancellation, so the step may vanish against everything


def elastic_force(curve: Curve, conductor: Conductor) -> FloatArray:
    r"""Return dU/dq of every element, the generalised forces that deform it.

    Parameters
    ----------
    curve : Curve
        Nodes of the wire.
    conductor : Conductor
        EA and EJ.

    Returns
    -------
    FloatArray, shape (n_elements, 4, 3)
        Forces on r_i and r_j [N], moments per slope on r_i' and r_j' [N m].

    Notes
    -----
    The density of energy (8) with Green strain (9) and curvature (10) is differentiated by r' and r'' by
    complex step (Squire & Trapp 1998), :math:`\partial u/\partial a = \mathrm{Im}\,u(a + ih)/h`, one pass for
    each of the six components in all points at once. No derivative is written down, so none can be wrong.
    r' and r'' are linear in the coordinates, with the derivatives of the shape functions as coefficients.
    """
    t, weights = clenshaw_curtis(INTERVALS)
    L = curve.L[:, None]
    N1, N2 = (shape_functions(np.broadcast_to(t, (L.size, t.size)), L, order) for order in (1, 2))
    weights = weights * L
    by_r1, by_r2 = np.empty_like(curve.slopes), np.empty_like(curve.slopes)
    r1, r2 = curve.slopes.astype(np.complex128), (N2 @ curve.q).astype(np.complex128)
    for i in range(3):
        step = np.zeros(3, dtype=np.complex128)
        step[i] = 1j * STEP
        by_r1[..., i] = _energy_density(r1 + step, r2, conductor).imag * weights
        by_r2[..., i] = bending_density(r1, r2 + step, conductor).imag * weights
    return (np.swapaxes(N1, 1, 2) @ by_r1 + np.swapaxes(N2, 1, 2) @ by_r2) / STEP


def weight(curve: Curve, rhoA: float, gravity: float) -> FloatArray:
    """Return the generalised forces of gravity (17) on every element, shape (n_elements, 4, 3)."""
    t, weights = clenshaw_curtis(INTERVALS)
    share = weights @ shape_functions(t, np.ones(1), 0)  # of an element of unit length
    force = np.zeros_like(curve.q)
    force[:, :, 2] = -rhoA * gravity * share * curve.L[:, None] ** np.array([1.0, 2.0, 1.0, 2.0])
    return force


def nodal_residual(
    curve: Curve, conductor: Conductor, gravity: float, joint_s: FloatArray, joint_force: FloatArray
) -> FloatArray:
    """Return what is missing to the balance of every node: dU/dq - weight - forces of joints.

    Parameters
    ----------
    curve, conductor, gravity
        The wire and its load.
    joint_s : FloatArray, shape (m,)
        Material coordinates at which supports, droppers and ends hold the wire [m].
    joint_force : FloatArray, shape (m, 3)
        Their forces on the wire [N].

    Returns
    -------
    FloatArray, shape (n_nodes, 2, 3)
        Forces on r [N] and moments per slope on r' [N m].
    """
    element = elastic_force(curve, conductor) - weight(curve, conductor.rhoA, gravity)
    at = curve.at(joint_s)
    np.subtract.at(element, at.element, at.N[:, :, None] * joint_force[:, None, :])
    residual = np.zeros((curve.s.size, 2, 3))
    residual[:-1] += element[:, :2]
    residual[1:] += element[:, 2:]
    return residual


def _energy_density(r1: ComplexArray, r2: ComplexArray, conductor: Conductor) -> ComplexArray:
    """Return (EA eps^2 + EJ kappa^2)/2; products without conjugates, which are not analytic."""
    x, y, z = np.moveaxis(r1, -1, 0)
    a = x * x + y * y + z * z
    return 0.5 * conductor.EA * (0.5 * (a - 1.0)) ** 2 + bending_density(r1, r2, conductor)


def bending_density(r1: ComplexArray, r2: ComplexArray, conductor: Conductor) -> ComplexArray:
    """Return EJ kappa^2/2 with the curvature (10), for complex r' and r''."""
    x, y, z = np.moveaxis(r1, -1, 0)
    u, v, w = np.moveaxis(r2, -1, 0)
    a, b, c = y * w - z * v, z * u - x * w, x * v - y * u
    size = x * x + y * y + z * z
    return 0.5 * conductor.EJ * (a * a + b * b + c * c) / (size * size * size)
