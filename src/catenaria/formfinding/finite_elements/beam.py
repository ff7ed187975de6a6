"""A tensioned beam: co-rotational, cubic between its nodes, with one axial strain for the whole element.

Written apart from `catenaria.mechanics`: rotations instead of slopes, the chord's frame instead of absolute
coordinates, and the mean strain of the element instead of the strain at points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

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


class _Even(NamedTuple):
    """An even polynomial p0 (a^2 + b^2) + p1 ab + q0 (a^4 + b^4) + q1 ab (a^2 + b^2) + q2 a^2 b^2."""

    p0: float
    p1: float
    q0: float
    q1: float
    q2: float

    def value(self, a: Array, b: Array) -> Array:
        """Return its values."""
        squares, product = a * a + b * b, a * b
        fourth = self.q0 * (a**4 + b**4) + product * (self.q1 * squares + self.q2 * product)
        return self.p0 * squares + self.p1 * product + fourth

    def by_first(self, a: Array, b: Array) -> Array:
        """Return its derivative by a; that by b is the same with a and b exchanged."""
        third = 4.0 * self.q0 * a**3 + self.q1 * b * (3.0 * a * a + b * b) + 2.0 * self.q2 * a * b * b
        return 2.0 * self.p0 * a + self.p1 * b + third

    def twice(self, a: Array, b: Array) -> Array:
        """Return its second derivative by a."""
        return 2.0 * self.p0 + 12.0 * self.q0 * a * a + 6.0 * self.q1 * a * b + 2.0 * self.q2 * b * b

    def mixed(self, a: Array, b: Array) -> Array:
        """Return its derivative by a and b."""
        return self.p1 + 3.0 * self.q1 * (a * a + b * b) + 4.0 * self.q2 * a * b


_BOW = _Even(1 / 15, -1 / 30, -7 / 900, -31 / 12600, 11 / 1400)
_BENDING = _Even(1.0, 1.0, -71 / 1050, -2 / 525, -36 / 175)


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
        return _BOW.value(self.a, self.b)

    @property
    def arc_v(self) -> Array:
        """Derivatives of the arc A = l (1 + bow) by l, a, b, shape (n, 3)."""
        a, b, l = self.a, self.b, self.l  # noqa: E741
        return np.stack((1.0 + self.bow, l * _BOW.by_first(a, b), l * _BOW.by_first(b, a)), axis=1)


def arc_length(q: Array) -> Array:
    """Return the length along every element, for coordinates (n, 6) [m]."""
    chord = _Chord.of(q)
    return chord.l * (1.0 + chord.bow)


def axial_force(q: Array, L: Array, section: Section) -> Array:
    """Return the force EA eps |r'| along every element [N], for coordinates (n, 6) and lengths (n,)."""
    stretch = arc_length(q) / L
    return 0.5 * section.EA * (stretch * stretch - 1.0) * stretch


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
    :math:`b = \theta_j - \beta`, the cubic between the nodes has the arc A, and one Green strain, as of
    eq. (9), belongs to the whole element:

    .. math::
        A &= l\,\left(1 + \tfrac{1}{30}(2a^2 - ab + 2b^2) + O(a^4)\right),\qquad
        \varepsilon = \tfrac12\left((A/L)^2 - 1\right)

        \Pi &= \tfrac12 EA\,L\,\varepsilon^2 + \frac{2EJ\,L}{l^2}\left(a^2 + ab + b^2 + O(a^4)\right)
              + wL\left(\frac{z_i + z_j}{2} + \frac{(x_j - x_i)(a - b)}{12}\right).

    Terms of fourth order are those of the cubic in the arc length; without them nodes are out of balance by
    some tenths of a newton beside supports.

    References
    ----------
    Crisfield 1991, Non-linear Finite Element Analysis of Solids and Structures 1, chapter 7.
    """
    chord = _Chord.of(q)
    a, b = chord.a, chord.b
    bend = 2.0 * section.EJ * L / chord.l**2
    shape = -2.0 * _BENDING.value(a, b) / chord.l, _BENDING.by_first(a, b), _BENDING.by_first(b, a)
    bending = np.stack(shape, axis=1)
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
    turning = v_q.swapaxes(1, 2) @ stiffness @ v_q + _of_frame(chord, inner + pull)
    twist = np.outer(_ALONG, _LEVEL_I - _LEVEL_J)
    K = turning + section.weight * L[:, None, None] * (twist + twist.T) / 12.0
    turned = (q[:, 2] - q[:, 5])[:, None]
    weight = _UP + (turned * _ALONG + chord.dx[:, None] * (_LEVEL_I - _LEVEL_J)) / 12.0
    return K, np.einsum("nv,nvi->ni", f_L, v_q) + section.weight * weight


def _bending(chord: _Chord, EJL: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return gradient (n, 3) and Hessian (n, 3, 3) of 2 EJ L (a^2 + ab + b^2 + ...)/l^2 by l, a, b."""
    a, b, l = chord.a, chord.b, chord.l  # noqa: E741
    c, square = 2.0 * EJL / l**2, _BENDING.value(a, b)
    by_a, by_b = c * _BENDING.by_first(a, b), c * _BENDING.by_first(b, a)
    mixed = c * _BENDING.mixed(a, b)
    gradient = np.stack((-2.0 * c * square / l, by_a, by_b), axis=1)
    rows = (
        (6.0 * c * square / l**2, -2.0 * by_a / l, -2.0 * by_b / l),
        (-2.0 * by_a / l, c * _BENDING.twice(a, b), mixed),
        (-2.0 * by_b / l, mixed, c * _BENDING.twice(b, a)),
    )
    return gradient, np.stack([np.stack(row, axis=1) for row in rows], axis=1)


def _arc_vv(chord: _Chord) -> FloatArray:
    """Return the second derivatives of the arc by l, a, b, shape (n, 3, 3)."""
    a, b, l, o = chord.a, chord.b, chord.l, np.zeros_like(chord.l)  # noqa: E741
    by_a, by_b, mixed = _BOW.by_first(a, b), _BOW.by_first(b, a), l * _BOW.mixed(a, b)
    rows = ((o, by_a, by_b), (by_a, l * _BOW.twice(a, b), mixed), (by_b, mixed, l * _BOW.twice(b, a)))
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
