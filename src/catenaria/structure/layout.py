"""How cables lie at the start."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.hanging_chain import hanging_chain
from catenaria.structure.cable import Cable

FloatArray = NDArray[np.float64]

_SAME = 1e-9  # part of a cable's length by which a point may miss a bend


def lay_out(cable: Cable, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return position [m] and slope of a cable at the start, at material coordinates, shape (n, 3) each.

    Notes
    -----
    On a bend the slope is the mean of those on both sides.
    """
    if cable.length > cable.laid_length:
        return _hanging(cable, s)
    points, corners = np.array(cable.points), np.array(cable.corners)
    stretch = cable.laid_length / cable.length
    along = stretch * s
    position = np.column_stack([np.interp(along, corners, points[:, axis]) for axis in range(3)])
    direction = np.diff(points, axis=0) / np.diff(corners)[:, None]
    near = _SAME * cable.laid_length
    sides = [np.clip(np.searchsorted(corners, along + d) - 1, 0, corners.size - 2) for d in (-near, near)]
    return position, 0.5 * stretch * (direction[sides[0]] + direction[sides[1]])


def _hanging(cable: Cable, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return position and slope of a slack cable between two points."""
    start, chord = np.array(cable.points[0]), np.subtract(cable.points[1], cable.points[0])
    span = float(np.hypot(chord[0], chord[1]))
    x, z, dx, dz = hanging_chain(s, span, float(chord[2]), cable.length)
    along, up = np.array([chord[0], chord[1], 0.0]) / span, np.array([0.0, 0.0, 1.0])
    return start + np.outer(x, along) + np.outer(z, up), np.outer(dx, along) + np.outer(dz, up)
