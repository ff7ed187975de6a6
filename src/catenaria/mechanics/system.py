"""A mechanical system: unknowns and the contributions that act on them.

Static solvers and integrators see only this: residual, Jacobian, and the discrete state of sliding joints.
What the parts are (elements, joints, loads, controls) is known to the parts alone.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

from catenaria.errors import InconsistentInputError
from catenaria.mechanics.contribution import Contribution, Relocatable, offers
from catenaria.mechanics.sparsity import MergedPattern, SparsityPattern
from catenaria.mechanics.state import State
from catenaria.mechanics.unknowns import Unknowns

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class System:
    """Unknowns and contributions; immutable, so that a change of discrete state gives a new system.

    Parameters
    ----------
    unknowns : Unknowns
        The numbering that all contributions use.
    contributions : tuple of Contribution
        Elements, joints, loads and controls.
    origin : System, optional
        The system with the same parts but for their discrete state, from which this one comes by `relocate`.

    Raises
    ------
    InconsistentInputError
        If something in `contributions` lacks a member of the protocol, or, when the Jacobian is first needed,
        an equation has no entry at all.
    """

    unknowns: Unknowns
    contributions: tuple[Contribution, ...]
    origin: System | None = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        for contribution in self.contributions:
            if not offers(type(contribution), Contribution):
                raise InconsistentInputError(f"{type(contribution).__name__} is not a Contribution")

    @property
    def size(self) -> int:
        """Number of unknowns, and of equations."""
        return self.unknowns.size

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
        steady = self.steady_pattern.data([part.jacobian(state, c1, c2) for part in self._steady])
        sliding = self._sliding_pattern.data([part.jacobian(state, c1, c2) for part in self._sliding])
        pattern = self.sparsity
        data = pattern.data(steady, sliding)
        return csc_matrix((data, pattern.indices, pattern.indptr), shape=(self.size, self.size))

    @cached_property
    def sparsity(self) -> MergedPattern:
        """Sparsity pattern of the Jacobian, found at its first use."""
        pattern = MergedPattern.of(self.steady_pattern, self._sliding_pattern)
        idle = np.bincount(pattern.indices, minlength=self.size) == 0
        if idle.any():
            raise InconsistentInputError(f"no contribution has an equation for unknown {np.argmax(idle)}")
        return pattern

    @cached_property
    def steady_pattern(self) -> SparsityPattern:
        """Pattern of all parts without discrete state, which relocated systems share."""
        if self.origin is not None:
            return self.origin.steady_pattern
        return SparsityPattern.of_parts(self._steady, self.size)

    @cached_property
    def _sliding_pattern(self) -> SparsityPattern:
        return SparsityPattern.of_parts(self._sliding, self.size)

    @cached_property
    def _steady(self) -> tuple[Contribution, ...]:
        return tuple(part for part in self.contributions if not offers(type(part), Relocatable))

    @cached_property
    def _sliding(self) -> tuple[Contribution, ...]:
        return tuple(part for part in self.contributions if offers(type(part), Relocatable))

    def relocate(self, z: FloatArray) -> System | None:
        """Return the system with its sliding joints in the elements that fit z, or None if they are."""
        parts = tuple(_relocated(part, z) for part in self.contributions)
        if all(new is old for new, old in zip(parts, self.contributions, strict=True)):
            return None
        return System(self.unknowns, parts, self.origin or self)


def _relocated(part: Contribution, z: FloatArray) -> Contribution:
    """Return a part with the discrete state that fits z."""
    if not offers(type(part), Relocatable):
        return part
    return cast(Relocatable, part).relocate(z) or part
