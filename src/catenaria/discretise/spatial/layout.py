"""What is modelled of a line in space: wires, and all places at which something acts on them, as arrays.

Everything is in SI units and in the axes of the line: x along the track where it begins, y to the left, z up.
`lay_out` makes it from the line file; nothing here knows of files, and nothing of what a solver does.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import Grading
from catenaria.discretise.wire_setup import TensionSetup
from catenaria.line.alignment import Frames
from catenaria.mechanics.chain import Section
from catenaria.mechanics.controls.velocity_law import VelocityLaw

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

Role = Literal["contact wire", "auxiliary messenger", "messenger wire", "stitch wire", "mid-point anchor"]
HoldKind = Literal["sliding", "clamped", "spring", "cantilever", "bracket", "arm"]

GUIDED: Final = ("bracket", "arm")  # what takes the wire along with it and takes no force along the track


def across(frame: Frames) -> FloatArray:
    """Return the horizontal unit vectors to the left of the track, ez x t, shape (n, 3)."""
    t = frame.along
    return np.column_stack((-t[:, 1], t[:, 0], np.zeros(t.shape[0])))


@dataclass(frozen=True)
class LaidWire:
    """One wire.

    Attributes
    ----------
    name, role : str
        As in results, and what the wire is for.
    section : Section
        Cross-section, of a worn wire what is left of it.
    tension : TensionSetup
        The one prescribed tension, where it is measured and the law of its control.
    pulled : tuple of bool
        Whether a tensioning device moves the wire's start and end. Neither for a wire whose ends are tied to
        other wires: of that, the unstressed length is found.
    ends : FloatArray, shape (2, 3)
        Where the wire's start and end are anchored [m]; not used for a tied wire.
    outwards : FloatArray, shape (2, 3)
        Unit vectors in which devices pull.
    """

    name: str
    role: Role
    section: Section
    tension: TensionSetup
    pulled: tuple[bool, bool]
    ends: FloatArray
    outwards: FloatArray

    @property
    def tied(self) -> bool:
        """Whether the ends are clamped to other wires."""
        return self.role in ("stitch wire", "mid-point anchor")


@dataclass(frozen=True)
class Holds:
    """Places where supports hold wires, ordered by wire, then along the line.

    Attributes
    ----------
    wire, support : IntArray, shape (n,)
        Indices.
    frame : Frames
        Track frames at the supports.
    X : FloatArray, shape (n, 3)
        Where the wire is held, of a spring or cantilever when it is free of load [m].
    kind : tuple of str
        One of `HoldKind`.
    friction : FloatArray, shape (n,)
        By how much the wire's tension changes in the direction of growing chainage, per force on the support.
    compliance : FloatArray, shape (n, 2)
        Of springs, horizontally across the track and vertically [m/N].
    lift : FloatArray, shape (n,)
        Prescribed vertical force of the support on the wire [N]; NaN where the height is prescribed instead.
    hinge : FloatArray, shape (n, 3)
        Hinges of steady arms [m]; NaN where the hinge is found, and where there is no arm.
    arm_length, arm_mass : FloatArray, shape (n,)
        Of steady arms [m], [kg]; 0 where there is none.
    side : FloatArray, shape (n,)
        On which side of the wire an arm's hinge lies: 1 to the left, -1 to the right, 0 without an arm.
    """

    wire: IntArray
    support: IntArray
    frame: Frames
    X: FloatArray
    kind: tuple[HoldKind, ...]
    friction: FloatArray
    compliance: FloatArray
    lift: FloatArray
    hinge: FloatArray
    arm_length: FloatArray
    arm_mass: FloatArray
    side: FloatArray

    @property
    def guided(self) -> NDArray[np.bool_]:
        """Mask of the places where the wire is taken along and there is no force along the track."""
        return np.array([kind in GUIDED for kind in self.kind], dtype=np.bool_)

    def without_lift(self) -> Holds:
        """Return the same places with prescribed vertical forces of zero."""
        return replace(self, lift=np.where(np.isnan(self.lift), np.nan, 0.0))

    @property
    def hinged(self) -> NDArray[np.bool_]:
        """Mask of the steady arms whose hinge is given, so that the wire's place is found."""
        return np.isfinite(self.hinge[:, 0])


@dataclass(frozen=True)
class LaidDroppers:
    """Droppers, ordered along the line.

    Attributes
    ----------
    lower, upper : IntArray, shape (n,)
        Indices of the wires.
    span, number : IntArray, shape (n,)
        Span (from 1) and number within the span (from 1).
    frame : Frames
        Track frames; both clamps are in the vertical plane across the track.
    height : FloatArray, shape (n,)
        Wanted height of the lower wire, normal to the canted track [m].
    flexibility, rhoA : FloatArray, shape (n,)
        1/EA [1/N], 0 for rigid ones, and mass per length [kg/m].
    mass_bottom, mass_top : FloatArray, shape (n,)
        Masses of the clamps [kg].
    may_be_slack : bool
        Whether one that would have to push may hang slack instead.
    """

    lower: IntArray
    upper: IntArray
    span: IntArray
    number: IntArray
    frame: Frames
    height: FloatArray
    flexibility: FloatArray
    rhoA: FloatArray
    mass_bottom: FloatArray
    mass_top: FloatArray
    may_be_slack: bool = False


@dataclass(frozen=True)
class LaidTies:
    """Ends of wires that are clamped to other wires: `end` 0 or 1 of `wire` to `host`, at `frame`."""

    wire: IntArray
    end: IntArray
    host: IntArray
    frame: Frames


@dataclass(frozen=True)
class LaidMasses:
    """Point masses on wires [kg]: insulators, clamps, section insulators."""

    name: tuple[str, ...]
    wire: IntArray
    frame: Frames
    mass: FloatArray


@dataclass(frozen=True)
class LaidCantilever:
    """A flexible cantilever from its fixed root to the place `hold` where its free tip carries a wire."""

    hold: int
    root: FloatArray
    section: Section
    elements: int


@dataclass(frozen=True)
class Layout:
    """Everything that is modelled of a line.

    Attributes
    ----------
    wires, holds, droppers, ties, masses, cantilevers
        What there is. Wires come in the order contact wires, auxiliary messenger, messenger wires, stitch
        wires, mid-point anchors.
    height_law : VelocityLaw
        Of the control (21) that finds the lengths of droppers.
    grading, gauss_points
        The mesh.
    g, ramp_time : float
        Gravity [m/s^2], and the time in which it grows in the dynamic method [s].
    damping : tuple of float
        Rayleigh's alpha [1/s] and beta [s].
    """

    wires: tuple[LaidWire, ...]
    holds: Holds
    droppers: LaidDroppers
    ties: LaidTies
    masses: LaidMasses
    cantilevers: tuple[LaidCantilever, ...]
    height_law: VelocityLaw
    grading: Grading
    gauss_points: int
    g: float
    ramp_time: float
    damping: tuple[float, float]
