"""What a result tells of its wires."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Profile:
    """A wire's equilibrium configuration, sampled along it (several points in each element).

    Attributes
    ----------
    s : FloatArray
        Material (unstressed) arc length from the wire's start [m].
    x, y, z : FloatArray
        Position in the axes of the line [m].
    tension : FloatArray
        True axial force EA eps |r'|, interpolated between its means over elements [N].
    strain_tension : FloatArray
        N = EA eps of eq. (11) at the point, which overshoots where a wire bends sharply [N].
    horizontal : FloatArray
        Component of the true axial force along the track [N].
    moment : FloatArray
        Bending moment EJ kappa, without sign [N m].
    chainage, lateral, height : FloatArray
        The same position in the track frame: along the track, to the left of its middle, and normal to it
        [m]; equal to x, y and z where there is no track, and where it is straight and level.
    """

    s: FloatArray
    x: FloatArray
    y: FloatArray
    z: FloatArray
    tension: FloatArray
    strain_tension: FloatArray
    horizontal: FloatArray
    moment: FloatArray
    chainage: FloatArray
    lateral: FloatArray
    height: FloatArray


@dataclass(frozen=True)
class WireForm:
    """What was found for one wire.

    Attributes
    ----------
    name, role : str
        As in the line file, for example ``second contact wire``, and what the wire is for: ``contact wire``,
        ``auxiliary messenger``, ``messenger wire``, ``stitch wire`` or ``mid-point anchor``.
    unstressed_length, stretched_length : float
        Between its first and last support, without and with force; of wires whose ends are clamped to other
        wires between these ends [m].
    target_tension, tension, tension_error : float
        The prescribed tension, the measured one and their difference [N].
    measure : str
        How the tension was measured: ``reaction`` or ``strain``.
    horizontal_start, horizontal_end : float
        Component along the track of the reaction at the two wire ends [N].
    reaction_start, reaction_end : float
        Size of the reaction at the two wire ends [N].
    end_force : FloatArray, shape (2, 3)
        Forces of the wire's start and end on the tensioning devices [N].
    tension_min, tension_max, tension_mean : float
        Of the element means of the true axial force between the first and the last support [N].
    travel : float
        How far each pulled end was moved outwards; of a wire whose ends are clamped to other wires, by how
        much it was made longer than guessed [m].
    sag : float
        Of a wire that droppers hold: largest depth below the line through two neighbouring droppers or
        supports that hold it; else below the chord of a span [m].
    profile : Profile
        Equilibrium configuration with internal forces.
    start_x, start_z : FloatArray
        The starting configuration as a polyline: chainage and height in the track frame [m].
    """

    name: str
    role: str
    unstressed_length: float
    stretched_length: float
    target_tension: float
    tension: float
    tension_error: float
    measure: str
    horizontal_start: float
    horizontal_end: float
    reaction_start: float
    reaction_end: float
    end_force: FloatArray
    tension_min: float
    tension_max: float
    tension_mean: float
    travel: float
    sag: float
    profile: Profile
    start_x: FloatArray
    start_z: FloatArray
