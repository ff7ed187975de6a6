"""What joints need of the cables on which their points are: one chain, or a point each on several of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.chain import Chain, Points
from catenaria.mechanics.kernels.points import chain_points

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class Carrier(Protocol):
    """A chain, or what stands for several chains."""

    @property
    def nodes(self) -> IntArray:
        """Indices of r and r' of all nodes; an element e lies between nodes e and e + 1."""
        ...

    def locate(self, s: FloatArray) -> IntArray:
        """Return the element in which each coordinate lies."""
        ...

    def relocate(self, s: FloatArray, element: IntArray) -> IntArray:
        """Return the elements that fit s."""
        ...

    def evaluate(self, z: FloatArray, s: FloatArray, element: IntArray | None = None) -> Points:
        """Return shape functions, r, r' and r'' at material coordinates s."""
        ...


@dataclass(frozen=True)
class Strands:
    """A batch of points, each on one of several chains.

    Attributes
    ----------
    chains : tuple of Chain
        The chains.
    of : IntArray, shape (n,)
        On which chain each point is.
    nodes : IntArray, shape (n_nodes, 6)
        Nodes of all chains one after the other; what lies between the last node of one and the first of the
        next is no element.
    knots : FloatArray, shape (n_nodes,)
        Their material coordinates, from the start of their own chain [m].
    first : IntArray, shape (n,)
        Number of the first node of each point's chain.
    """

    chains: tuple[Chain, ...]
    of: IntArray
    nodes: IntArray
    knots: FloatArray
    first: IntArray

    @classmethod
    def on(cls, chains: Sequence[Chain], of: IntArray) -> Strands:
        """Return points on the given chains."""
        first = np.concatenate(([0], np.cumsum([chain.knots.size for chain in chains])))
        nodes = np.ascontiguousarray(np.concatenate([chain.nodes for chain in chains]))
        knots = np.concatenate([chain.knots for chain in chains])
        return cls(tuple(chains), of, nodes, knots, first[of])

    def locate(self, s: FloatArray) -> IntArray:
        """Return the element in which each coordinate lies; the first or last one of its chain beyond it."""
        element = np.empty(s.shape, dtype=np.int64)
        for k, chain in enumerate(self.chains):
            own = self.of == k
            element[own] = chain.locate(s[own]) + self.first[own]
        return element

    def relocate(self, s: FloatArray, element: IntArray) -> IntArray:
        """Return the elements that fit s; see `Chain.relocate`.

        Raises
        ------
        InfeasibleError
            If a point has slid off the end of its cable.
        """
        found = np.empty_like(element)
        for k, chain in enumerate(self.chains):
            own = self.of == k
            if own.any():
                found[own] = chain.relocate(s[own], element[own] - self.first[own]) + self.first[own]
        return found

    def evaluate(self, z: FloatArray, s: FloatArray, element: IntArray | None = None) -> Points:
        """Return shape functions, r, r' and r'' at material coordinates s, shape (n,)."""
        element = self.locate(s) if element is None else element
        dofs, N, N1, r = chain_points(z, self.nodes, self.knots, s, element)
        return Points(dofs, N, N1, *r)
