"""The dropper schedule of a result."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Droppers:
    """Dropper schedule, one entry for each dropper in the order of the line.

    A dropper hangs from its upper wire and carries its lower one: contact wire and messenger wire where a
    line has no others.

    Attributes
    ----------
    lower_wire, upper_wire : tuple of str
        Names of the wires.
    span, number : IntArray
        Span (from 1) and number within the span (from 1).
    x : FloatArray
        Chainage [m]; on a straight track the position along x.
    position_bottom, position_top : FloatArray, shape (n, 3)
        Where the axes of the wires are [m].
    stagger_bottom, stagger_top : FloatArray
        Lateral offset of the wires in the track frame, to the left [m].
    length : FloatArray
        Distance between the wire axes in the equilibrium [m].
    unstressed_length : FloatArray
        The same piece without force [m].
    cut_length : FloatArray
        Unstressed length minus what the clamps bridge [m].
    force_top, force_bottom : FloatArray
        Tension at the upper clamp and force on the lower wire, with the weights of the clamps [N].
    height, target_height, height_error : FloatArray
        Height of the lower wire in the track frame, the wanted one, and their difference [m].
    messenger_height : FloatArray
        Height of the upper wire in the track frame [m].
    force_error : FloatArray
        Residual of eq. (23) [N].
    contact_coordinate, messenger_coordinate : FloatArray
        Material coordinates of lower and upper wire at the clamps, from the wires' starts [m].
    on_contact, on_messenger : FloatArray, shape (n, 3)
        Forces of dropper and clamp on lower and upper wire [N].
    """

    lower_wire: tuple[str, ...]
    upper_wire: tuple[str, ...]
    span: IntArray
    number: IntArray
    x: FloatArray
    position_bottom: FloatArray
    position_top: FloatArray
    stagger_bottom: FloatArray
    stagger_top: FloatArray
    length: FloatArray
    unstressed_length: FloatArray
    cut_length: FloatArray
    force_top: FloatArray
    force_bottom: FloatArray
    height: FloatArray
    target_height: FloatArray
    height_error: FloatArray
    messenger_height: FloatArray
    force_error: FloatArray
    contact_coordinate: FloatArray
    messenger_coordinate: FloatArray
    on_contact: FloatArray
    on_messenger: FloatArray

    @property
    def inclination(self) -> FloatArray:
        """Angle between each dropper and the vertical [rad]; a guided one leans across the track only."""
        across = self.position_top - self.position_bottom
        return np.arctan2(np.hypot(across[:, 0], across[:, 1]), across[:, 2])

    @property
    def slack(self) -> NDArray[np.bool_]:
        """Mask of the droppers that do not lift their lower wire."""
        return self.force_bottom <= 0.0
