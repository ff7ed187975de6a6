"""Which droppers and which supports are those of contact wires."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout, Role

IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]


def in_role(layout: Layout, wires: IntArray, role: Role) -> Mask:
    """Return which of some wires, given by their indices, have a role.

    Parameters
    ----------
    layout : Layout
        The line.
    wires : IntArray, shape (n,)
        Indices.
    role : str
        What the wires are for.
    """
    has = np.array([wire.role == role for wire in layout.wires], dtype=np.bool_)
    return has[wires]
