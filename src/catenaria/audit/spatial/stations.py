"""The supports of a line: where they stand, and which wires they hold at which places across the track."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.stated import Inputs, support_chainages
from catenaria.audit.track import Across, Track

FloatArray = NDArray[np.float64]

CONTACT: Final = "contact wire"
SECOND: Final = "second contact wire"
AUXILIARY: Final = "auxiliary messenger"
MESSENGER: Final = "messenger wire"
LONG: Final = (CONTACT, SECOND, AUXILIARY, MESSENGER)  # wires that run along the whole line


@dataclass(frozen=True)
class Stations:
    """Supports with their chainages and the planes across the track there.

    Attributes
    ----------
    supports : list of dict
        As in the line file.
    chainage : FloatArray, shape (n,)
        Where they stand [m].
    across : Across
        The planes across the track there.
    track : Track
        The track.
    spacing : float
        Between two contact wires, 0 if there is one [m].
    stitched : tuple of int
        The supports that have a stitch wire.
    """

    supports: list[dict[str, Any]]
    chainage: FloatArray
    across: Across
    track: Track
    spacing: float
    stitched: tuple[int, ...]

    @classmethod
    def of(cls, inputs: Inputs, track: Track) -> Stations:
        """Return the supports of the echo of a line file."""
        supports = inputs["supports"]
        chainage = support_chainages(inputs)
        second = inputs["second_contact_wire"]
        return cls(
            supports,
            chainage,
            track.across(chainage),
            track,
            0.0 if second is None else second["spacing"],
            () if inputs["stitch_wire"] is None else _stitched(supports),
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the supports."""
        return tuple(support["name"] for support in self.supports)

    def beside(self, wire: str) -> float:
        """Return how far to the left of its stagger a wire runs, being one of two [m]."""
        return {CONTACT: 0.5, SECOND: -0.5}.get(wire, 0.0) * self.spacing

    def held(self, wire: str, i: int) -> tuple[float, float] | None:
        """Return offset to the left and height at which a support holds a wire; None if it does not."""
        support = self.supports[i]
        contact = support["contact_wire"]
        if wire in (CONTACT, SECOND):
            return None if contact is None else (support["stagger"] + self.beside(wire), contact["height"])
        own = support["messenger_stagger"]
        offset = support["stagger"] if own is None else own
        if wire == AUXILIARY:
            auxiliary = support["auxiliary_messenger"]
            return None if auxiliary is None else (offset, auxiliary["height"])
        messenger = support["messenger_wire"]
        height = messenger["height"]
        return offset, contact["height"] + messenger["encumbrance"] if height is None else height


def _stitched(supports: list[dict[str, Any]]) -> tuple[int, ...]:
    """Return where stitch wires are: as stated, else at all supports but the first and the last."""
    inner = range(1, len(supports) - 1)
    stated = [support["stitch_wire"] for support in supports]
    return tuple(i for i, own in enumerate(stated) if (i in inner if own is None else own))
