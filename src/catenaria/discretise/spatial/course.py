"""Where one wire will lie: a string in space, its kinks rounded by bending, with its material points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.spatial.strings import UP, Strings
from catenaria.numerics.gauss import gauss_legendre

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_PASSES = 3  # of a fixed point that gains two digits or more in each
_THIN = 1e-12  # layer of a wire that does not resist bending [m]
_POINTS, _WEIGHTS = gauss_legendre(4)


@dataclass(frozen=True)
class TautCurve:
    r"""A taut wire in space: `TautWire` along a polygon in plan.

    Attributes
    ----------
    at, jump : FloatArray, shape (n, 3)
        Where the string has its kinks [m], and by how much dr/dsigma jumps there.
    layer : FloatArray, shape (n,)
        Lengths l within which kinks are rounded [m].
    b, H, curvature : FloatArray, shape (n - 1,)
        Of the bays: length in plan [m], horizontal tension [N], curvature w/H [1/m].
    slope : FloatArray, shape (n - 1, 3)
        dr/dsigma of the string where bays begin.
    EA : float
        Axial stiffness [N].

    Notes
    -----
    With the length :math:`\sigma` in plan, the string is a parabola in every bay, and

    .. math:: r = r_\text{string} + \sum_k \tfrac12 J_k l_k\, e^{-|\sigma - \sigma_k|/l_k}.

    Under the tension T = H |dr/dsigma| the wire is stretched x(T) times (Green strain), so that

    .. math:: s = \int \frac{|r_{,\sigma}|}{x(T)}\, d\sigma
              \approx \frac{1}{x(H)} \int 1 + \left(1 - \frac{H}{EA}\right)(|r_{,\sigma}| - 1)\, d\sigma .

    Neglected: what one kink does in the layer of the next one, and what lateral layers do to sigma.
    """

    at: FloatArray
    jump: FloatArray
    layer: FloatArray
    b: FloatArray
    H: FloatArray
    curvature: FloatArray
    slope: FloatArray
    EA: float

    @classmethod
    def of(cls, strings: Strings, wire: int) -> TautCurve:
        """Return the curve of one of the strings."""
        stations, bays = strings.net.stations(wire), strings.net.bays(wire)
        return cls(
            at=strings.at[stations],
            jump=strings.jump[stations],
            layer=strings.layer[stations],
            b=strings.b[bays],
            H=strings.H[bays],
            curvature=strings.w[bays] / strings.H[bays],
            slope=strings.slopes[0][bays],
            EA=strings.layout.wires[wire].section.EA,
        )

    @cached_property
    def factor(self) -> FloatArray:
        """Stretch of every bay under H, shape (n - 1,)."""
        return stretch(self.H, self.EA)

    @cached_property
    def stations(self) -> FloatArray:
        """Material coordinates of the kinks [m], shape (n,)."""
        every = np.arange(self.b.size)
        pieces = (self.b + self._longer(every, self.b)) / self.factor
        return np.concatenate(([0.0], np.cumsum(pieces)))

    def place(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return r and dr/ds at material coordinates, shape (n, 3) each."""
        bay = np.clip(np.searchsorted(self.stations, s, side="right") - 1, 0, self.b.size - 1)
        taut = (s - self.stations[bay]) * self.factor[bay]
        d = taut * (self.b / (np.diff(self.stations) * self.factor))[bay]
        for _ in range(_PASSES):
            d = taut - self._longer(bay, d)
        start, end = self._decays(bay, d)
        layers = 0.5 * self.jump * self.layer[:, None]
        r = self.at[bay] + d[:, None] * self.slope[bay] + (0.5 * self.curvature[bay] * d**2)[:, None] * UP
        r += start[:, None] * layers[bay] + end[:, None] * layers[bay + 1]
        along = self.slope[bay] + (self.curvature[bay] * d)[:, None] * UP
        along += 0.5 * (end[:, None] * self.jump[bay + 1] - start[:, None] * self.jump[bay])
        size = np.sqrt(_dot(along, along))
        return r, along * (stretch(self.H[bay] * size, self.EA) / size)[:, None]

    def _longer(self, bay: IntArray, d: FloatArray) -> FloatArray:
        """Return by how much the taut wire is longer than d, from the start of a bay on [m]."""
        x = 0.5 * d[:, None] * (1.0 + _POINTS)
        slope = self.slope[bay, 2, None] + self.curvature[bay, None] * x
        string = 0.5 * d * ((np.hypot(1.0, slope) - 1.0) @ _WEIGHTS)
        return (1.0 - self.H[bay] / self.EA) * (string + self._layers(bay, d))

    def _layers(self, bay: IntArray, d: FloatArray) -> FloatArray:
        """Return the share of the roundings in that, as `TautWire` has it [m]."""
        start, end = self._decays(bay, d)
        left, right = self.jump[bay], self.jump[bay + 1]
        leaving = self.slope[bay]
        arriving = leaving + (self.curvature[bay] * self.b[bay])[:, None] * UP
        from_left = 0.0625 * _dot(left, left) * (1.0 - start**2) - 0.5 * _dot(left, leaving) * (1.0 - start)
        from_right = 0.0625 * _dot(right, right) * end**2 + 0.5 * _dot(right, arriving) * end
        return self.layer[bay] * from_left + self.layer[bay + 1] * from_right

    def _decays(self, bay: IntArray, d: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return exp(-distance/l) of the kinks at both ends of a bay."""
        start, end = np.maximum(self.layer[bay], _THIN), np.maximum(self.layer[bay + 1], _THIN)
        return np.exp(-np.abs(d) / start), np.exp(-np.abs(self.b[bay] - d) / end)


@dataclass(frozen=True)
class Course:
    """Where one wire will lie.

    Attributes
    ----------
    length : float
        Unstressed length of the wire that is to be meshed, end to end [m].
    pull : float
        How far each pulled end is outwards of its anchor; of a tied wire, how much longer than `length` it is
        without stress [m].
    curve : TautCurve
        Where it is stretched to.
    """

    length: float
    pull: float
    curve: TautCurve

    @classmethod
    def of(cls, strings: Strings, wire: int) -> Course:
        """Return the course of one of the strings, as long as it is there."""
        curve = TautCurve.of(strings, wire)
        return cls(float(curve.stations[-1]), 0.0, curve)

    @property
    def scale(self) -> float:
        """How much longer than meshed the wire is made to lie there."""
        return float(self.curve.stations[-1] / self.length)

    @property
    def stations(self) -> FloatArray:
        """Material coordinates of the stations in the mesh [m], shape (n,)."""
        return self.curve.stations / self.scale

    def place(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return where material points will lie [m], and dr/ds there.

        Parameters
        ----------
        s : FloatArray, shape (n,)
            Material coordinates from 0 to `length` [m].

        Returns
        -------
        r, r1 : FloatArray, shape (n, 3)
            Places [m] and their derivatives by s, of size 1 plus strain.
        """
        r, r1 = self.curve.place(s * self.scale)
        return r, r1 * self.scale


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.einsum("ni,ni->n", a, b)
