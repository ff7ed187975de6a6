"""Corrected dropper lengths of a built line whose heights were measured."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class MeasuredPoints:
    """What was measured, one entry for each height.

    Attributes
    ----------
    wire : tuple of str
        Names of the wires.
    span, number : IntArray
        The droppers (from 1); 0 where a chainage was given.
    chainage : FloatArray
        Where it was measured [m].
    height : FloatArray
        Above the canted track [m].
    explained : FloatArray
        The same with the dropper lengths that explain the measurement [m].
    """

    wire: tuple[str, ...]
    span: IntArray
    number: IntArray
    chainage: FloatArray
    height: FloatArray
    explained: FloatArray


@dataclass(frozen=True)
class AdjustedDroppers:
    """All droppers in the order of the line.

    Attributes
    ----------
    lower_wire, upper_wire : tuple of str
        Names of the wires.
    span, number : IntArray
        Span and number within it (from 1).
    chainage : FloatArray
        Where they hang [m].
    checked : Mask
        Those that hold a contact wire: its heights shall be within the tolerance.
    scheduled_length : FloatArray
        Unstressed length of the schedule [m].
    present_length : FloatArray
        The same as the measurement says [m].
    clamps : FloatArray
        By how much shorter they are cut [m].
    change : FloatArray
        By how much they are to be made longer [m].
    wanted_height : FloatArray
        Height of the lower wire by the schedule [m].
    height_before, height_predicted, height_after : FloatArray
        The same as built, and adjusted: as predicted linearly, and as it comes to rest [m].
    force_before, force_after : FloatArray
        Forces in droppers, 0 in slack ones [N].
    """

    lower_wire: tuple[str, ...]
    upper_wire: tuple[str, ...]
    span: IntArray
    number: IntArray
    chainage: FloatArray
    checked: Mask
    scheduled_length: FloatArray
    present_length: FloatArray
    clamps: FloatArray
    change: FloatArray
    wanted_height: FloatArray
    height_before: FloatArray
    height_predicted: FloatArray
    height_after: FloatArray
    force_before: FloatArray
    force_after: FloatArray

    @property
    def new_length(self) -> FloatArray:
        """Unstressed length after adjustment [m]."""
        return self.present_length + self.change

    @property
    def new_cut_length(self) -> FloatArray:
        """Length to cut a new dropper to [m]."""
        return self.new_length - self.clamps

    @property
    def adjusted(self) -> Mask:
        """Mask of the droppers that are to be adjusted."""
        return self.change != 0.0

    @property
    def slack_before(self) -> Mask:
        """Mask of those that hang slack as built; they may be longer than `present_length` says."""
        return self.force_before <= 0.0


@dataclass(frozen=True)
class Adjustment:
    """Which droppers to adjust, and what comes of it.

    Attributes
    ----------
    line, method : str
        Name of the line and of the method that found its form.
    tolerance, step, largest_change : float
        Wanted accuracy of heights, and what changes of lengths are allowed [m].
    least_force : float
        What droppers must bear after adjustment [N].
    noise : float
        Standard deviation of the measurement [m].
    points : MeasuredPoints
        What was measured.
    droppers : AdjustedDroppers
        What is to be done.
    supports : tuple of str
        Names of the supports.
    support_chainage : FloatArray
        Where they are [m].
    fewest : int
        Number of droppers of which it is proved that fewer do not do.
    passes : int
        Linearisations until heights were as predicted.
    inputs : dict
        Echo of the line file.
    """

    line: str
    method: str
    tolerance: float
    step: float
    largest_change: float
    least_force: float
    noise: float
    points: MeasuredPoints
    droppers: AdjustedDroppers
    supports: tuple[str, ...]
    support_chainage: FloatArray
    fewest: int
    passes: int
    inputs: dict[str, Any]

    @property
    def count(self) -> int:
        """Number of droppers to adjust."""
        return int(np.count_nonzero(self.droppers.adjusted))

    def largest_deviation(self, height: FloatArray) -> float:
        """Return the largest deviation of heights at droppers, shape (n,), from the wanted ones [m]."""
        off = np.abs(height - self.droppers.wanted_height)[self.droppers.checked]
        return float(off.max(initial=0.0))
