"""The linearised equations of a line at rest, by coordinates and constraints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import scipy.sparse  # pyright: ignore[reportMissingTypeStubs]  # scipy-stubs are optional
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

sparse: Final[Any] = scipy.sparse  # whose types are partly unknown to type checkers

_SAME = 1e-9  # of a constraint's derivatives and its force's directions, relative


@dataclass(frozen=True)
class Tangent:
    r"""Small motions about the state of rest; all matrices are SciPy's csr_array.

    Attributes
    ----------
    M, K : csr_array, shape (n, n)
        Mass and tangent stiffness, symmetric; droppers that are springs are in K, slack ones are not.
    C : csr_array, shape (m, n)
        Derivatives of the constraints by coordinates.
    D : csr_array, shape (m, m)
        Compliance of what is held by springs; zero for rigid constraints.

    Notes
    -----
    .. math:: M\,\ddot x + K\,x + C^T\mu = 0,\qquad C\,x - D\,\mu = 0 .
    """

    M: Any
    K: Any
    C: Any
    D: Any

    def whole(self) -> tuple[Any, Any]:
        """Return stiffness and mass of coordinates and constraint forces together, as csc_array."""
        stiffness = sparse.block_array([[self.K, self.C.T], [self.C, -self.D]], format="csc")
        nothing = sparse.csr_array(self.D.shape)
        mass = sparse.block_array([[self.M, None], [None, nothing]], format="csc")
        mass.eliminate_zeros()
        return stiffness, mass


def tangent(
    jacobian: Any,
    mass: Any,
    coordinates: IntArray,
    multipliers: IntArray,
    springs: IntArray,
    unit: FloatArray,
) -> Tangent:
    r"""Return the parts of a system's Jacobian.

    Parameters
    ----------
    jacobian, mass : sparse matrix, shape (N, N)
        Of all equations by all unknowns.
    coordinates, multipliers : IntArray, shape (n,), (m,)
        Unknowns that are kept. All others but the springs are given and do not change.
    springs : IntArray
        Unknowns that are densities of springs: q of S x - c q = 0 with the force F q.
    unit : FloatArray, shape (m,)
        Unit forces of the constraints are multipliers of this size.

    Notes
    -----
    Springs are eliminated, :math:`K = J_{xx} - J_{xq} J_{qq}^{-1} J_{qx}`. A constraint's row is multiplied
    by what makes it the direction of its force.

    Raises
    ------
    InconsistentInputError
        If a constraint's force is not normal to what the constraint leaves free.
    """
    J = sparse.csr_array(jacobian)
    give = J[springs][:, springs].diagonal()
    soft = J[coordinates][:, springs] @ sparse.diags_array(1.0 / give) @ J[springs][:, coordinates]
    forces = sparse.csr_array(J[coordinates][:, multipliers].T)
    rows = sparse.csr_array(J[multipliers][:, coordinates])
    scale, units = sparse.diags_array(_scale(forces, rows)), sparse.diags_array(unit)
    own_mass = sparse.csr_array(sparse.csr_array(mass)[coordinates][:, coordinates])
    own_mass.eliminate_zeros()
    return Tangent(
        own_mass,
        sparse.csr_array(J[coordinates][:, coordinates] - soft),
        sparse.csr_array(units @ forces),
        sparse.csr_array(-(units @ scale @ J[multipliers][:, multipliers] @ units)),
    )


def _scale(forces: Any, rows: Any) -> FloatArray:
    """Return by what constraints' rows are multiplied to be the directions of their forces.

    Rows are written as lengths, forces of bars per length: the two differ by a factor.
    """
    own = np.asarray(rows.multiply(rows).sum(axis=1), dtype=np.float64)
    if not np.all(own > 0.0):
        raise InconsistentInputError("a constraint of the line holds nothing")
    scale = np.asarray(rows.multiply(forces).sum(axis=1), dtype=np.float64) / own
    off = float(abs(sparse.diags_array(scale) @ rows - forces).max())
    if not off <= _SAME * float(abs(forces).max()):
        raise InconsistentInputError("a constraint's force is not normal to what the constraint leaves free")
    return scale
