"""Balance of a net of strings in one direction at each of its knots: one sparse linear system."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array  # pyright: ignore[reportMissingTypeStubs]

from catenaria.errors import InconsistentInputError
from catenaria.solvers.linear import factorise

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Links:
    """What pulls two knots together with a known force density.

    Attributes
    ----------
    tail, head : IntArray, shape (m,)
        Knots.
    density : FloatArray, shape (m,)
        Force per length [N/m].
    gap : FloatArray, shape (m, 3)
        From tail to head, as it is [m].
    """

    tail: IntArray
    head: IntArray
    density: FloatArray
    gap: FloatArray


class Holding(NamedTuple):
    """What holds and loads points, of shape (n,) each: stiffness [N/m], way [m] and load [N].

    The stiffness is infinite where a point is fixed; the way leads to where the point is fixed, or where its
    spring is at rest.
    """

    stiffness: FloatArray
    way: FloatArray
    load: FloatArray


@dataclass(frozen=True)
class Demands:
    """Forces between two knots each that are unknown, and what they shall do.

    Attributes
    ----------
    lower, upper : IntArray, shape (k,)
        Knots; the force is positive if it pulls the lower one in the direction of balance.
    move : FloatArray, shape (k,)
        How far the lower knots shall move [m].
    """

    lower: IntArray
    upper: IntArray
    move: FloatArray

    @classmethod
    def none(cls) -> Demands:
        """Return no demand."""
        knots = np.zeros(0, dtype=np.int64)
        return cls(knots, knots, np.zeros(0))


def balance(
    links: Links,
    direction: FloatArray,
    holding: Holding,
    demands: Demands,
) -> tuple[FloatArray, FloatArray]:
    r"""Return how far knots move in their directions until all forces balance there, and unknown forces.

    Parameters
    ----------
    links : Links
        Strings.
    direction : FloatArray, shape (n, 3)
        Unit vectors d of the knots.
    holding : Holding
        Stiffness k, way c and load p of every knot in its direction.
    demands : Demands
        Unknown forces, none of which may pull at a fixed lower knot.

    Returns
    -------
    move : FloatArray, shape (n,)
        The moves a [m].
    force : FloatArray, shape (k,)
        The unknown forces [N].

    Raises
    ------
    InconsistentInputError
        If the system is singular.

    Notes
    -----
    With force densities q, the row of knot i is

    .. math:: \sum_j q_{ij}\, d_i\cdot(r_j + a_j d_j - r_i - a_i d_i) + k_i (c_i - a_i) + p_i \pm F = 0.

    Examples
    --------
    A string of 10 m between two fixed knots, under 1000 N, loaded by 8 N in its middle, sags by P L/(4 H).

    >>> ends = Links(np.array([0, 1]), np.array([1, 2]), np.full(2, 200.0), np.full((2, 3), [5.0, 0.0, 0.0]))
    >>> held = Holding(np.array([np.inf, 0.0, np.inf]), np.zeros(3), np.array([0.0, -8.0, 0.0]))
    >>> move, _ = balance(ends, np.tile([0.0, 0.0, 1.0], (3, 1)), held, Demands.none())
    >>> round(float(move[1]), 9)
    -0.02
    """
    k, way, load = holding
    n, count = load.size, demands.move.size
    fixed = np.isinf(k)
    tail, head, q = links.tail, links.head, links.density
    forward = q * np.einsum("mi,mi->m", direction[tail], links.gap)
    backward = q * np.einsum("mi,mi->m", direction[head], links.gap)
    cross = -q * np.einsum("mi,mi->m", direction[tail], direction[head])
    pulled = load + np.bincount(tail, forward, n) - np.bincount(head, backward, n)
    stiff = np.where(fixed, 1.0, np.bincount(tail, q, n) + np.bincount(head, q, n) + k)
    right = np.concatenate((np.where(fixed, way, pulled + np.where(fixed, 0.0, k) * way), demands.move))
    every, force, one = np.arange(n), n + np.arange(count), np.ones(count)
    rows = np.concatenate((every, tail, head, demands.lower, demands.upper, force))
    columns = np.concatenate((every, head, tail, force, force, demands.lower))
    values = np.concatenate((stiff, cross, cross, -one, one, one))
    values[n : -count or None][fixed[rows[n : -count or None]]] = 0.0
    matrix = csc_array((values, (rows, columns)), shape=(n + count, n + count))
    try:
        solution = factorise(matrix).solve(right)
    except np.linalg.LinAlgError as error:
        raise InconsistentInputError("the wires are held so that their forces cannot balance") from error
    return solution[:n], solution[n:]
