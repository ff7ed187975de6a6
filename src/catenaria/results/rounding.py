"""What becomes of a line whose droppers are cut to rounded lengths."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class RoundedLine:
    """A line with rounded droppers at rest, one entry for each dropper.

    Attributes
    ----------
    step : float
        Cut lengths are whole multiples of it [m].
    cut_length : FloatArray
        Rounded lengths [m].
    change : FloatArray
        By how much they are longer than those that were found [m].
    height : FloatArray
        Heights of lower wires [m].
    height_change : FloatArray
        By how much these are higher than with the lengths that were found [m].
    height_error : FloatArray
        By how much they are higher than wanted [m].
    force : FloatArray
        Forces in droppers [N].
    """

    step: float
    cut_length: FloatArray
    change: FloatArray
    height: FloatArray
    height_change: FloatArray
    height_error: FloatArray
    force: FloatArray


@dataclass(frozen=True)
class RoundingStudy:
    """A found line, and the same line with dropper lengths rounded to some steps.

    Attributes
    ----------
    line : str
        Name of the line.
    span, number : IntArray
        Span (from 1) and number within the span (from 1) of each dropper.
    chainage : FloatArray
        Where it hangs [m].
    on_contact_wire : NDArray of bool
        Whether it carries a contact wire.
    cut_length : FloatArray
        The length that was found [m].
    wanted_height : FloatArray
        Wanted height of its lower wire [m].
    supports : dict of str to float
        Chainages of the supports by name [m].
    rounded : tuple of RoundedLine
        One for each step.
    """

    line: str
    span: IntArray
    number: IntArray
    chainage: FloatArray
    on_contact_wire: NDArray[np.bool_]
    cut_length: FloatArray
    wanted_height: FloatArray
    supports: dict[str, float]
    rounded: tuple[RoundedLine, ...]
