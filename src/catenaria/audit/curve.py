"""A wire as the curve that its nodes describe: cubic Hermite pieces (1)-(5), written in t = l/L of [0, 1]."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.errors import InconsistentInputError

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

INTERVALS = 8  # 9 points: exact to degree 9, where EA eps^2 has degree 8

# Powers of t in the four shape functions, which belong to r_i, L r_i', r_j, L r_j'.
_CUBICS = np.array(
    [[1.0, 0.0, -3.0, 2.0], [0.0, 1.0, -2.0, 1.0], [0.0, 0.0, 3.0, -2.0], [0.0, 0.0, -1.0, 1.0]]
)
_D = np.diag([1.0, 2.0, 3.0], -1)  # takes powers of t to those of the derivative by t
_DERIVATIVES = (_CUBICS @ _D, _CUBICS @ _D @ _D)


@dataclass(frozen=True)
class Points:
    """Points on a curve: element, shape functions (n, 4) and r, r', r'' (n, 3)."""

    element: IntArray
    N: FloatArray
    r: FloatArray
    r1: FloatArray
    r2: FloatArray


@dataclass(frozen=True)
class Curve:
    """A wire's configuration.

    Parameters
    ----------
    s : FloatArray, shape (n,)
        Material coordinates of the nodes, ascending [m].
    r, r1 : FloatArray, shape (n, 3)
        Positions [m] and slopes of the nodes.

    Raises
    ------
    InconsistentInputError
        If shapes do not fit or the coordinates do not ascend.
    """

    s: FloatArray
    r: FloatArray
    r1: FloatArray

    def __post_init__(self) -> None:
        shape = (self.s.size, 3)
        if self.s.size < 2 or self.r.shape != shape or self.r1.shape != shape or np.any(np.diff(self.s) <= 0):
            raise InconsistentInputError("a wire of the result needs nodes at ascending coordinates")

    @cached_property
    def L(self) -> FloatArray:  # noqa: N802, the symbol of the paper
        """Unstressed length of every element [m]."""
        return np.diff(self.s)

    @cached_property
    def q(self) -> FloatArray:
        """Coordinates r_i, r_i', r_j, r_j' of every element, shape (n - 1, 4, 3)."""
        return np.stack((self.r[:-1], self.r1[:-1], self.r[1:], self.r1[1:]), axis=1)

    def at(self, s: FloatArray, side: Literal["left", "right"] = "right") -> Points:
        """Return the points with the given material coordinates, r'' at a node from the given side of it."""
        element = np.clip(np.searchsorted(self.s, s, side=side) - 1, 0, self.s.size - 2)
        L = self.L[element]
        t = (s - self.s[element]) / L
        powers, q = _powers(t), self.q[element]
        N, N1, N2 = (_shape_functions(powers, L, order) for order in range(3))
        r, r1, r2 = (np.einsum("nk,nki->ni", functions, q) for functions in (N, N1, N2))
        return Points(element, N, r, r1, r2)

    @cached_property
    def slopes(self) -> FloatArray:
        """Slopes r' in the g = `INTERVALS` + 1 points of quadrature of every element, shape (n - 1, g, 3)."""
        t, _ = clenshaw_curtis(INTERVALS)
        return shape_functions(np.broadcast_to(t, (self.L.size, t.size)), self.L[:, None], 1) @ self.q

    @cached_property
    def stretch(self) -> FloatArray:
        """Sizes of these slopes, shape (n - 1, g)."""
        return np.sqrt(np.einsum("egi,egi->eg", self.slopes, self.slopes))

    def stretched_length(self, start: float, end: float) -> float:
        """Return the deformed length between two material coordinates [m]."""
        points, weights = clenshaw_curtis(INTERVALS)
        whole = self.L * (self.stretch @ weights)
        upto = np.concatenate(([0.0], np.cumsum(whole)))
        ends = np.array([start, end])
        element = self.at(ends).element
        piece = ends - self.s[element]
        stretch = np.linalg.norm(
            self.at((self.s[element, None] + piece[:, None] * points).ravel()).r1, axis=1
        )
        before, after = upto[element] + piece * (stretch.reshape(2, -1) @ weights)
        return float(after - before)


def shape_functions(t: FloatArray, L: FloatArray, order: int) -> FloatArray:
    """Return the shape functions or a derivative of them by arc length.

    Parameters
    ----------
    t : FloatArray
        l/L, from 0 to 1 in an element.
    L : FloatArray, broadcastable to t
        Unstressed lengths [m].
    order : int
        0, 1 or 2 derivatives.

    Returns
    -------
    FloatArray, shape (*t.shape, 4)
        In the order of r_i, r_i', r_j, r_j'.
    """
    return _shape_functions(_powers(t), L, order)


def _powers(t: FloatArray) -> FloatArray:
    return np.stack((np.ones_like(t), t, t * t, t * t * t), axis=-1)


def _shape_functions(powers: FloatArray, L: FloatArray, order: int) -> FloatArray:
    cubics = _CUBICS if order == 0 else _DERIVATIVES[order - 1]
    values, length = powers @ cubics.T, L[..., None]
    values[..., ::2] /= length**order
    values[..., 1::2] *= length ** (1 - order)
    return values
