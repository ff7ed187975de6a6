"""A cable as a chain of elements with shared nodes, and what can be said about a point on it.

Sharing r and r' between neighbours is the fixed joint (16) without multipliers: equal positions, equal
slopes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError, InfeasibleError
from catenaria.mechanics.kernels.points import chain_points, elements_of

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_OVERLAP = (
    1e-6  # part of an element by which a sliding point may lie beyond it before it changes over: no cycling
)


@dataclass(frozen=True)
class Section:
    """Constant cross-section properties.

    Attributes
    ----------
    EA, EJ : float
        Axial stiffness [N] and bending stiffness [N m^2].
    rhoA : float
        Mass per unstressed length [kg/m].
    """

    EA: float
    EJ: float
    rhoA: float


@dataclass(frozen=True)
class Chain:
    """A cable: nodes at material coordinates `knots`, one element between each two.

    Attributes
    ----------
    nodes : IntArray, shape (n_nodes, 6)
        Indices of r and r' of every node.
    knots : FloatArray, shape (n_nodes,)
        Material (unstressed) arc length of every node from the cable's start [m].
    section : Section
        Cross-section.

    Raises
    ------
    InconsistentInputError
        If there are fewer than two nodes, or the coordinates do not ascend.
    """

    nodes: IntArray
    knots: FloatArray
    section: Section

    def __post_init__(self) -> None:
        if self.nodes.shape != (self.knots.size, 6) or not (
            self.knots.size > 1 and np.all(np.diff(self.knots) > 0.0)
        ):
            raise InconsistentInputError("a cable needs two or more nodes at ascending material coordinates")

    def renumbered(self, number: IntArray) -> Chain:
        """Return the cable with the final numbers of its unknowns."""
        return Chain(number[self.nodes], self.knots, self.section)

    @property
    def dofs(self) -> IntArray:
        """Indices of r_i, r_i', r_j, r_j' of every element, shape (n_elements, 12)."""
        return np.concatenate((self.nodes[:-1], self.nodes[1:]), axis=1)

    @property
    def L(self) -> FloatArray:  # noqa: N802, the symbol of the paper
        """Undeformed length of every element [m]."""
        return np.diff(self.knots)

    def locate(self, s: FloatArray) -> IntArray:
        """Return the element in which each coordinate lies; the first or last one beyond the ends."""
        return np.clip(np.searchsorted(self.knots, s, side="right") - 1, 0, self.knots.size - 2)

    def relocate(self, s: FloatArray, element: IntArray) -> IntArray:
        """Return the elements that fit s; a point leaves its element only beyond a small overlap.

        Raises
        ------
        InfeasibleError
            If a point has slid off the end of the cable.
        """
        found = elements_of(self.knots, s, element, _OVERLAP)
        if found.min(initial=0) < 0:
            raise InfeasibleError(
                f"a cable of {self.knots[-1]:.6g} m has slid out of a joint, which would be at {s.min():.6g} "
                f"to {s.max():.6g} m of it; a longer tail or another tension would keep it in"
            )
        return found

    def evaluate(self, z: FloatArray, s: FloatArray, element: IntArray | None = None) -> Points:
        """Return shape functions, r, r' and r'' at material coordinates s, shape (n,)."""
        element = self.locate(s) if element is None else element
        dofs, N, N1, r = chain_points(z, self.nodes, self.knots, s, element)
        return Points(dofs, N, N1, *r)


@dataclass(frozen=True, slots=True)
class Points:
    """Points on a chain: `dofs` (n, 4, 3), N and N' (n, 4), r, r', r'' (n, 3)."""

    dofs: IntArray
    N: FloatArray
    N1: FloatArray
    r: FloatArray
    r1: FloatArray
    r2: FloatArray
