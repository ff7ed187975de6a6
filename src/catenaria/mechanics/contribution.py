"""What every part of a system offers: its share of the residual and of the Jacobian."""

from __future__ import annotations

from functools import lru_cache
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.state import State

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Pattern = tuple[IntArray, IntArray]


@runtime_checkable
class Contribution(Protocol):
    """A batch of equal parts: elements, joints, loads or controls.

    The residual is F(t, z, z', z'') = 0; the signs are those of eq. (13) with everything on the left:
    M q'' - Q_q - Q_f + C_q^T la = 0 and C = 0.
    """

    def add_residual(self, state: State, f: FloatArray) -> None:
        """Add this part's share to f, shape (n,)."""
        ...

    def pattern(self) -> Pattern:
        """Return rows and columns of the Jacobian's entries, shape (m,) each; repeated entries add up."""
        ...

    def jacobian(self, state: State, c1: float, c2: float) -> FloatArray:
        """Return F_z + c1 F_z' + c2 F_z'' at the entries of `pattern`, shape (m,)."""
        ...


@runtime_checkable
class Relocatable(Protocol):
    """A contribution with discrete state: the element in which each sliding point is."""

    def relocate(self, z: FloatArray) -> Contribution | None:
        """Return the contribution with the discrete state that fits z, or None if its own still fits."""
        ...


@lru_cache
def offers(kind: type, protocol: type) -> bool:
    """Return whether a class has all methods of a protocol; remembered, because looking takes a while."""
    return issubclass(kind, protocol)
