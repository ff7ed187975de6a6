"""Where a system is and how it moves at one instant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class State:
    """Time, all unknowns z and their first and second derivatives by time.

    Attributes
    ----------
    t : float
        Time [s].
    z : FloatArray, shape (n,)
        Nodal coordinates, sliding coordinates, control parameters and multipliers, as `Unknowns` numbers
        them.
    zd, zdd : FloatArray, shape (n,)
        Their time derivatives; those of multipliers and sliding coordinates are never used.
    """

    t: float
    z: FloatArray
    zd: FloatArray
    zdd: FloatArray

    @classmethod
    def at_rest(cls, z: FloatArray, t: float = 0.0) -> State:
        """Return the state with these unknowns and no motion."""
        return cls(t, z, np.zeros_like(z), np.zeros_like(z))
