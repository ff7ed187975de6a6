"""Natural frequencies of small vibrations about a form that was found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError, InfeasibleError
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.solvers.modes import smallest_modes
from catenaria.solvers.problem import SparseMatrix

FloatArray = NDArray[np.float64]

_REAL = 1e-6  # imaginary part of omega^2 that rounding leaves, relative
_LARGE = 1e12  # 1/s^2: M is read from K + _LARGE M, to which K adds nothing that rounding would not


@dataclass(frozen=True)
class Modes:
    """Natural modes in ascending order of frequency.

    Attributes
    ----------
    frequency : FloatArray, shape (k,)
        Natural frequencies omega/(2 pi) [Hz].
    shape : FloatArray, shape (n, k)
        Mode shapes over all unknowns of the system, one a column; the largest entry of those with inertia
        is 1. Rows of multipliers are the amplitudes of their forces.
    """

    frequency: FloatArray
    shape: FloatArray


def natural_frequencies(system: System, z: FloatArray, count: int) -> Modes:
    """Return the lowest natural frequencies of a system at rest.

    Parameters
    ----------
    system : System
        With its inertia. Controls must have been replaced: by targets for weight stacks without mass, by
        given parameters for ends that are held.
    z : FloatArray, shape (n,)
        Where it is in equilibrium.
    count : int
        How many modes. In three dimensions modes across and in the vertical plane come in pairs.

    Returns
    -------
    Modes

    Raises
    ------
    InconsistentInputError
        If something is free to move without force, or there are not so many modes.
    InfeasibleError
        If the equilibrium is not stable.
    NotConvergedError
        If the iteration does not converge.

    Notes
    -----
    Small motions z + x exp(i omega t) of F(z, z'') = 0 satisfy K x = omega^2 M x with K = F_z, joints and
    targets included, and M = F_z''. Damping is left out.
    """
    state = State.at_rest(z)
    located = system.relocate(z) or system
    K = located.jacobian(state)
    M = (located.jacobian(state, c2=_LARGE) - K) / _LARGE
    try:
        pairs = smallest_modes(cast("SparseMatrix", K), cast("SparseMatrix", M.tocsc()), count)
    except np.linalg.LinAlgError as error:
        raise InconsistentInputError(
            f"no natural frequencies: {error}, so something moves without force; hold it, or give it a target"
        ) from error
    square = pairs.value
    unstable = (square.real <= 0.0) | (np.abs(square.imag) > _REAL * np.abs(square))
    if unstable.any():
        found = f"omega^2 = {square[unstable][0]:.6g} 1/s^2"
        raise InfeasibleError(f"the equilibrium is not stable: {found}; more tension would help")
    return Modes(np.sqrt(square.real) / (2.0 * np.pi), pairs.vector.real)
