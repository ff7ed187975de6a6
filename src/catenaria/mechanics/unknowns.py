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
    >>> builder.add(Kind.POSITION, [0.0, 0.0, 1.5], at=3.0)
    array([0, 1, 2])
    >>> builder.add(Kind.MULTIPLIER, [0.0], at=1.0)
    array([3])
    >>> builder.build().size
    4
    >>> unknowns, number = builder.build_along_line()
    >>> number  # what lies at 1 m along the line comes first
    array([1, 2, 3, 0])
    """

    _kinds: list[IntArray] = field(default_factory=list[IntArray])
    _start: list[FloatArray] = field(default_factory=list[FloatArray])
    _at: list[FloatArray] = field(default_factory=list[FloatArray])
    _size: int = 0

    def add(self, kind: Kind, start: FloatArray | list[float], at: FloatArray | float = 0.0) -> IntArray:
        """Add unknowns of one kind and return their indices, in the shape of `start`.

        Parameters
        ----------
        kind : Kind
            What they are.
        start : FloatArray
            Starting values.
        at : FloatArray or float
            Where along the line they belong, for `build_along_line` [m]: one value, or one a row of `start`.
        """
        values = np.asarray(start, dtype=np.float64)
        return self._append(np.full(values.shape, int(kind), dtype=np.int64), values, at)

    def add_node(self, position: FloatArray, slope: FloatArray) -> IntArray:
        """Add r and r' of one node, shape (3,) each, and return their six indices."""
        return self.add_nodes(np.asarray(position)[None, :], np.asarray(slope)[None, :])[0]

    def add_nodes(self, position: FloatArray, slope: FloatArray, at: FloatArray | None = None) -> IntArray:
        """Add r and r' of nodes, shape (n, 3) each, and return their indices, shape (n, 6).

        They belong where they are along the x-axis, unless `at`, shape (n,), says where along the line.
        """
        kinds = np.full((position.shape[0], 6), int(Kind.POSITION), dtype=np.int64)
        kinds[:, 3:] = int(Kind.SLOPE)
        return self._append(kinds, np.hstack((position, slope)), position[:, 0] if at is None else at)

    def _append(self, kinds: IntArray, values: FloatArray, at: FloatArray | float) -> IntArray:
        first, self._size = self._size, self._size + values.size
        place = np.asarray(at, dtype=np.float64)
        self._kinds.append(kinds.ravel())
        self._start.append(values.ravel())
        self._at.append(
            np.broadcast_to(
                place.reshape(place.shape + (1,) * (values.ndim - place.ndim)), values.shape
            ).ravel()
        )
        return np.arange(first, self._size, dtype=np.int64).reshape(values.shape)

    def build(self) -> Unknowns:
        """Return the finished table."""
        return Unknowns(np.concatenate(self._kinds), np.concatenate(self._start))

    def build_along_line(self) -> tuple[Unknowns, IntArray]:
        """Return the table numbered along the line, and the final number of each index handed out.

        Notes
        -----
        A matrix numbered along the line has a narrow band, and is factorised in half the time.
        """
        table = self.build()
        order = np.argsort(np.concatenate(self._at), kind="stable")
        number = np.empty_like(order)
        number[order] = np.arange(order.size)
        return Unknowns(table.kind[order], table.start[order]), number
