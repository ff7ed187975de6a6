"""The numbers of one step of the paper's method, in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import Grading
from catenaria.mechanics.chain import Section
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.loads.gravity import Ramp

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class TensionSetup:
    """Tension control of a wire, eqs. (19)-(20): `force` [N], how and where it is measured, the law."""

    force: float
    measure: str
    at_end: bool
    law: VelocityLaw


@dataclass(frozen=True)
class DropperSetup:
    """The dropper cables of one step and what controls them.

    Attributes
    ----------
    x : FloatArray, shape (n,)
        Positions along the track [m].
    up : bool
        True for the lower cables, which stand up from the contact wire and are raised; False for the upper
        ones, which hang from the messenger and are pulled down.
    length, elements, section
        Guessed length [m], number of elements and cross-section of each cable.
    clamp_mass : float
        Mass at the wire's end [kg].
    guided : bool
        Guided joint with the wire; False for the frictionless joint (15).
    target : FloatArray, shape (n,)
        Wanted heights [m] for the lower cables, forces T_cd [N] for the upper ones.
    law : VelocityLaw
        Law (21), or the similar one for (23).
    foot_x, foot_height : FloatArray, shape (n,)
        Where P_cd are along the track, and their heights [m]; used by the upper cables for the weight G of
        (23).
    clamps_mass : float
        Mass of both clamps [kg]; used by the upper cables for G.
    """

    x: FloatArray
    up: bool
    length: float
    elements: int
    section: Section
    clamp_mass: float
    guided: bool
    target: FloatArray
    law: VelocityLaw
    foot_x: FloatArray
    foot_height: FloatArray
    clamps_mass: float


@dataclass(frozen=True)
class WireSetup:
    """Everything that one step needs, in SI units.

    Attributes
    ----------
    name : str
        Name of the wire.
    section : Section
        Cross-section of the wire.
    support_x : FloatArray, shape (m,)
        Where the wire is held, ascending [m].
    height : float
        Height of its supports [m].
    tail : float
        How far the wire runs on beyond its first and last support [m].
    tension, droppers
        The controls.
    grading, gauss_points
        The mesh.
    g, gravity_ramp : float, Ramp
        Gravity [m/s^2] and its ramp (31).
    control_ramp : Ramp
        Brings the control velocities in.
    damping : tuple of float
        Rayleigh's alpha [1/s] and beta [s].
    """

    name: str
    section: Section
    support_x: FloatArray
    height: float
    tail: float
    tension: TensionSetup
    droppers: DropperSetup
    grading: Grading
    gauss_points: int
    g: float
    gravity_ramp: Ramp
    control_ramp: Ramp
    damping: tuple[float, float]
