"""Natural frequencies and modes of a line at rest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError, InfeasibleError
from catenaria.export.resting import RestingLine
from catenaria.solvers.modes import smallest_modes
from catenaria.solvers.problem import SparseMatrix

FloatArray = NDArray[np.float64]

_REAL = 1e-6  # imaginary part of omega^2 that rounding leaves, relative


@dataclass(frozen=True)
class Vibrations:
    """Natural modes in ascending order.

    Attributes
    ----------
    frequency : FloatArray, shape (k,)
        omega/(2 pi) [Hz].
    shape : FloatArray, shape (n, k)
        Amplitudes of all coordinates, one mode a column, with x^T M x = 1 kg.
    """

    frequency: FloatArray
    shape: FloatArray


def vibrations(rest: RestingLine, count: int) -> Vibrations:
    """Return the lowest natural modes of a line at rest; ends are held, no dropper becomes slack or taut.

    Raises
    ------
    InconsistentInputError
        If something moves without force, or there are not so many modes.
    InfeasibleError
        If the line is not stable.
    NotConvergedError
        If the iteration does not converge.
    """
    stiffness, mass = rest.tangent.whole()
    order = np.argsort(np.concatenate((rest.coordinates, rest.multipliers)), kind="stable")  # a narrow band
    K, M = (cast("SparseMatrix", matrix[order][:, order]) for matrix in (stiffness, mass))
    try:
        pairs = smallest_modes(K, M, count, "NATURAL")
    except np.linalg.LinAlgError as error:
        raise InconsistentInputError(
            f"no natural modes: {error}, so something moves without force"
        ) from error
    square = pairs.value
    if np.any((square.real <= 0.0) | (np.abs(square.imag) > _REAL * np.abs(square))):
        raise InfeasibleError("no natural modes: the line is not stable; more tension would help")
    shape = np.empty((order.size, square.size))
    shape[order] = pairs.vector.real
    shape = shape[: rest.coordinates.size]
    inertia = np.einsum("nk,nk->k", shape, rest.tangent.M @ shape)
    return Vibrations(np.sqrt(square.real) / (2.0 * np.pi), shape / np.sqrt(inertia))
