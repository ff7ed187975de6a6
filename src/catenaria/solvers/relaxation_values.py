"""Values that go into and come out of dynamic relaxation: problem, options, steps, result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.solvers.problem import FloatArray, SparseMatrix

Damping = Literal["kinetic", "viscous"]


class RelaxationProblem(Protocol):
    """Equilibrium f(y) = 0 of a structure with a symmetric stiffness f_y; all arrays have shape (n,).

    Notes
    -----
    Constraints are eliminated: what is held is no unknown. The array y that the methods are given is valid
    during the call only. Units of unknowns may differ from each other, as long as f_i is the force that does
    work on y_i.
    """

    @property
    def size(self) -> int:
        """Number of unknowns n."""
        ...

    @property
    def force_scale(self) -> FloatArray:
        """Size of a negligible residual, positive."""
        ...

    def residual(self, y: FloatArray) -> FloatArray:
        """Return f(y), internal minus external forces."""
        ...

    def stiffness_bound(self, y: FloatArray) -> FloatArray:
        """Return a bound of sum_j |K_ij| d_j / d_i at y and near it, with any d > 0 (1 where units agree).

        It must be positive. Masses follow the stiffness, but not at once: an unknown that is soft at y and
        would stiffen soon, such as the deflection of a straight wire without tension, should be given the
        bound of its stiffer neighbours.
        """
        ...


@dataclass(frozen=True)
class RelaxationOptions:
    """How to relax.

    Parameters
    ----------
    damping : {"kinetic", "viscous"}
        Rest at every peak of the kinetic energy, or critical damping of the observed frequency.
    mass_factor : float
        Fictitious masses in units of Gershgorin's bound of stability, sum_j |K_ij| dt^2 / 4, which chains
        attain. Iterations grow like its square root; little more than 1 leaves no room for stiffness that
        changes on the way.
    mass_interval : int
        Iterations after which the masses follow the stiffness.
    max_iterations : int
        Limit of evaluations of the residual.
    record_interval : int
        Iterations between two records of the residual, each of which calls the observers.

    Raises
    ------
    InconsistentInputError
        If a number is not positive.
    """

    damping: Damping = "kinetic"
    mass_factor: float = 2.0
    mass_interval: int = 100
    max_iterations: int = 200_000
    record_interval: int = 100

    def __post_init__(self) -> None:
        if min(self.mass_factor, self.mass_interval, self.max_iterations, self.record_interval) <= 0:
            raise InconsistentInputError("mass factor, intervals and limit of a relaxation must be positive")


@dataclass(frozen=True)
class RelaxationStep:
    """What an observer sees.

    Attributes
    ----------
    iteration : int
        Number of steps made before.
    y : FloatArray, shape (n,)
        Position, a copy.
    residual : float
        Largest |f_i| / force_scale_i at y, convergence at 1.
    kinetic_energy : float
        Of the last step, in units of force times displacement; says nothing about convergence.
    """

    iteration: int
    y: FloatArray
    residual: float
    kinetic_energy: float


@dataclass(frozen=True)
class Relaxation:
    """Where a relaxation arrived.

    Attributes
    ----------
    y : FloatArray, shape (n,)
        Last position.
    converged : bool
        Whether it is an equilibrium; only the partial result of a `NotConvergedError` is none.
    iterations : int
        Evaluations of the residual.
    recorded : NDArray[np.int64], shape (m,)
        Iterations of the records, from 0: every `record_interval`-th and, if it converged, the last.
    residual : FloatArray, shape (m,)
        Largest |f_i| / force_scale_i there.
    peaks : FloatArray, shape (p,)
        Kinetic energies at which kinetic damping stopped the motion.
    mass_updates : int
        How often masses followed the stiffness.
    restarts : int
        How many of these were forced by a motion that had begun to grow.
    """

    y: FloatArray
    converged: bool
    iterations: int
    recorded: NDArray[np.int64]
    residual: FloatArray
    peaks: FloatArray
    mass_updates: int
    restarts: int


def row_sums(matrix: SparseMatrix) -> FloatArray:
    """Return sum_j |K_ij| of a square sparse matrix, a `stiffness_bound` where there is a Jacobian.

    Parameters
    ----------
    matrix : SparseMatrix, shape (n, n)
        In compressed column form.

    Returns
    -------
    FloatArray, shape (n,)

    Examples
    --------
    >>> from scipy.sparse import csc_array
    >>> row_sums(csc_array([[2.0, -1.0], [-1.0, 0.0]]))
    array([3., 1.])
    """
    sums = np.zeros(matrix.indptr.size - 1)
    np.add.at(sums, matrix.indices, np.abs(matrix.data))
    return sums
