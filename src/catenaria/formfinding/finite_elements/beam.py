"""A tensioned beam: co-rotational, cubic between its nodes, with one axial strain for the whole element.

Written apart from `catenaria.mechanics`: rotations instead of slopes, the chord's frame instead of absolute
coordinates, and the mean strain of the element instead of the strain at points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Array = NDArray[Any]  # real, or complex where derivatives are taken by complex step

_LEVEL_I, _LEVEL_J = np.array([0, 0, 1.0, 0, 0, 0]), np.array([0, 0, 0, 0, 0, 1.0])  # theta_i, theta_j
_ALONG = np.array([-1.0, 0, 0, 1.0, 0, 0])  # x_j - x_i
_UP = np.array([0, 0.5, 0, 0, 0.5, 0])  # (z_i + z_j)/2


@dataclass(frozen=True)
class Section:
    """A cross-section: EA [N], EJ [N m^2], and weight per unstressed length [N/m]."""

    EA: float
    EJ: float
    weight: float


@dataclass(frozen=True)
class _Chord:
    """The chord of every element, and v = (l, a, b): its length and the end rotations against it.

    `l_q` and `beta_q` are the derivatives of its length and angle by the six coordinates, shape (n, 6).
    """

    dx: Array
    l: Array  # noqa: E741, the symbol
    a: Array
    b: Array
    l_q: Array
    beta_q: Array

    @classmethod
    def of(cls, q: Array) -> _Chord:
        dx, dz = q[:, 3] - q[:, 0], q[:, 4] - q[:, 1]
        l = np.sqrt(dx * dx + dz * dz)  # noqa: E741
        beta, c, s, o = np.arctan(dz / dx), dx / l, dz / l, np.zeros_like(l)
        l_q = np.stack((-c, -s, o, c, s, o), axis=1)
        beta_q = np.stack((s, -c, o, -s, c, o), axis=1) / l[:, None]
        return cls(dx, l, q[:, 2] - beta, q[:, 5] - beta, l_q, beta_q)

    @property
    def v_q(self) -> Array:
        """Derivatives of l, a, b by the coordinates, shape (n, 3, 6)."""
        return np.stack((self.l_q, _LEVEL_I - self.beta_q, _LEVEL_J - self.beta_q), axis=1)

    @property
    def bow(self) -> Array:
        """By which share the cubic is longer than its chord."""
        return (2.0 * self.a**2 - self.a * self.b + 2.0 * self.b**2) / 30.0

    @property
    def arc_v(self) -> Array:
        """Derivatives of the arc A = l (1 + bow) by l, a, b, shape (n, 3)."""
        a, b, l = self.a, self.b, self.l  # noqa: E741
        return np.stack((1.0 + self.bow, l * (4.0 * a - b) / 30.0, l * (4.0 * b - a) / 30.0), axis=1)


def axial_force(q: Array, L: Array, section: Section) -> Array:
    """Return the force EA eps |r'| along every element [N], for coordinates (n, 6) and lengths (n,)."""
    chord = _Chord.of(q)
    stretch = chord.l * (1.0 + chord.bow) / L
    return 0.5 * section.EA * (stretch * stretch - 1.0) * stretch


def end_moments(q: Array, section: Section) -> Array:
    """Return the moments EJ kappa at both ends of every element [N m], shape (n, 2)."""
    chord = _Chord.of(q)
    factor = 2.0 * section.EJ / chord.l
    return np.stack((-factor * (2.0 * chord.a + chord.b), factor * (chord.a + 2.0 * chord.b)), axis=1)


def force(q: Array, L: Array, section: Section) -> Array:
    r"""Return the derivative of the potential of every element by its coordinates.

    Parameters
    ----------
    q : array, shape (n, 6)
        x, z [m] and angle theta [rad] of the first and of the second node.
    L : array, shape (n,)
        Unstressed lengths [m].
    section : Section
        What the elements are made of.

    Returns
    -------
    array, shape (n, 6)
        Forces [N] and moments [N m] that hold the elements in this shape.

    Notes
    -----
    With the chord's length l and angle beta and the end rotations :math:`a = \theta_i - \beta`,
    :math:`b = \theta_j - \beta`, the cubic between the nodes has the arc
    :math:`A = l\,(1 + (2a^2 - ab + 2b^2)/30)`. One Green strain for the whole element, as of eq. (9), and
    the curvature of the cubic give

    .. math:: \Pi = \tfrac12 EA\,L\,\varepsilon^2 + \frac{2EJ\,L}{l^2}(a^2 + ab + b^2)
              + wL\left(\frac{z_i + z_j}{2} + \frac{(x_j - x_i)(a - b)}{12}\right),\qquad
              \varepsilon = \frac{(A/L)^2 - 1}{2}.

    References
    ----------
    Crisfield 1991, Non-linear Finite Element Analysis of Solids and Structures 1, section 7.3 (shallow arch).
    """
    chord = _Chord.of(q)
    a, b = chord.a, chord.b
    bend = 2.0 * section.EJ * L / chord.l**2
    bending = np.stack((-2.0 * (a * a + a * b + b * b) / chord.l, 2.0 * a + b, a + 2.0 * b), axis=1)
    inner = axial_force(q, L, section)[:, None] * chord.arc_v + bend[:, None] * bending
    turned = (q[:, 2] - q[:, 5])[:, None]
    weight = _UP + (turned * _ALONG + chord.dx[:, None] * (_LEVEL_I - _LEVEL_J)) / 12.0
    return np.einsum("nv,nvi->ni", inner, chord.v_q) + section.weight * L[:, None] * weight


