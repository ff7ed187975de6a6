"""Cables whose natural length is a parameter: pieces that are cut to fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.chain import Chain
from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.kernels.cable import add_cable_forces, cable_energies, cable_stiffness
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Pieces:
    r"""Elastic forces and weight of whole cables that are longer than their mesh says.

    Parameters
    ----------
    elements : CableElements
        All elements, by the coordinates of the mesh.
    parameter : IntArray, shape (n_elements,)
        Index of the parameter p of each element's cable: how much longer the cable is than its mesh [m].
    whole : FloatArray, shape (n_elements,)
        Length L0 of the mesh of each element's cable [m].
    g : float
        Gravity [m/s^2].
    ramp : Ramp
        How the weight grows in time.

    Notes
    -----
    A length ds of the mesh is l ds of cable, l = 1 + p/L0. The Green strain to the natural length is
    (eps - e0)/l^2 with eps = (r'.r' - 1)/2 by mesh coordinate and the natural strain e0 = (l^2 - 1)/2; the
    curvature does not depend on how the curve is parametrised. Hence

    .. math:: U = \frac12\int_0^{L}\left(\frac{EA}{l^3}(\varepsilon - e_0)^2 + EJ\,l\,\kappa^2\right)ds
                = U_{(8)}\!\left(\frac{EA}{l^3}, EJ\,l\right)
                  - \frac{EA\,e_0}{l^3}\int_0^L\left(\varepsilon - \frac{e_0}{2}\right)ds,

    the energy of the ordinary cable element with other stiffnesses, and a term quadratic in the coordinates.
    The weight is that of l times the mesh. The row of p belongs to whatever says how long the cable is. Where
    p leaves no length, the residual is not a number, and a damped Newton method goes back.
    """

    elements: CableElements
    parameter: IntArray
    whole: FloatArray
    g: float
    ramp: Ramp

    @classmethod
    def of(
        cls, chains: Sequence[Chain], parameter: IntArray, gauss_points: int, g: float, ramp: Ramp
    ) -> Pieces:
        """Return the given cables, each with the index of its parameter."""
        counts = [chain.knots.size - 1 for chain in chains]
        whole = np.array([chain.knots[-1] - chain.knots[0] for chain in chains])
        elements = CableElements.of(chains, gauss_points)
        return cls(elements, np.repeat(parameter, counts), np.repeat(whole, counts), g, ramp)

    def _factor(self, z: FloatArray) -> FloatArray:
        """Return l of every element, NaN where nothing is left."""
        factor = 1.0 + z[self.parameter] / self.whole
        return np.where(factor > 0.0, factor, np.nan)

    @cached_property
    def _apart(self) -> CableElements:
        """The same elements, none of which shares an unknown with another."""
        count = self.elements.dofs.size
        return replace(self.elements, dofs=np.arange(count, dtype=np.int64).reshape(-1, 12))

    @cached_property
    def _burden(self) -> FloatArray:
        """What the residual gets of the weight per unit of g and l, shape (n, 12)."""
        return -self._apart.weight(self.elements.dofs.size).reshape(-1, 12)

    @cached_property
    def _metric(self) -> FloatArray:
        """The integrals of N'_k N'_m, which 3 points give exactly, shape (n, 4, 4)."""
        B1, _, w = self.elements.quadrature
        L = self.elements.L
        slopes = B1 * np.stack((1.0 / L, np.ones_like(L), 1.0 / L, np.ones_like(L)), axis=1)[:, None, :]
        return np.einsum("n,g,ngk,ngm->nkm", 0.5 * L, w, slopes, slopes)

    def _relief(self, factor: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return EA e0/l^3 and its derivative by l."""
        EA = 0.5 * self.elements.EA
        return EA * (1.0 / factor - factor**-3), EA * (3.0 * factor**-4 - factor**-2)

    def _forces(self, z: FloatArray, EA: FloatArray, EJ: FloatArray, relief: FloatArray) -> FloatArray:
        """Return elastic forces less those of the natural strain, shape (n, 12)."""
        q, apart = z[self.elements.dofs], self._apart
        elastic = np.zeros(q.size)
        add_cable_forces(q.ravel(), apart.dofs, apart.L, EA, EJ, *apart.quadrature, elastic)
        slack = relief[:, None, None] * (self._metric @ q.reshape(-1, 4, 3))
        return elastic.reshape(-1, 12) - slack.reshape(-1, 12)

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add dU/dq and the weight to f."""
        factor, own = self._factor(state.z), self.elements
        relief, _ = self._relief(factor)
        forces = self._forces(state.z, own.EA / factor**3, own.EJ * factor, relief)
        weight = self.g * self.ramp(state.t) * factor
        np.add.at(f, own.dofs, forces + weight[:, None] * self._burden)

    def pattern(self) -> Pattern:
        """Return the entries of all element matrices and of the columns of p."""
        rows, columns = self.elements.pattern()
        dofs = self.elements.dofs.ravel()
        return np.concatenate((rows, dofs)), np.concatenate((columns, np.repeat(self.parameter, 12)))

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return d2U/dq2 and the derivatives of forces and weight by p; forces are linear in EA and in EJ."""
        factor, own = self._factor(state.z), self.elements
        _, relief = self._relief(factor)
        by_factor = self._forces(state.z, -3.0 * own.EA * factor**-4, own.EJ, relief)
        by_factor += self.g * self.ramp(state.t) * self._burden
        return np.concatenate((self.stiffness(state.z).ravel(), (by_factor / self.whole[:, None]).ravel()))

    def stiffness(self, z: FloatArray) -> FloatArray:
        """Return the tangent stiffness matrices d2U/dq2, shape (n, 12, 12)."""
        factor, own = self._factor(z), self.elements
        relief, _ = self._relief(factor)
        stiffness = cable_stiffness(z, own.dofs, own.L, own.EA / factor**3, own.EJ * factor, *own.quadrature)
        slack = relief[:, None, None] * self._metric
        return stiffness - (slack[:, :, None, :, None] * np.eye(3)[:, None, :]).reshape(-1, 12, 12)

    def energies(self, z: FloatArray) -> FloatArray:
        """Return the axial and the bending part of U for every element [J], shape (n, 2)."""
        factor, own = self._factor(z), self.elements
        energies = cable_energies(z, own.dofs, own.L, own.EA / factor**3, own.EJ * factor, *own.quadrature)
        q = z[own.dofs].reshape(-1, 4, 3)
        stretched = np.einsum("nki,nkm,nmi->n", q, self._metric, q) - own.L
        natural = 0.5 * (factor**2 - 1.0)
        energies[:, 0] -= 0.5 * self._relief(factor)[0] * (stretched - natural * own.L)
        return energies

    def mass(self) -> FloatArray:
        """Return the consistent mass matrices of the mesh's length, p = 0, shape (n, 12, 12)."""
        return self.elements.mass()
