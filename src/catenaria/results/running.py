"""Where pantographs run along a contact wire: not where it is lifted to its anchors beyond the droppers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.results.form import FormResult, WireForm

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

LIFTED = 0.15  # m: a wire that a span without droppers follows on is out of reach if it is higher by more


@dataclass(frozen=True)
class Running:
    """Supports that hold a contact wire where it is in use, in order of chainage.

    Attributes
    ----------
    wire : str
        Name.
    support : tuple of str
        Names.
    chainage, height, stagger : FloatArray
        Where the wire is held in the track frame [m].
    left_out : int
        How many bays at the ends are not counted.
    """

    wire: str
    support: tuple[str, ...]
    chainage: FloatArray
    height: FloatArray
    stagger: FloatArray
    left_out: int

    def between(self, chainage: FloatArray) -> NDArray[np.bool_]:
        """Return what is between the first and the last of the supports."""
        if not self.chainage.size:
            return np.ones(chainage.size, dtype=np.bool_)
        return (chainage >= self.chainage[0]) & (chainage <= self.chainage[-1])

    @property
    def note(self) -> str:
        """What one must know of bays that are left out."""
        if not self.left_out or not self.support:
            return ""
        used = f"from {self.support[0]} to {self.support[-1]}"
        return f"{used}: beyond them the wire has no droppers, or is lifted"


def contact_wires(result: FormResult) -> list[WireForm]:
    """Return the wires that pantographs touch."""
    return [wire for wire in result.wires if wire.role == "contact wire"]


def used_contact_wires(result: FormResult) -> tuple[Running, ...]:
    """Return where each contact wire is in use."""
    return tuple(running(result, wire) for wire in contact_wires(result))


def running(result: FormResult, wire: WireForm) -> Running:
    """Return the supports between which a contact wire is in use.

    Notes
    -----
    Bays without droppers at the ends of a line do not count, nor does the bay next to one if the wire rises
    in it by more than `LIFTED`: there it leaves for its anchor and another wire is in use.
    """
    supports, droppers = result.supports, result.droppers
    held = np.flatnonzero([name == wire.name for name in supports.wire])
    held = held[np.argsort(supports.chainage[held], kind="stable")]
    x, z = supports.chainage[held], supports.height[held]
    own = droppers.x[[result_role(result, name) == "contact wire" for name in droppers.lower_wire]]
    count = np.histogram(own, bins=x)[0] if x.size > 1 else np.empty(0, dtype=np.int64)
    first = _left_out(count, z)
    last = x.size - _left_out(count[::-1], z[::-1])
    if last - first < 2:
        first, last = 0, x.size
    kept: IntArray = held[first:last]
    names: list[str] = [supports.support[i] for i in kept.tolist()]
    return Running(
        wire=wire.name,
        support=tuple(names),
        chainage=supports.chainage[kept],
        height=supports.height[kept],
        stagger=supports.stagger[kept],
        left_out=int(x.size - kept.size),
    )


def result_role(result: FormResult, name: str) -> str:
    """Return what a wire is for."""
    return result.wire(name).role


def _left_out(count: IntArray, height: FloatArray) -> int:
    """Return how many bays, seen from an end, are out of use."""
    bays = 0
    while bays < count.size and count[bays] == 0:
        bays += 1
    if 0 < bays < count.size and height[bays] - height[bays + 1] > LIFTED:
        bays += 1
    return bays
