"""Droppers as vertical bars between the clamps of the two wires."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.line import Line

FloatArray = NDArray[np.float64]
Array = NDArray[Any]  # real, or complex where derivatives are taken by complex step


@dataclass(frozen=True)
class Bars:
    """What all droppers are made of.

    Attributes
    ----------
    EA, weight : float
        Axial stiffness [N] and weight per unstressed length [N/m].
    clamp_top, clamp_bottom : float
        Weight of a clamp at the messenger and at the contact wire [N].
    """

    EA: float
    weight: float
    clamp_top: float
    clamp_bottom: float

    def tension(self, length: Array, unstressed: Array) -> Array:
        """Return the force EA eps |r'| of bars with Green strain (9), its mean along them [N]."""
        stretch = length / unstressed
        return 0.5 * self.EA * (stretch * stretch - 1.0) * stretch

    def tension_by(self, length: FloatArray, unstressed: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of the tension by length and by unstressed length [N/m]."""
        stretch = length / unstressed
        by_length = 0.5 * self.EA * (3.0 * stretch * stretch - 1.0) / unstressed
        return by_length, -stretch * by_length

    def loads(self, length: Array, unstressed: Array) -> tuple[Array, Array]:
        """Return the forces on contact wire and messenger [N], positive downwards, with weights of clamps."""
        N, half = self.tension(length, unstressed), 0.5 * self.weight * unstressed
        return half + self.clamp_bottom - N, half + self.clamp_top + N

    def unstressed(self, length: FloatArray, tension: FloatArray) -> FloatArray:
        """Return the lengths to which bars of these lengths must be cut to carry these mean tensions [m]."""
        stretch = np.ones_like(length)
        load = 2.0 * tension / self.EA
        for _ in range(8):  # Newton's method for x^3 - x = 2 N/EA doubles its digits
            stretch = stretch - (stretch**3 - stretch - load) / (3.0 * stretch**2 - 1.0)
        return length / stretch


def bars(line: Line) -> Bars:
    """Return the droppers of a line."""
    kind, g = line.dropper, line.gravity
    conductor = line.conductor(kind.conductor)
    return Bars(conductor.EA, conductor.rhoA * g, kind.clamp_mass_top * g, kind.clamp_mass_bottom * g)
