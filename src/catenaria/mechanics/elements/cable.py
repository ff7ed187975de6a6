"""The two-node gradient-deficient ANCF cable element, eqs. (1)-(14), in batches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.kernels.cable import add_cable_forces, cable_energies, cable_stiffness
from catenaria.mechanics.state import State
from catenaria.numerics.gauss import gauss_legendre
from catenaria.numerics.hermite import shape, shape_1, shape_2

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class CableElements:
    r"""Elastic forces of a batch of cable elements; each has its own length and stiffness.

    Parameters
    ----------
    dofs : IntArray, shape (n, 12)
        Indices of r_i, r_i', r_j, r_j'.
    L, EA, EJ, rhoA : FloatArray, shape (n,)
        Undeformed length [m], axial stiffness [N], bending stiffness [N m^2], mass per unstressed length
        [kg/m].
    gauss_points : int
        Quadrature points; 5 integrate the axial term of (8) exactly. Below 3 the element has spurious modes.

    Raises
    ------
    InconsistentInputError
        If shapes differ, a length, an axial stiffness or a mass is not positive, or there are fewer than 3
        points.

    Notes
    -----
    Strain energy (8) with Green strain (9) and curvature (10):

    .. math:: U = \frac12\int_0^L \left(EA\,\varepsilon^2 + EJ\,\kappa^2\right) dl,\qquad
              \varepsilon = \frac12(r'\cdot r' - 1),\qquad \kappa = \frac{|r'\times r''|}{|r'|^3}.

    The residual is :math:`\partial U/\partial q`, the Jacobian its exact derivative.

    References
    ----------
    Yang et al. 2017, Multibody Syst Dyn 39, 221-247, section 3.1.1.
    """

    dofs: IntArray
    L: FloatArray
    EA: FloatArray
    EJ: FloatArray
    rhoA: FloatArray
    gauss_points: int = 5

    def __post_init__(self) -> None:
        if self.gauss_points < 3:
            raise InconsistentInputError("a cable element needs at least 3 Gauss points")
        count = self.dofs.shape[0]
        if self.dofs.shape != (count, 12) or any(
            values.shape != (count,) for values in (self.L, self.EA, self.EJ, self.rhoA)
        ):
            raise InconsistentInputError("cable elements need 12 dofs and one L, EA, EJ and rhoA each")
        positive = np.min((self.L, self.EA, self.rhoA))
        if not (positive > 0.0 and self.EJ.min() >= 0.0):  # also refuses NaN
            raise InconsistentInputError("cable elements need positive L, EA and rhoA, and EJ of at least 0")

    @classmethod
    def of(cls, chains: Sequence[Chain], gauss_points: int = 5) -> CableElements:
        """Return all elements of the given chains as one batch."""

        def each(values: Sequence[float]) -> FloatArray:
            return np.repeat(values, [chain.knots.size - 1 for chain in chains]).astype(np.float64)

        return cls(
            np.ascontiguousarray(np.concatenate([chain.dofs for chain in chains])),
            np.concatenate([chain.L for chain in chains]),
            each([chain.section.EA for chain in chains]),
            each([chain.section.EJ for chain in chains]),
            each([chain.section.rhoA for chain in chains]),
            gauss_points,
        )

    @cached_property
    def quadrature(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """N' and N'' of an element of unit length, shape (n_points, 4), and weights (n_points,)."""
        points, weights = gauss_legendre(self.gauss_points)
        unit = np.ones(1)
        return shape_1(points, unit), shape_2(points, unit), weights

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add dU/dq to f."""
        add_cable_forces(state.z, self.dofs, self.L, self.EA, self.EJ, *self.quadrature, f)

    def pattern(self) -> Pattern:
        """Return the entries of all 12 by 12 element matrices."""
        return np.repeat(self.dofs, 12, axis=1).ravel(), np.tile(self.dofs, (1, 12)).ravel()

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return d2U/dq2 of every element."""
        return self.stiffness(state.z).ravel()

    def stiffness(self, z: FloatArray) -> FloatArray:
        """Return the tangent stiffness matrices, shape (n, 12, 12)."""
        return cable_stiffness(z, self.dofs, self.L, self.EA, self.EJ, *self.quadrature)

    def energies(self, z: FloatArray) -> FloatArray:
        """Return the axial and the bending term of (8) for every element [J], shape (n, 2)."""
        return cable_energies(z, self.dofs, self.L, self.EA, self.EJ, *self.quadrature)

    def mass(self) -> FloatArray:
        r"""Return the consistent mass matrices (14) [kg, kg m, kg m^2], shape (n, 12, 12).

        Notes
        -----
        .. math:: M = \rho A \int_0^L S^T S\, dl, integrated exactly with 4 points (degree 6).
        """
        points, weights = gauss_legendre(4)
        N = shape(np.broadcast_to(points, (self.L.size, 4)), self.L[:, None])
        weighted = (0.5 * self.rhoA * self.L)[:, None, None] * weights[:, None] * N
        m = weighted.transpose(0, 2, 1) @ N
        return (m[:, :, None, :, None] * np.eye(3)[:, None, :]).reshape(-1, 12, 12)

    def weight(self, size: int) -> FloatArray:
        r"""Return the generalised force of gravity per unit of g, direction -z, shape (size,); eq. (17).

        Notes
        -----
        .. math:: \rho A \int_0^L S^T n\, dl
                  = \rho A L\,[\tfrac12, \tfrac{L}{12}, \tfrac12, -\tfrac{L}{12}] \otimes n.
        """
        share = np.stack(
            [np.full_like(self.L, 0.5), self.L / 12, np.full_like(self.L, 0.5), -self.L / 12], axis=1
        )
        force = np.zeros(size)
        np.add.at(force, self.dofs[:, 2::3], -(self.rhoA * self.L)[:, None] * share)
        return force
