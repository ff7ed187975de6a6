"""Forces linear in acceleration or velocity: inertia M q'', damping (alpha M + beta K_0) q'."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array

from catenaria.mechanics.contribution import Pattern
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def assemble(elements: CableElements, matrices: FloatArray, size: int) -> csr_array:
    """Add element matrices (n, 12, 12) up to a sparse matrix of shape (size, size) without stored zeros."""
    rows, columns = elements.pattern()
    total = csr_array(coo_array((matrices.ravel(), (rows, columns)), shape=(size, size)))
    total.eliminate_zeros()
    return total


def point_masses(dofs: IntArray, masses: FloatArray, size: int) -> tuple[csr_array, FloatArray]:
    """Return mass matrix and weight per unit of g of masses at nodes.

    Parameters
    ----------
    dofs : IntArray, shape (n, 3)
        Indices of the nodes' positions.
    masses : FloatArray, shape (n,)
        Masses [kg].
    size : int
        Number of unknowns.
    """
    where = dofs.ravel()
    mass = csr_array(coo_array((np.repeat(masses, 3), (where, where)), shape=(size, size)))
    weight = np.zeros(size)
    np.add.at(weight, dofs[:, 2], -masses)
    return mass, weight


@dataclass(frozen=True)
class Inertia:
    """M q'' of eq. (18).

    Parameters
    ----------
    M : csr_array, shape (n, n)
        Mass matrix, zero outside the coordinates.
    """

    M: csr_array

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add M q'' to f."""
        f += self.M @ state.zdd

    def pattern(self) -> Pattern:
        """Return the entries of M."""
        return _entries(self.M)

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return c2 M."""
        return c2 * self.M.data

    def kinetic_energy(self, zd: FloatArray) -> float:
        """Return the kinetic energy (7) [J]."""
        return 0.5 * float(zd @ (self.M @ zd))


@dataclass(frozen=True)
class RayleighDamping:
    """Forces D q' with D = alpha M + beta K_0.

    Parameters
    ----------
    D : csr_array, shape (n, n)
        Damping matrix.

    Notes
    -----
    K_0 is the stiffness of the starting configuration, so D is constant: proportional damping as in linear
    structural dynamics. Translations meet no resistance from the stiffness term, large rotations do; a
    catenary has none. The paper mentions no damping; the default of a line is therefore none.
    """

    D: csr_array

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add D q' to f."""
        f += self.D @ state.zd

    def pattern(self) -> Pattern:
        """Return the entries of D."""
        return _entries(self.D)

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return c1 D."""
        return c1 * self.D.data


def _entries(matrix: csr_array) -> Pattern:
    rows = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
    return rows.astype(np.int64), matrix.indices.astype(np.int64)