def tangent(q: FloatArray, L: FloatArray, section: Section) -> tuple[FloatArray, FloatArray]:
    """Return the derivatives of `force`.

    Parameters
    ----------
    q, L, section
        As for `force`.

    Returns
    -------
    K : FloatArray, shape (n, 6, 6)
        By the coordinates.
    f_L : FloatArray, shape (n, 6)
        By the unstressed lengths.
    """
    chord = _Chord.of(q)
    v_q = chord.v_q
    N = axial_force(q, L, section)
    stretch = chord.l * (1.0 + chord.bow) / L
    modulus = section.EA * 0.5 * (3.0 * stretch**2 - 1.0)
    inner, stiffness = _bending(chord, section.EJ * L)
    pull = N[:, None] * chord.arc_v
    f_L = -(modulus * stretch / L)[:, None] * chord.arc_v + inner / L[:, None]
    stiffness = stiffness + (modulus / L)[:, None, None] * _outer(chord.arc_v, chord.arc_v)
    stiffness = stiffness + N[:, None, None] * _arc_vv(chord)
    K = v_q.swapaxes(1, 2) @ stiffness @ v_q + _of_frame(chord, inner + pull)
    twist = np.outer(_ALONG, _LEVEL_I - _LEVEL_J)
    K += section.weight * L[:, None, None] * (twist + twist.T) / 12.0
    turned = (q[:, 2] - q[:, 5])[:, None]
    weight = _UP + (turned * _ALONG + chord.dx[:, None] * (_LEVEL_I - _LEVEL_J)) / 12.0
    return K, np.einsum("nv,nvi->ni", f_L, v_q) + section.weight * weight


def _bending(chord: _Chord, EJL: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return gradient (n, 3) and Hessian (n, 3, 3) of 2 EJ L (a^2 + ab + b^2)/l^2 by l, a, b."""
    a, b, l = chord.a, chord.b, chord.l  # noqa: E741
    c, square = 2.0 * EJL / l**2, a * a + a * b + b * b
    by_a, by_b = c * (2.0 * a + b), c * (a + 2.0 * b)
    gradient = np.stack((-2.0 * c * square / l, by_a, by_b), axis=1)
    rows = (
        (6.0 * c * square / l**2, -2.0 * by_a / l, -2.0 * by_b / l),
        (-2.0 * by_a / l, 2.0 * c, c),
        (-2.0 * by_b / l, c, 2.0 * c),
    )
    return gradient, np.stack([np.stack(row, axis=1) for row in rows], axis=1)


def _arc_vv(chord: _Chord) -> FloatArray:
    """Return the second derivatives of the arc by l, a, b, shape (n, 3, 3)."""
    a, b, l, o = chord.a, chord.b, chord.l, np.zeros_like(chord.l)  # noqa: E741
    by_a, by_b = (4.0 * a - b) / 30.0, (4.0 * b - a) / 30.0
    rows = ((o, by_a, by_b), (by_a, 4.0 * l / 30.0, -l / 30.0), (by_b, -l / 30.0, 4.0 * l / 30.0))
    return np.stack([np.stack(row, axis=1) for row in rows], axis=1)


def _of_frame(chord: _Chord, inner: FloatArray) -> FloatArray:
    """Return the stiffness of forces that turn with the chord: inner times the second derivatives of v."""
    along = _outer(chord.l_q, chord.beta_q)
    second_l = chord.l[:, None, None] * _outer(chord.beta_q, chord.beta_q)
    second_beta = -(along + along.swapaxes(1, 2)) / chord.l[:, None, None]
    moments = (inner[:, 1] + inner[:, 2])[:, None, None]
    return inner[:, 0, None, None] * second_l - moments * second_beta


def _outer(u: FloatArray, v: FloatArray) -> FloatArray:
    return u[:, :, None] * v[:, None, :]
