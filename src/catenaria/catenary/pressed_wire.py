"""A taut wire that is pressed at one point between two hinges, in closed form and by cubic elements."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.numerics.hermite import shape

FloatArray = NDArray[np.float64]


def pressed_wire(x: FloatArray, length: float, T: float, EJ: float) -> FloatArray:
    r"""Return how far a taut wire gives way to a unit force at x [m/N], shape (n,).

    Parameters
    ----------
    x : FloatArray, shape (n,)
        Between two hinges at 0 and `length` [m].
    length : float
        Distance of the hinges [m].
    T, EJ : float
        Tension [N] and bending stiffness [N m^2].

    Notes
    -----
    With l = sqrt(EJ/T), the solution of EJ w'''' - T w'' = delta(x) is

    .. math:: w = \frac1T\left(\frac{x(L-x)}{L} - l\,\frac{\sinh(x/l)\,\sinh((L-x)/l)}{\sinh(L/l)}\right).

    Examples
    --------
    A string of 60 m under 15 kN, pressed in the middle: L/(4 T).

    >>> float(pressed_wire(np.array([30.0]), 60.0, 15e3, 0.0)[0]) == 60.0 / (4.0 * 15e3)
    True
    """
    string = x * (length - x) / length
    if EJ == 0.0:
        return string / T
    k = 2.0 * np.sqrt(T / EJ)
    bent = np.expm1(-k * x) * np.expm1(-k * (length - x)) / -np.expm1(-k * length)
    return (string - bent / k) / T


def pressed_elements(knots: FloatArray, element: int, x: FloatArray, T: float, EJ: float) -> FloatArray:
    """Return how far the same wire gives way to a unit force if it consists of cubic elements [m/N].

    Parameters
    ----------
    knots : FloatArray, shape (n_nodes,)
        Ascending positions of nodes; the wire is hinged at the first and the last [m].
    element : int
        Which element is pressed.
    x : FloatArray, shape (n,)
        Where, within that element [m].
    T, EJ : float
        Tension [N] and bending stiffness [N m^2].

    Notes
    -----
    The stiffness of a beam with cubic Hermite functions, and the geometric one of its tension by the same.
    """
    h = np.diff(knots)
    K = np.zeros((2 * knots.size, 2 * knots.size))
    for e, own in enumerate(_stiffness(h, T, EJ)):
        K[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += own
    free = np.delete(np.arange(2 * knots.size), [0, 2 * knots.size - 2])
    at = np.arange(2 * element, 2 * element + 4)
    xi = 2.0 * (x - knots[element]) / h[element] - 1.0
    load = np.zeros((2 * knots.size, x.size))
    load[at] = shape(xi, np.full(x.size, h[element])).T
    moved = np.linalg.solve(K[np.ix_(free, free)], load[free])
    return np.einsum("ij,ij->j", load[free], moved)


def _stiffness(h: FloatArray, T: float, EJ: float) -> FloatArray:
    """Return the stiffness of elements by deflection and slope at both ends, shape (n, 4, 4)."""
    scale = np.stack((np.ones(h.size), h, np.ones(h.size), h), axis=1)
    taut = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) / 30.0
    bent = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]], dtype=np.float64)
    own = T * taut / h[:, None, None] + EJ * bent / h[:, None, None] ** 3
    return own * scale[:, :, None] * scale[:, None, :]
