"""The track in space, from its curves and gradients by superposed ramps and a quadrature of its own."""

from __future__ import annotations

from dataclasses import dataclass
from math import factorial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.quadrature import clenshaw_curtis

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_PANEL = 20.0  # m: a track turns by a fifth of a radian in it at most, which nine points integrate exactly
_INTERVALS = 8


@dataclass(frozen=True)
class Across:
    """The planes across the track at some chainages: P and the unit vectors t, l, u, shape (n, 3) each."""

    origin: FloatArray
    along: FloatArray
    left: FloatArray
    up: FloatArray

    def off(self, r: FloatArray) -> FloatArray:
        """Return how far points are before or behind their planes, t.(r - P) [m]."""
        return np.einsum("ni,ni->n", self.along, r - self.origin)

    def lateral(self, r: FloatArray) -> FloatArray:
        """Return the offsets of points to the left, l.(r - P) [m]."""
        return np.einsum("ni,ni->n", self.left, r - self.origin)

    def height(self, r: FloatArray) -> FloatArray:
        """Return the heights of points above the canted track, u.(r - P) [m]."""
        return np.einsum("ni,ni->n", self.up, r - self.origin)

    def point(self, lateral: FloatArray, height: FloatArray) -> FloatArray:
        """Return the points P + b l + h u [m]."""
        return self.origin + lateral[:, None] * self.left + height[:, None] * self.up

    def take(self, index: IntArray) -> Across:
        """Return some of the planes."""
        return Across(self.origin[index], self.along[index], self.left[index], self.up[index])

    @property
    def sideways(self) -> FloatArray:
        """Horizontal unit vectors to the left."""
        return np.column_stack((-self.along[:, 1], self.along[:, 0], np.zeros(len(self.along))))


@dataclass(frozen=True)
class Ramps:
    """Curves of the track: where they begin and end, how long they take to build up, and what they turn.

    Attributes
    ----------
    start, end, transition : FloatArray, shape (k,)
        Chainages, and the lengths of the two transitions [m].
    curvature : FloatArray, shape (k,)
        Positive to the left [1/m].
    tilt : FloatArray, shape (k,)
        Sine of the angle by which the right rail is raised.
    """

    start: FloatArray
    end: FloatArray
    transition: FloatArray
    curvature: FloatArray
    tilt: FloatArray

    def sum(self, c: FloatArray, size: FloatArray, order: int) -> FloatArray:
        r"""Return the sum of size times the share of each curve at chainages, integrated `order` times.

        Notes
        -----
        A share grows linearly over the transition, is 1, and falls. With :math:`p_n(x) = \max(x, 0)^n/n!` it
        is :math:`(p_1(c-a) - p_1(c-a-T) - p_1(c-b+T) + p_1(c-b))/T`; n grows by one with every integral, and
        without transitions n is one less and the division is left out.
        """
        total = np.zeros_like(c)
        for a, b, T, weight in zip(self.start, self.end, self.transition, size, strict=True):
            if T > 0.0:
                steps = zip((a, a + T, b - T, b), (1.0, -1.0, -1.0, 1.0), strict=True)
                total += weight / T * sum(sign * _power(c - at, order + 1) for at, sign in steps)
            else:
                total += weight * (_power(c - a, order) - _power(c - b, order))
        return total


