"""A mechanical system: unknowns and the contributions that act on them.

Static solvers and integrators see only this: residual, Jacobian, and the discrete state of sliding joints.
What the parts are (elements, joints, loads, controls) is known to the parts alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.contribution import Contribution, Relocatable, offers
from catenaria.mechanics.kernels.compress import compress
from catenaria.mechanics.kernels.scatter import sum_into
from catenaria.mechanics.state import State
from catenaria.mechanics.unknowns import Unknowns

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class SparsityPattern:
    """Where the entries of all contributions go in one compressed sparse column matrix.

    Attributes
    ----------
    place : IntArray, shape (m,)
        Position in `data` of each contributed entry.
    indices, indptr : NDArray[np.int32]
        Row indices and column pointers of the matrix.
    """

    place: IntArray
    indices: NDArray[np.int32]
    indptr: NDArray[np.int32]

    @classmethod
    def of(cls, rows: IntArray, columns: IntArray, size: int) -> SparsityPattern:
        """Sort the entries by column and row and give equal ones the same place."""
        return cls(*compress(rows, columns, size))


@dataclass(frozen=True)
class System:
    """Unknowns and contributions; immutable, so that a change of discrete state gives a new system.

    Parameters
    ----------
    unknowns : Unknowns
        The numbering that all contributions use.
    contributions : tuple of Contribution
        Elements, joints, loads and controls.

    Raises
    ------
    InconsistentInputError
        If something in `contributions` lacks a member of the protocol, or, when the Jacobian is first needed,
        an equation has no entry at all.
    """

    unknowns: Unknowns
    contributions: tuple[Contribution, ...]

    def __post_init__(self) -> None:
        for contribution in self.contributions:
            if not offers(type(contribution), Contribution):
                raise InconsistentInputError(f"{type(contribution).__name__} is not a Contribution")

    @property
    def size(self) -> int:
        """Number of unknowns, and of equations."""
        return self.unknowns.size

    @cached_property
    def sparsity(self) -> SparsityPattern:
        """Sparsity pattern of the Jacobian, built at its first use."""
        patterns = [contribution.pattern() for contribution in self.contributions]
        rows = np.concatenate([rows for rows, _ in patterns])
        columns = np.concatenate([columns for _, columns in patterns])
        idle = np.bincount(rows, minlength=self.size) == 0
        if idle.any():
            raise InconsistentInputError(f"no contribution has an equation for unknown {np.argmax(idle)}")
        return SparsityPattern.of(rows, columns, self.size)

    def residual(self, state: State) -> FloatArray:
        """Return F(t, z, z', z''), shape (n,): forces [N, N m], constraints [m], control laws [m/s]."""
        f = np.zeros(self.size)
        for contribution in self.contributions:
            contribution.add_residual(state, f)
        return f

    def jacobian(self, state: State, c1: float = 0.0, c2: float = 0.0) -> csc_matrix:
        """Return F_z + c1 F_z' + c2 F_z'' as a sparse matrix of shape (n, n).

        Parameters
        ----------
        state : State
            Where to linearise.
        c1, c2 : float
            Derivatives of z' and z'' by z in the time discretisation, [1/s] and [1/s^2]; 0 for statics.
        """
        entries = np.concatenate([part.jacobian(state, c1, c2) for part in self.contributions])
        pattern = self.sparsity
        data = sum_into(entries, pattern.place, pattern.indices.size)
        return csc_matrix((data, pattern.indices, pattern.indptr), shape=(self.size, self.size))

    def relocate(self, z: FloatArray) -> System | None:
        """Return the system with its sliding joints in the elements that fit z, or None if they are."""
        moved = {i: part for i, slider in self._sliders if (part := slider.relocate(z)) is not None}
        if not moved:
            return None
        return replace(
            self, contributions=tuple(moved.get(i, part) for i, part in enumerate(self.contributions))
        )

    @cached_property
    def _sliders(self) -> tuple[tuple[int, Relocatable], ...]:
        parts = enumerate(self.contributions)
        return tuple((i, cast(Relocatable, part)) for i, part in parts if offers(type(part), Relocatable))
