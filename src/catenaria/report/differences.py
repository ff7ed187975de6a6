"""How far two results of one line are from each other, as numbers and as a table."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

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
        Chainages of the droppers [m].
    length, force : FloatArray, shape (n,)
        Dropper lengths [m] and forces on the lower wires [N].
    x : FloatArray, shape (m,)
        Chainages between the first and the last support [m].
    wire : tuple of str
        Names of the n_w wires.
    height, lateral : FloatArray, shape (n_w, m)
        Heights and lateral offsets of the wires there, in the track frame [m]; 0 where a wire does not reach.
    """

    dropper_x: FloatArray
    length: FloatArray
    force: FloatArray
    x: FloatArray
    wire: tuple[str, ...]
    height: FloatArray
    lateral: FloatArray

    @property
    def largest_length(self) -> float:
        """Largest difference of a dropper's length, without sign [m]."""
        return float(np.max(np.abs(self.length), initial=0.0))

    @property
    def largest_height(self) -> float:
        """Largest difference of a wire's height, without sign [m]."""
        return float(np.max(np.abs(self.height)))

    @property
    def largest_lateral(self) -> float:
        """Largest difference of a wire's lateral offset, without sign [m]."""
        return float(np.max(np.abs(self.lateral)))

    @property
    def largest_force(self) -> float:
        """Largest difference of a dropper's force, without sign [N]."""
        return float(np.max(np.abs(self.force), initial=0.0))


def differences(result: FormResult, reference: FormResult) -> Differences:
    """Return one result minus another one of the same line."""
    place = reference.supports.chainage
    x = np.linspace(float(place.min()), float(place.max()), _SAMPLES)
    pairs = [(one.profile, other.profile) for one, other in zip(result.wires, reference.wires, strict=True)]
    one, other = result.droppers, reference.droppers
    return Differences(
        dropper_x=other.x,
        length=one.length - other.length,
        force=one.force_bottom - other.force_bottom,
        x=x,
        wire=tuple(wire.name for wire in reference.wires),
        height=np.array([_difference(pair, "height", x) for pair in pairs]),
        lateral=np.array([_difference(pair, "lateral", x) for pair in pairs]),
    )


def _difference(
    pair: tuple[Profile, Profile], field: Literal["height", "lateral"], x: FloatArray
) -> FloatArray:
    """Return by how much one wire is higher or further to the left than the other, 0 where one ends."""
    start = max(shape.chainage[0] for shape in pair)
    end = min(shape.chainage[-1] for shape in pair)
    one, other = (_along(shape.chainage, getattr(shape, field), x) for shape in pair)
    return np.where((start <= x) & (x <= end), one - other, 0.0)


def _along(chainage: FloatArray, offset: FloatArray, x: FloatArray) -> FloatArray:
    """Return the height or the lateral offset of a wire at places along the track.

    Straight pieces between points would be a tenth of a millimetre off, a parabola through three points would
    cut kinks. So each piece is bent like the flatter one of its two neighbourhoods (Harten et al. 1987, ENO).
    """
    i = np.clip(np.searchsorted(chainage, x), 1, chainage.size - 1)
    slope = np.diff(offset) / np.diff(chainage)
    bend = np.zeros(chainage.size)
    bend[1:-1] = np.diff(slope) / (chainage[2:] - chainage[:-2])
    bend[0], bend[-1] = bend[1], bend[-2]
    before, after = bend[i - 1], bend[i]
    flatter = np.where(np.abs(before) < np.abs(after), before, after)
    start, end = chainage[i - 1], chainage[i]
    return offset[i - 1] + slope[i - 1] * (x - start) + flatter * (x - start) * (x - end)


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
