"""A taut wire in closed form: a string whose kinks are rounded by bending, and the length of its arc.

Near every support and clamp a wire under tension T bends within a few lengths sqrt(EJ/T), and is a string
elsewhere. Two such places are usually many of these lengths apart, so that each can be treated alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.taut_string import taut_string

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Points = tuple[FloatArray, FloatArray]

_SHARE = 0.25  # of the bay to the next kink, at most, in which the rounding of a kink decays
_CORRECTIONS = 3  # of what the rounding at supports does to the string


class _Bays(NamedTuple):
    """The string between two kinks: from its origin on, z = z0 + slope d + curvature d^2/2.

    The straight continuation before the first kink has its origin there, too.
    """

    x: FloatArray
    z: FloatArray
    slope: FloatArray
    slope_ahead: FloatArray
    curvature: FloatArray
    length: FloatArray


@dataclass(frozen=True)
class TautWire:
    r"""A wire over several points, hinged at the first and the last one; beyond these it goes straight on.

    Parameters
    ----------
    x, z : FloatArray, shape (n,)
        Ascending positions of all kinks and the string's heights there [m].
    H, w : float
        Horizontal tension [N] and weight per length [N/m].
    EJ : float
        Bending stiffness [N m^2].

    Notes
    -----
    The string is a parabola in every bay, H z'' = w. A jump J of its slope (a force -H J upwards) is rounded
    within l = sqrt(EJ/H), because EJ z'''' - H z'' = -w has the solution

    .. math:: z = z_\text{string} + \tfrac12 J l\, e^{-|x - x_k|/l},

    for which slope and curvature are continuous. What the arc gains over its chord is

    .. math:: \int \left(\sqrt{1 + z'^2} - 1\right) dx
              \approx \int \left(\tfrac12 z_\text{string}'^2 - \tfrac18 z_\text{string}'^4\right) dx
              - \tfrac38 \sum J_k^2 l.

    Neglected: what one kink does in the boundary layer of the next, exp(-b/l) for a bay b. Where b is below
    4 l, a quarter of it stands for l.

    Examples
    --------
    A span of 65 m with 15 N/m and 15 kN: sag w L^2/(8 H), excess of the arc w^2 L^3/(24 H^2).

    >>> wire = TautWire(np.array([0.0, 65.0]), np.zeros(2), H=15e3, w=15.0, EJ=0.0)
    >>> round(float(wire.height(np.array([32.5]))[0]), 4)
    -0.5281
    >>> round(1e3 * float(wire.arc_excess(np.array([65.0]))[0]), 3)  # mm
    11.441
    """

    x: FloatArray
    z: FloatArray
    H: float
    w: float
    EJ: float

    @classmethod
    def held(cls, supports: Points, H: float, w: float, EJ: float, loads: Points | None = None) -> TautWire:
        """Return the wire that runs through the given points of support, under point loads.

        Parameters
        ----------
        supports : tuple of FloatArray, shape (m,) each
            Ascending positions and heights; the first and the last one are the wire's ends [m].
        H, w, EJ
            See the class.
        loads : tuple of FloatArray, shape (k,) each, optional
            Positions between the supports [m] and sizes, positive downwards [N].

        Notes
        -----
        The rounded wire shall pass through the supports, so the string has to pass l J/2 above or below; J
        hardly changes by that, and each correction leaves at most a third of what the one before left.
        """
        at, height = supports
        x = at if loads is None else np.concatenate((at, loads[0]))
        order = np.argsort(x, kind="stable")
        x, is_support = x[order], order < at.size
        string = cls(x, _string_height(x, (at, height), H, w, loads), H, w, EJ)
        for _ in range(_CORRECTIONS if EJ > 0.0 else 0):
            raised = height - string._rounding[is_support]
            string = cls(x, _string_height(x, (at, raised), H, w, loads), H, w, EJ)
        return string

    @cached_property
    def _bays(self) -> _Bays:
        b, none = np.diff(self.x), np.zeros(1)
        chord, half = np.diff(self.z) / b, 0.5 * self.w / self.H * b
        start, end = chord - half, chord + half
        return _Bays(
            np.concatenate((self.x[:1], self.x)),
            np.concatenate((self.z[:1], self.z)),
            np.concatenate((start[:1], start, end[-1:])),
            np.concatenate((start[:1], end, end[-1:])),
            np.concatenate((none, np.full(b.size, self.w / self.H), none)),
            np.concatenate((none, b, none)),
        )

    @cached_property
    def jump(self) -> FloatArray:
        """Jump of the slope at every kink, none at the ends."""
        return self._bays.slope[1:] - self._bays.slope_ahead[:-1]

    def force(self, x: FloatArray) -> FloatArray:
        """Return the forces that hold the wire at the kinks that are at x [N], positive upwards."""
        return -self.H * self.jump[np.searchsorted(self.x, x)]

    def kink_slopes(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the string's slopes before and behind the kinks that are at x."""
        k = np.searchsorted(self.x, x)
        return self._bays.slope_ahead[k], self._bays.slope[k + 1]

    @cached_property
    def _lengths(self) -> FloatArray:
        """The l of every kink [m], cut where the next one is too near for a layer of its own."""
        b = np.concatenate(([np.inf], np.diff(self.x), [np.inf]))
        return np.minimum(np.sqrt(self.EJ / self.H), _SHARE * np.minimum(b[:-1], b[1:]))

    @property
    def _rounding(self) -> FloatArray:
        """By how much the rounded wire is above the string at the kinks [m]."""
        return 0.5 * self.jump * self._lengths

    def _near(self, x: FloatArray) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
        """Return the bay of each point, its distance to the bay's origin, exp(-|x - x_k|/l) of both kinks."""
        bay = np.searchsorted(self.x, x, side="right")
        behind, ahead = self._bays.x[bay], np.append(self.x, self.x[-1])[bay]
        length = _padded(self._lengths)
        decay = _decay(x - behind, length[bay]), _decay(ahead - x, length[bay + 1])
        return bay, x - behind, *decay

    def height(self, x: FloatArray) -> FloatArray:
        """Return the heights at x [m], shape (n,)."""
        bay, d, behind, ahead = self._near(x)
        own, layer = self._bays, _padded(self._rounding)
        string = own.z[bay] + own.slope[bay] * d + 0.5 * own.curvature[bay] * d * d
        return string + layer[bay] * behind + layer[bay + 1] * ahead

    def slope(self, x: FloatArray) -> FloatArray:
        """Return the slopes dz/dx at x, shape (n,)."""
        bay, d, behind, ahead = self._near(x)
        own, layer = self._bays, 0.5 * _padded(self.jump)
        return own.slope[bay] + own.curvature[bay] * d - layer[bay] * behind + layer[bay + 1] * ahead

    def arc_excess(self, x: FloatArray) -> FloatArray:
        """Return how much longer than its chord the arc from the start to x is [m], shape (n,)."""
        bay, d, behind, ahead = self._near(x)
        start, curvature = self._bays.slope[bay], self._bays.curvature[bay]
        return (
            self._excess_before[bay]
            + _parabola(start, start + curvature * d, d)
            + (self._layers(bay, behind, ahead))
        )

    @cached_property
    def _excess_before(self) -> FloatArray:
        """What all bays before each bay add to the excess [m]."""
        own, every = self._bays, np.arange(self.x.size + 1)
        gone, full = np.zeros(every.size), np.ones(every.size)
        whole = _parabola(own.slope, own.slope_ahead, own.length) + self._layers(every, gone, full)
        return np.concatenate(([0.0], np.cumsum(whole)[:-1]))

    def _layers(self, bay: IntArray, behind: FloatArray, ahead: FloatArray) -> FloatArray:
        """Return the share of the roundings in the excess, from the start of a bay to a point in it [m]."""
        J, own, length = _padded(self.jump), self._bays, _padded(self._lengths)
        left, right = J[bay], J[bay + 1]
        from_left = 0.0625 * left**2 * (1.0 - behind**2) - 0.5 * left * own.slope[bay] * (1.0 - behind)
        from_right = 0.0625 * right**2 * ahead**2 + 0.5 * right * own.slope_ahead[bay] * ahead
        return length[bay] * from_left + length[bay + 1] * from_right


def _string_height(x: FloatArray, supports: Points, H: float, w: float, loads: Points | None) -> FloatArray:
    """Return the heights of a string at its supports and loads, which are at x [m]."""
    return supports[1] if loads is None else taut_string(x, supports, H, w, loads)[0]


def _padded(values: FloatArray) -> FloatArray:
    """Return what belongs to kinks with nothing before the first and after the last one."""
    return np.concatenate(([0.0], values, [0.0]))


def _decay(distance: FloatArray, length: FloatArray) -> FloatArray:
    """Return exp(-|distance|/l), also for l = 0."""
    far = np.abs(distance)
    ratio = np.divide(far, length, out=np.full_like(far, np.inf), where=length > 0.0)
    return np.exp(-np.where(far > 0.0, ratio, 0.0))


def _parabola(start: FloatArray, end: FloatArray, length: FloatArray) -> FloatArray:
    """Return the integral of sqrt(1 + z'^2) - 1 to fourth order, for a slope z' that varies linearly."""
    square = start * start + start * end + end * end
    fourth = square * square - start * end * (start + end) ** 2
    return length * (square / 6.0 - fourth / 40.0)
