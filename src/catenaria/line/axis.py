"""The axis of the track: curvature, cant and slope by chainage, and what follows by integrating them.

In plan it is a chain of pieces whose curvature is linear in the chainage: straights, arcs and clothoids.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.line.track import Curve, Gradient
from catenaria.numerics.gauss import gauss_legendre

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class Knot(NamedTuple):
    """Where a piece of the plan begins: chainage, curvature and cant there, and their rates by chainage.

    Curvature [1/m] is positive to the left, cant [m] is the height of the right rail above the left one.
    """

    chainage: float
    curvature: float
    curvature_rate: float
    cant: float
    cant_rate: float


def curve_knots(curve: Curve) -> tuple[Knot, ...]:
    """Return where first transition, arc, second transition, and the straight behind them begin."""
    curvature, cant = 1.0 / curve.radius, float(np.sign(curve.radius)) * curve.cant
    transition, end = curve.transition, curve.start + curve.length
    enter = curve.start + transition
    leave = max(enter, end - transition)  # without an arc, rounding may turn their order round
    arc = Knot(enter, curvature, 0.0, cant, 0.0)
    straight = Knot(end, 0.0, 0.0, 0.0, 0.0)
    if transition == 0.0:
        return arc, straight
    rates = curvature / transition, cant / transition
    return (
        Knot(curve.start, 0.0, rates[0], 0.0, rates[1]),
        arc,
        Knot(leave, curvature, -rates[0], cant, -rates[1]),
        straight,
    )


def plan_knots(curves: Sequence[Curve], start: float) -> tuple[Knot, ...]:
    """Return the knots of curves in order of chainage, first that of the straight before them."""
    straight = Knot(curves[0].start if curves else start, 0.0, 0.0, 0.0, 0.0)
    return straight, *(knot for curve in curves for knot in curve_knots(curve))


def _turned(u: FloatArray, curvature: FloatArray, rate: FloatArray) -> FloatArray:
    """Return by how much the heading changes over the length u of a piece [rad]."""
    return u * (curvature + rate * u / 2.0)


def _drift(u: FloatArray, heading: FloatArray, curvature: FloatArray, rate: FloatArray) -> FloatArray:
    """Return how (x - chainage, y) changes over the length u of a piece, shape (n, 2) [m].

    The chord of an arc is u sin(a)/a long, a being half of the angle turned, and its heading is that of the
    arc's start plus a. Clothoids are integrated by Gauss-Legendre quadrature; the number of points grows with
    the angle.
    """
    half = curvature * u / 2.0
    chord = u * np.sinc(half / np.pi)
    drift = np.stack([chord * np.cos(heading + half) - u, chord * np.sin(heading + half)], axis=1)
    bent = np.flatnonzero(rate)
    if bent.size:
        u, heading, curvature, rate = (value[bent, np.newaxis] for value in (u, heading, curvature, rate))
        points, weights = gauss_legendre(16 + 4 * int(np.max(np.abs(_turned(u, curvature, rate)))))
        angle = heading + _turned(u * (1.0 + points) / 2.0, curvature, rate)
        drift[bent, 0] = (u[:, 0] / 2.0) * ((np.cos(angle) - 1.0) @ weights)
        drift[bent, 1] = (u[:, 0] / 2.0) * (np.sin(angle) @ weights)
    return drift


@dataclass(frozen=True)
class Plan:
    """The axis in plan, straight before the first and behind the last knot.

    Attributes
    ----------
    knot, curvature, curvature_rate, cant, cant_rate : FloatArray, shape (k,)
        As in `Knot`.
    heading : FloatArray, shape (k,)
        Angle of the tangent from the x axis at the knots [rad].
    drift : FloatArray, shape (k, 2)
        (x - chainage, y) at the knots [m]: exactly zero until the first curve.
    """

    knot: FloatArray
    curvature: FloatArray
    curvature_rate: FloatArray
    cant: FloatArray
    cant_rate: FloatArray
    heading: FloatArray
    drift: FloatArray

    @classmethod
    def of(cls, curves: Sequence[Curve], start: float) -> Plan:
        """Return the plan with x = start, y = 0 and the x axis as its tangent at the chainage `start`."""
        knot, curvature, curvature_rate, cant, cant_rate = np.array(plan_knots(curves, start)).T
        length, pieces = np.diff(knot), (curvature[:-1], curvature_rate[:-1])
        heading = np.append(0.0, np.cumsum(_turned(length, *pieces)))
        zero = np.zeros((knot.size, 2))
        plan = cls(knot, curvature, curvature_rate, cant, cant_rate, heading, zero)
        heading = heading - plan.at(np.array([start]))[0]
        drift = np.concatenate([zero[:1], np.cumsum(_drift(length, heading[:-1], *pieces), axis=0)])
        plan = cls(knot, curvature, curvature_rate, cant, cant_rate, heading, drift)
        return replace(plan, drift=drift - plan.at(np.array([start]))[1])

    def _piece(self, chainage: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the piece in which every chainage is, and how far behind the piece's knot [m]."""
        piece = np.maximum(np.searchsorted(self.knot, chainage, side="right") - 1, 0)
        return piece, chainage - self.knot[piece]

    def at(self, chainage: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return heading (n,) [rad] and (x - chainage, y) (n, 2) [m]."""
        i, u = self._piece(chainage)
        pieces = self.curvature[i], self.curvature_rate[i]
        return (
            self.heading[i] + _turned(u, *pieces),
            self.drift[i] + _drift(u, self.heading[i], *pieces),
        )

    def bend(self, chainage: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return curvature [1/m] and cant [m], both positive in a canted curve to the left, of shape (n,)."""
        i, u = self._piece(chainage)
        return self.curvature[i] + u * self.curvature_rate[i], self.cant[i] + u * self.cant_rate[i]


@dataclass(frozen=True)
class Elevation:
    """Height of the track axis over the chainage: slopes, and parabolas where they change; level before all.

    Attributes
    ----------
    start, change, rounding : FloatArray, shape (k,)
        Chainages about which the slope changes [m], by how much, and over what length [m].
    datum : float
        Height that is taken off [m].
    """

    start: FloatArray
    change: FloatArray
    rounding: FloatArray
    datum: float

    @classmethod
    def of(cls, gradients: Sequence[Gradient], start: float) -> Elevation:
        """Return the elevation that is 0 at the chainage `start`."""
        slope = np.array([0.0, *(gradient.slope for gradient in gradients)])
        about = np.array([gradient.start for gradient in gradients], dtype=np.float64)
        rounding = np.array([gradient.rounding for gradient in gradients], dtype=np.float64)
        elevation = cls(about, np.diff(slope), rounding, 0.0)
        return replace(elevation, datum=float(elevation.at(np.array([start]))[0]))

    def at(self, chainage: FloatArray) -> FloatArray:
        """Return the height of the axis, shape (n,) [m].

        Notes
        -----
        A change of slope m over the length l about c0 adds m (c - c0) beyond it, and within it, from its
        beginning at c0 - l/2, the parabola m u^2/(2 l).
        """
        ahead = chainage[:, None] - self.start
        u = np.clip(ahead + 0.5 * self.rounding, 0.0, self.rounding)
        curve = np.divide(0.5 * u * u, self.rounding, out=np.zeros_like(u), where=self.rounding > 0.0)
        beyond = np.maximum(ahead - 0.5 * self.rounding, 0.0)
        return (curve + beyond) @ self.change - self.datum
