"""The unknowns of a system in one numbering: coordinates, control parameters and multipliers.

Row i of the residual belongs to unknown i: dynamic equilibrium to a coordinate, the sliding condition to a
sliding coordinate, the control law to a control parameter and the constraint to its multiplier.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class Kind(IntEnum):
    """What an unknown is."""

    POSITION = 0
    SLOPE = 1
    SLIDING = 2
    PARAMETER = 3
    MULTIPLIER = 4


@dataclass(frozen=True)
class Unknowns:
    """The table of all unknowns.

    Attributes
    ----------
    kind : IntArray, shape (n,)
        `Kind` of each unknown.
    start : FloatArray, shape (n,)
        Starting value: m for positions, sliding coordinates and parameters, 1 for slopes, N for multipliers.
    """

    kind: IntArray
    start: FloatArray

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.kind.size

    def where(self, *kinds: Kind) -> NDArray[np.bool_]:
        """Return the mask of the unknowns that are of one of the given kinds."""
        return np.isin(self.kind, kinds)


@dataclass
class UnknownsBuilder:
    """Hands out indices while a model is put together.

    Examples
    --------
    >>> builder = UnknownsBuilder()
    >>> builder.add(Kind.POSITION, [0.0, 0.0, 1.5])
    array([0, 1, 2])
    >>> builder.add(Kind.MULTIPLIER, [0.0])
    array([3])
    >>> builder.build().size
    4
    """

    _kinds: list[int] = field(default_factory=list[int])
    _start: list[float] = field(default_factory=list[float])

    def add(self, kind: Kind, start: FloatArray | list[float]) -> IntArray:
        """Add unknowns of one kind and return their indices, in the shape of `start`."""
        values = np.asarray(start, dtype=np.float64)
        first = len(self._start)
        self._kinds.extend([int(kind)] * values.size)
        self._start.extend(values.ravel().tolist())
        return np.arange(first, first + values.size, dtype=np.int64).reshape(values.shape)

    def add_node(self, position: FloatArray, slope: FloatArray) -> IntArray:
        """Add r and r' of one node and return their six indices."""
        return np.concatenate((self.add(Kind.POSITION, position), self.add(Kind.SLOPE, slope)))

    def build(self) -> Unknowns:
        """Return the finished table."""
        return Unknowns(np.array(self._kinds, dtype=np.int64), np.array(self._start, dtype=np.float64))