@dataclass(frozen=True)
class Track:
    """The course of the track.

    Attributes
    ----------
    begin : float
        Chainage at which the track runs along x through y = z = 0 [m].
    ramps : Ramps
        Its curves.
    slope_from, slope_until, slope_change : FloatArray
        Chainages from and until which the slope changes [m], and by how much.
    """

    begin: float
    ramps: Ramps
    slope_from: FloatArray
    slope_until: FloatArray
    slope_change: FloatArray

    def across(self, chainage: FloatArray) -> Across:
        """Return the planes across the track at chainages."""
        heading = self._heading(chainage)
        t = np.column_stack((np.cos(heading), np.sin(heading), np.zeros_like(heading)))
        n = np.column_stack((-t[:, 1], t[:, 0], t[:, 2]))
        sine = self.ramps.sum(chainage, self.ramps.tilt, 0)[:, None]
        cosine = np.sqrt(1.0 - sine**2)
        ez = np.array([0.0, 0.0, 1.0])
        plan = self._plan(chainage)
        return Across(
            np.column_stack((plan, self._elevation(chainage))),
            t,
            cosine * n - sine * ez,
            sine * n + cosine * ez,
        )

    def _heading(self, c: FloatArray) -> FloatArray:
        k = self.ramps.curvature
        return self.ramps.sum(c, k, 1) - self.ramps.sum(np.array([self.begin]), k, 1)

    def _elevation(self, c: FloatArray) -> FloatArray:
        at, over = np.append(c, self.begin)[:, None], self.slope_until - self.slope_from
        parabola = _power(at - self.slope_from, 2) - _power(at - self.slope_until, 2)
        sharp = over == 0.0
        share = np.where(sharp, _power(at - self.slope_from, 1), parabola / np.where(sharp, 1.0, over))
        rise = share @ self.slope_change
        return rise[:-1] - rise[-1]

    def _plan(self, c: FloatArray) -> FloatArray:
        """Return places in plan, shape (n, 2): integrals over panels, and from the start of one on."""
        if not np.any(self.ramps.curvature) or not c.size:
            return np.column_stack((c, np.zeros_like(c)))
        knots = self._panels(min(float(c.min()), self.begin), max(float(c.max()), self.begin))
        base = np.concatenate((np.zeros((1, 2)), np.cumsum(self._step(knots[:-1], np.diff(knots)), axis=0)))
        base += np.array([self.begin, 0.0]) - base[np.searchsorted(knots, self.begin)]
        panel = np.clip(np.searchsorted(knots, c, side="right") - 1, 0, knots.size - 2)
        return base[panel] + self._step(knots[panel], c - knots[panel])

    def _panels(self, first: float, last: float) -> FloatArray:
        ramps = self.ramps
        bends = (ramps.start, ramps.start + ramps.transition, ramps.end - ramps.transition, ramps.end)
        even = np.linspace(first, last, 2 + int((last - first) / _PANEL))
        knots = np.unique(np.concatenate((even, [self.begin], *bends)))
        return knots[(knots >= first) & (knots <= last)]

    def _step(self, start: FloatArray, length: FloatArray) -> FloatArray:
        """Return the integrals of (cos, sin) of the heading from chainages on, shape (n, 2)."""
        points, weights = clenshaw_curtis(_INTERVALS)
        heading = self._heading((start[:, None] + length[:, None] * points).ravel())
        direction = np.column_stack((np.cos(heading), np.sin(heading))).reshape(-1, points.size, 2)
        return length[:, None] * np.einsum("g,ngi->ni", weights, direction)


def read_track(inputs: dict[str, Any]) -> Track:
    """Return the track of the echo of a line file."""
    track = inputs["track"]
    curves, gradients = track["curves"], track["gradients"]

    def column(name: str) -> FloatArray:
        return np.array([curve[name] for curve in curves], dtype=np.float64)

    start, radius = column("start"), column("radius")
    slope = np.array([gradient["slope"] for gradient in gradients], dtype=np.float64)
    about = np.array([gradient["start"] for gradient in gradients], dtype=np.float64)
    rounding = np.array([gradient["rounding"] for gradient in gradients], dtype=np.float64)
    return Track(
        begin=float(inputs["start_chainage"]),
        ramps=Ramps(
            start,
            start + column("length"),
            column("transition"),
            1.0 / radius,
            np.sign(radius) * column("cant") / track["rail_spacing"],
        ),
        slope_from=about - 0.5 * rounding,
        slope_until=about + 0.5 * rounding,
        slope_change=np.diff(slope, prepend=0.0),
    )


def _power(x: FloatArray, n: int) -> FloatArray:
    """Return x^n/n! where x is positive, else 0; of n = 0, the step, 1 where x is 0."""
    if n == 0:
        return np.heaviside(x, 1.0)
    return np.maximum(x, 0.0) ** n / factorial(n)
