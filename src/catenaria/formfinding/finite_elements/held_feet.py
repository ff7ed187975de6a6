"""The contact wire alone, held at the wanted heights: the forces that droppers must exert on it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.root import find_root
from catenaria.formfinding.finite_elements.start import straight_between
from catenaria.formfinding.finite_elements.wire_system import WireSystem

FloatArray = NDArray[np.float64]


def held_feet_forces(system: LineSystem) -> FloatArray:
    """Return the forces that hold the contact wire at the wanted heights [N], positive upwards, shape (n,).

    Raises
    ------
    NotConvergedError
        If Newton's method finds no rest.
    """
    wire = WireSystem(system.contact.mesh, feet=system.target)
    idle = np.zeros(wire.mesh.clamp.size)
    start = straight_between(wire, system.target)
    y, _ = find_root(lambda y: wire.residual(y, idle), wire.jacobian, start)
    return wire.nodal_forces(y)[wire.mesh.clamp, 1]
