"""Wind on the wires and droppers of a line at rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import across
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.discretise.spatial.natural import Natural
from catenaria.line.alignment import Alignment, Frames
from catenaria.line.load_case import Wind

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class WindOn:
    """Wind forces.

    Attributes
    ----------
    per_metre : tuple of FloatArray, shape (n_elements, 3)
        On every element of each wire, per metre of its unstressed length [N/m].
    frames : tuple of Frames
        Track frames at the middle of the elements.
    droppers : FloatArray, shape (n_droppers, 3)
        On every dropper [N].
    """

    per_metre: tuple[FloatArray, ...]
    frames: tuple[Frames, ...]
    droppers: FloatArray


def wind_on(
    model: SpatialModel, alignment: Alignment, wind: Wind, diameter: FloatArray, dropper_diameter: float
) -> WindOn:
    """Return the forces of wind on a line where its unknowns start.

    Parameters
    ----------
    model : SpatialModel
        The line.
    alignment : Alignment
        Course of the track.
    wind : Wind
        The wind.
    diameter : FloatArray, shape (n_wires,)
        Outer diameters of the wires [m].
    dropper_diameter : float
        That of all droppers [m].
    """
    z, pressure = model.unknowns.start, dynamic_pressure(wind)
    natural = Natural(model, z)
    per_metre: list[FloatArray] = []
    places: list[Frames] = []
    for k, chain in enumerate(natural.wires):
        s = chain.knots[:-1] + 0.5 * chain.L
        point = chain.evaluate(natural.z, s)
        frames = alignment.frames(alignment.locate(point.r, np.interp(s, *natural.stations(k))))
        force = pressure * diameter[k] * drag(_air(wind, frames), point.r1)
        per_metre.append(float("wires" in wind.on) * force)
        places.append(frames)
    laid = model.layout.droppers
    below = model.lower_carrier.evaluate(z, z[model.lower_s]).r
    above = model.upper_carrier.evaluate(z, z[model.upper_s]).r
    there = (laid.rhoA > 0.0)[:, None] * float("droppers" in wind.on)  # broken ones weigh nothing
    force = there * pressure * dropper_diameter * drag(_air(wind, laid.frame), above - below)
    return WindOn(tuple(per_metre), tuple(places), force)


def dynamic_pressure(wind: Wind) -> float:
    """Return rho v^2 C_d G / 2 [N/m2]."""
    return 0.5 * wind.air_density * wind.speed**2 * wind.drag * wind.gust_factor


def drag(air: FloatArray, piece: FloatArray) -> FloatArray:
    r"""Return the force of air of unit speed and pressure on pieces of unit diameter, shape (n, 3).

    Parameters
    ----------
    air : FloatArray, shape (n, 3)
        Unit vectors in which the air moves.
    piece : FloatArray, shape (n, 3)
        Straight pieces, from end to end.

    Notes
    -----
    .. math:: l\,|v_n|\,v_n,\quad v_n = v - (v\cdot t)\,t,

    the cross-flow principle: only the component of the wind normal to a cylinder acts on it (Hoerner 1965,
    Fluid-Dynamic Drag, section III).

    Examples
    --------
    >>> drag(np.array([[0.0, 1.0, 0.0]]), np.array([[2.0, 0.0, 0.0]])).tolist()
    [[0.0, 2.0, 0.0]]
    """
    length = np.linalg.norm(piece, axis=1)[:, None]
    t = piece / length
    normal = air - np.einsum("ni,ni->n", air, t)[:, None] * t
    return length * np.linalg.norm(normal, axis=1)[:, None] * normal


def _air(wind: Wind, frames: Frames) -> FloatArray:
    """Return the unit vectors in which the air moves at given places, shape (n, 3)."""
    angle = np.radians(wind.direction)
    if wind.follows == "space":  # the x axis is the track's at the first support
        return np.tile([-np.cos(angle), np.sin(angle), 0.0], (frames.chainage.size, 1))
    return -np.cos(angle) * frames.along + np.sin(angle) * across(frames)
