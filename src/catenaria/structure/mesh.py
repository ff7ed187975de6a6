"""Where the nodes of cables are: as described, and under joints and masses."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.structure.joint import Attachment
from catenaria.structure.structure import Structure

FloatArray = NDArray[np.float64]

_SAME = 1e-9  # part of a cable's length by which a joint may miss a node


def knots(structure: Structure, name: str) -> FloatArray:
    """Return material coordinates of a cable's nodes, also those on bends and under joints and masses [m]."""
    cable = structure.cables[name]
    if cable.elements is not None:
        base = np.linspace(0.0, cable.length, cable.elements + 1)
    else:
        base = np.array([0.0, *(cable.nodes or ()), cable.length])
    at = [point.coordinate(cable.length) for point in _clamped(structure) if point.cable == name]
    at += [corner * cable.length / cable.laid_length for corner in cable.corners]
    added: list[float] = []
    for s in sorted(at):
        if np.abs(np.append(base, added) - s).min() > _SAME * cable.length:
            added.append(s)
    return np.sort(np.append(base, added))


def _clamped(structure: Structure) -> Iterator[Attachment]:
    """Yield the points that must be nodes: all that are joined or loaded and do not slide."""
    for joint in structure.joints.values():
        if not joint.slides:
            yield joint.on
        if joint.to is not None:
            yield joint.to
    for mass in structure.masses.values():
        yield mass.on
