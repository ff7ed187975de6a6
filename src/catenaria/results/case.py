"""What a study of load cases found: a line at rest before and under loads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.results.arms import Arms
from catenaria.results.supports import Supports

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class LoadedDroppers:
    """Droppers under a load, one entry for each.

    Attributes
    ----------
    span, number : IntArray
        Span and number in it, from 1.
    lower_wire, upper_wire : tuple of str
        Names.
    chainage, height, lateral : FloatArray
        Of the lower clamp in the track frame [m].
    force : FloatArray
        With which the dropper, without its own weight, pulls [N]; 0 where it is slack.
    slack, broken : Mask
        Whether it hangs without force; whether it is missing in the load case.
    """

    span: IntArray
    number: IntArray
    lower_wire: tuple[str, ...]
    upper_wire: tuple[str, ...]
    chainage: FloatArray
    height: FloatArray
    lateral: FloatArray
    force: FloatArray
    slack: Mask
    broken: Mask


@dataclass(frozen=True)
class LoadedWire:
    """A wire under a load.

    Attributes
    ----------
    name, role : str
        As in `WireForm`.
    end_force : FloatArray, shape (2, 3)
        Forces of its start and end on devices, terminations or other wires [N].
    tension_min, tension_max : float
        Of the element means of the axial force between its first and its last support [N].
    travel : float
        How far devices have pulled its ends outwards since the wire was hung up [m].
    s : FloatArray
        Unstressed length from the wire's start to sampled points at the temperature of the case [m].
    chainage, lateral, height, tension : FloatArray
        The points in the track frame [m], and the axial force there [N].
    """

    name: str
    role: str
    end_force: FloatArray
    tension_min: float
    tension_max: float
    travel: float
    s: FloatArray
    chainage: FloatArray
    lateral: FloatArray
    height: FloatArray
    tension: FloatArray

    @property
    def force_start(self) -> float:
        """Size of the force of its start on what holds it [N]."""
        return float(np.linalg.norm(self.end_force[0]))

    @property
    def force_end(self) -> float:
        """Size of the force of its end on what holds it [N]."""
        return float(np.linalg.norm(self.end_force[1]))


@dataclass(frozen=True)
class LineState:
    """A line at rest.

    Attributes
    ----------
    droppers, wires, supports, arms
        What it looks like and what it bears; see the classes.
    """

    droppers: LoadedDroppers
    wires: tuple[LoadedWire, ...]
    supports: Supports
    arms: Arms

    def wire(self, name: str) -> LoadedWire:
        """Return one wire.

        Raises
        ------
        InconsistentInputError
            If there is none of that name.
        """
        for wire in self.wires:
            if wire.name == name:
                return wire
        names = ", ".join(wire.name for wire in self.wires)
        raise InconsistentInputError(f"there is no wire {name!r}; there is {names}")


@dataclass(frozen=True)
class SpanExtremes:
    """Where contact wires are lowest and furthest from the middle of the track, one entry a span and wire.

    Attributes
    ----------
    wire : tuple of str
        Name of the contact wire.
    span : IntArray
        From 1.
    lowest_chainage, lowest_height : FloatArray
        Its lowest point, between droppers as well as at them [m].
    lateral_chainage, lateral : FloatArray
        Its point that deviates most, and by how much to the left [m].
    """

    wire: tuple[str, ...]
    span: IntArray
    lowest_chainage: FloatArray
    lowest_height: FloatArray
    lateral_chainage: FloatArray
    lateral: FloatArray


@dataclass(frozen=True)
class BlowOff:
    """Lateral position under wind by the textbook beside the solved one, one entry a span and contact wire.

    Attributes
    ----------
    wire : tuple of str
        Name of the contact wire.
    span : IntArray
        From 1.
    start, length : FloatArray
        Chainage of the span's first support that holds the wire, and distance to the next one [m].
    stagger_start, stagger_end : FloatArray
        Lateral position of the wire at them before the load [m].
    load, tension : FloatArray
        Mean wind on the contact wire to the left [N/m], and its horizontal tension [N].
    combined_load, combined_tension : FloatArray
        The same of all contact, messenger and auxiliary wires and of the span's droppers together.
    curvature : FloatArray
        Mean curvature of the track, positive to the left [1/m].
    alone, combined : FloatArray
        Lateral position at the point that deviates most: of the contact wire as if it hung alone, and of all
        wires as if they were one [m].
    solved : FloatArray
        Lateral position, as solved, of the point that deviates most to the same side as `alone` [m].
    """

    wire: tuple[str, ...]
    span: IntArray
    start: FloatArray
    length: FloatArray
    stagger_start: FloatArray
    stagger_end: FloatArray
    load: FloatArray
    tension: FloatArray
    combined_load: FloatArray
    combined_tension: FloatArray
    curvature: FloatArray
    alone: FloatArray
    combined: FloatArray
    solved: FloatArray


@dataclass(frozen=True)
class Pushed:
    """Points of wires that are pushed, one entry for each.

    Attributes
    ----------
    wire : tuple of str
        Names.
    chainage, force : FloatArray
        Where [m] and how much [N].
    uplift : FloatArray
        By how much the point is higher than in the same case without any push [m].
    """

    wire: tuple[str, ...]
    chainage: FloatArray
    force: FloatArray
    uplift: FloatArray


@dataclass(frozen=True)
class CaseResult:
    """A line under one load case.

    Attributes
    ----------
    name : str
        Name of the case.
    stated : dict
        Echo of the case, all values in SI, temperatures in degrees Celsius.
    warming : float
        By how much it is warmer than at the reference temperature [K].
    load : FloatArray, shape (n_wires, 3)
        Sum of wind and ice on each wire in the axes of the line [N].
    dropper_load : FloatArray, shape (3,)
        The same on all droppers [N].
    state : LineState
        The line at rest.
    extremes : SpanExtremes
        Where its contact wires are lowest and deviate most.
    blow_off : BlowOff
        Of cases with wind; else without entries.
    pushed : Pushed
        What pushes do.
    iterations : int
        Newton iterations of the last step to its rest.
    """

    name: str
    stated: dict[str, Any]
    warming: float
    load: FloatArray
    dropper_load: FloatArray
    state: LineState
    extremes: SpanExtremes
    blow_off: BlowOff
    pushed: Pushed
    iterations: int

    def __repr__(self) -> str:
        return f"CaseResult: {self.name}, at rest after {self.iterations} iterations"


@dataclass(frozen=True)
class LoadStudy:
    """All cases of a study.

    Attributes
    ----------
    line, method : str
        Name of the line, and of the method that found its form.
    reference_temperature : float
        Temperature of the line as found [degC].
    expansion : FloatArray, shape (n_wires,)
        Coefficients of thermal expansion [1/K].
    before : LineState
        The line as it was built.
    cases : tuple of CaseResult
        In the order of the file.
    inputs : dict
        Echo of the line file, all values in SI.
    """

    line: str
    method: str
    reference_temperature: float
    expansion: FloatArray
    before: LineState
    cases: tuple[CaseResult, ...]
    inputs: dict[str, Any]

    def __repr__(self) -> str:
        names = ", ".join(case.name for case in self.cases)
        return f"LoadStudy: {self.line or 'a line without name'}, method {self.method}; cases: {names}"
