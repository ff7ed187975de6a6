"""Compiled evaluation of points on a chain of cable elements, eqs. (2)-(5); see `numerics.hermite`.

Also for complex unknowns, so that derivatives can be checked by complex steps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.mechanics.kernels.compile import compiled

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@compiled
def elements_of(knots: FloatArray, s: FloatArray, element: IntArray, overlap: float) -> IntArray:
    """Return the elements in which points are, -1 beyond the ends; each keeps its own within an overlap."""
    found = np.empty_like(element)
    for i in range(s.size):
        e = element[i]
        slack = overlap * (knots[e + 1] - knots[e])
        if not (knots[0] <= s[i] <= knots[-1]):
            found[i] = -1
        elif knots[e] - slack <= s[i] <= knots[e + 1] + slack:
            found[i] = e
        else:
            e = np.searchsorted(knots, float(s[i]), side="right") - 1
            found[i] = e if e < knots.size - 1 else knots.size - 2
    return found


@compiled
def chain_points(
    z: FloatArray, nodes: IntArray, knots: FloatArray, s: FloatArray, element: IntArray
) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """Return indices (n, 4, 3), N (n, 4), N' (n, 4), and r, r', r'' (3, n, 3) of points in given elements."""
    n = s.size
    dofs = np.empty((n, 4, 3), np.int64)
    N, N1 = np.empty((n, 4), s.dtype), np.empty((n, 4), s.dtype)
    N2 = np.empty(4, s.dtype)
    r = np.zeros((3, n, 3), z.dtype)
    for i in range(n):
        e = element[i]
        L = knots[e + 1] - knots[e]
        xi = 2.0 * (s[i] - knots[e]) / L - 1.0
        m, p = xi - 1.0, xi + 1.0
        N[i, 0], N[i, 2] = m * m * (xi + 2.0) / 4.0, p * p * (2.0 - xi) / 4.0
        N[i, 1], N[i, 3] = L / 8.0 * m * m * p, L / 8.0 * p * p * m
        slope, bend = 1.5 / L * m * p, 6.0 * xi / (L * L)
        N1[i, 0], N1[i, 2] = slope, -slope
        N1[i, 1], N1[i, 3] = 0.25 * m * (3.0 * xi + 1.0), 0.25 * p * (3.0 * xi - 1.0)
        N2[0], N2[2] = bend, -bend
        N2[1], N2[3] = (3.0 * xi - 1.0) / L, (3.0 * xi + 1.0) / L
        for k in range(4):
            for j in range(3):
                index = nodes[e + k // 2, 3 * (k % 2) + j]
                dofs[i, k, j] = index
                r[0, i, j] += N[i, k] * z[index]
                r[1, i, j] += N1[i, k] * z[index]
                r[2, i, j] += N2[k] * z[index]
    return dofs, N, N1, r
