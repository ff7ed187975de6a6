"""Forces of the wires on supports, and on the roots of cantilevers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Supports:
    """Forces of the wires on their supports, one entry for each wire held at each support.

    Attributes
    ----------
    support, wire : tuple of str
        Names.
    kind : tuple of str
        How the wire is held: ``sliding``, ``clamped``, ``spring``, ``cantilever``, ``bracket`` or ``arm``.
    x, y, z : FloatArray
        Where the wire is held in the equilibrium [m].
    chainage, stagger, height : FloatArray
        The same place in the track frame [m].
    force_x, force_y, force_z : FloatArray
        Force of the wire on the support [N]; z is positive upwards, so a hanging wire gives a negative one.
    force_lateral : FloatArray
        Its horizontal component across the track, positive to the left [N].
    tension : FloatArray
        N = EA eps of eq. (11) at the joint [N].
    sliding_coordinate : FloatArray
        Material coordinate of the wire at the support [m].
    """

    support: tuple[str, ...]
    wire: tuple[str, ...]
    kind: tuple[str, ...]
    x: FloatArray
    y: FloatArray
    z: FloatArray
    chainage: FloatArray
    stagger: FloatArray
    height: FloatArray
    force_x: FloatArray
    force_y: FloatArray
    force_z: FloatArray
    force_lateral: FloatArray
    tension: FloatArray
    sliding_coordinate: FloatArray


@dataclass(frozen=True)
class Cantilevers:
    """Flexible cantilevers that carry a wire at their tips, one entry for each.

    Attributes
    ----------
    support : tuple of str
        Names.
    root, tip : FloatArray, shape (n, 3)
        Where they are fixed, and where they carry the wire in the equilibrium [m].
    force : FloatArray, shape (n, 3)
        Forces of the cantilevers on their roots [N].
    """

    support: tuple[str, ...]
    root: FloatArray
    tip: FloatArray
    force: FloatArray


NO_CANTILEVERS: Final = Cantilevers((), np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 3)))
