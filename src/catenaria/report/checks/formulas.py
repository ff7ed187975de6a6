"""Formulas of standards and textbooks about waves and gradients."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def wave_speed(tension: float, mass: float) -> float:
    """Return the speed of transverse waves on a string, sqrt(T/m') [m/s].

    Parameters
    ----------
    tension : float
        T [N]; of several wires together their sum.
    mass : float
        m' [kg/m].

    Examples
    --------
    >>> round(3.6 * wave_speed(15e3, 1.07), 1)  # km/h: 120 mm2 of copper at 15 kN
    426.2
    """
    return math.sqrt(tension / mass)


def reflection_factor(contact: tuple[float, float], messenger: tuple[float, float]) -> float:
    """Return the share of a wave's amplitude on the contact wire that a dropper reflects.

    Parameters
    ----------
    contact, messenger : tuple of float
        Tension [N] and mass per length [kg/m] of contact wires and messenger wires.

    Notes
    -----
    r = sqrt(T_m m_m) / (sqrt(T_m m_m) + sqrt(T_c m_c)): the two wires' impedances (Kiessling et al.).

    Examples
    --------
    >>> reflection_factor((15e3, 1.0), (15e3, 1.0))
    0.5
    """
    impedance_c, impedance_m = (math.sqrt(tension * mass) for tension, mass in (contact, messenger))
    return impedance_m / (impedance_m + impedance_c)


def doppler_factor(wave: float, speed: float) -> float:
    """Return (c - v)/(c + v) for a pantograph at the speed v on a wire with the wave speed c.

    Examples
    --------
    >>> doppler_factor(120.0, 60.0) == 1 / 3
    True
    """
    return (wave - speed) / (wave + speed)


def gradients(chainage: FloatArray, height: FloatArray) -> FloatArray:
    """Return the rise by length from each support to the next one, with its sign."""
    return np.diff(height) / np.diff(chainage)
