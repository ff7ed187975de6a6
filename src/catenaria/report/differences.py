"""How far two results of one line are from each other, as numbers and as a table."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from catenaria.results import FormResult
from catenaria.results.form import Profile

FloatArray = NDArray[np.float64]

_SAMPLES = 1000


@dataclass(frozen=True)
class Differences:
    """One result minus another one of the same line.

    Attributes
    ----------
    dropper_x : FloatArray, shape (n,)
        Where the droppers are [m].
    length, force : FloatArray, shape (n,)
        Dropper lengths [m] and forces on the contact wire [N].
    x : FloatArray, shape (m,)
        Places along the line between its first and its last support [m].
    contact_height, messenger_height : FloatArray, shape (m,)
        Heights of the wires there [m].
    """

    dropper_x: FloatArray
    length: FloatArray
    force: FloatArray
    x: FloatArray
    contact_height: FloatArray
    messenger_height: FloatArray

    @property
    def largest_length(self) -> float:
        """Largest difference of a dropper's length, without sign [m]."""
        return float(np.max(np.abs(self.length)))

    @property
    def largest_height(self) -> float:
        """Largest difference of a wire's height, without sign [m]."""
        return float(max(np.max(np.abs(self.contact_height)), np.max(np.abs(self.messenger_height))))

    @property
    def largest_force(self) -> float:
        """Largest difference of a dropper's force, without sign [N]."""
        return float(np.max(np.abs(self.force)))


def differences(result: FormResult, reference: FormResult) -> Differences:
    """Return one result minus another one of the same line."""
    support_x = reference.supports.x
    x = np.linspace(float(support_x.min()), float(support_x.max()), _SAMPLES)
    contact, messenger = (
        _height(one.profile, x) - _height(other.profile, x)
        for one, other in zip(result.wires, reference.wires, strict=True)
    )
    one, other = result.droppers, reference.droppers
    return Differences(
        other.x,
        one.length - other.length,
        one.force_bottom - other.force_bottom,
        x,
        contact,
        messenger,
    )


def _height(shape: Profile, x: FloatArray) -> FloatArray:
    """Return the height of a wire at places along the track.

    Straight pieces between points would be a tenth of a millimetre off, a parabola through three points would
    cut kinks. So each piece is bent like the flatter one of its two neighbourhoods (Harten et al. 1987, ENO).
    """
    i = np.clip(np.searchsorted(shape.x, x), 1, shape.x.size - 1)
    slope = np.diff(shape.z) / np.diff(shape.x)
    bend = np.zeros(shape.x.size)
    bend[1:-1] = np.diff(slope) / (shape.x[2:] - shape.x[:-2])
    bend[0], bend[-1] = bend[1], bend[-2]
    before, after = bend[i - 1], bend[i]
    flatter = np.where(np.abs(before) < np.abs(after), before, after)
    start, end = shape.x[i - 1], shape.x[i]
    return shape.z[i - 1] + slope[i - 1] * (x - start) + flatter * (x - start) * (x - end)


def write_differences(found: Mapping[str, Differences], file: Path) -> Path:
    """Write the differences of all methods at all droppers as CSV, one row for each."""
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(("method", "dropper", "x_m", "length_difference_m", "force_difference_N"))
        for method, each in found.items():
            rows = zip(each.dropper_x, each.length, each.force, strict=True)
            for number, (x, length, force) in enumerate(rows, start=1):
                writer.writerow((method, number, f"{x:.3f}", f"{length:.8f}", f"{force:.5f}"))
    return file
