"""What else is clamped to wires: the ends of other wires, and masses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Ties:
    """Ends of stitch wires and mid-point anchors, clamped to other wires; one entry for each.

    Attributes
    ----------
    wire, host : tuple of str
        Names of the wire that ends and of that which bears it.
    end : IntArray
        0 for the wire's start, 1 for its end.
    chainage : FloatArray
        Of the clamp [m].
    coordinate : FloatArray
        Material coordinate of the host there, from its start [m].
    force : FloatArray, shape (n, 3)
        Forces of the wires' ends on their hosts [N].
    """

    wire: tuple[str, ...]
    host: tuple[str, ...]
    end: IntArray
    chainage: FloatArray
    coordinate: FloatArray
    force: FloatArray


@dataclass(frozen=True)
class Masses:
    """Point masses on wires, as insulators, clamps and section insulators are; one entry for each.

    Attributes
    ----------
    name, wire : tuple of str
        Names of mass and wire.
    chainage : FloatArray
        Where it hangs [m].
    coordinate : FloatArray
        Material coordinate of the wire there, from its start [m].
    mass : FloatArray
        Masses [kg].
    """

    name: tuple[str, ...]
    wire: tuple[str, ...]
    chainage: FloatArray
    coordinate: FloatArray
    mass: FloatArray


_NONE = np.empty(0)
NO_TIES: Final = Ties((), (), np.empty(0, dtype=np.int64), _NONE, _NONE, np.empty((0, 3)))
NO_MASSES: Final = Masses((), (), _NONE, _NONE, _NONE)
