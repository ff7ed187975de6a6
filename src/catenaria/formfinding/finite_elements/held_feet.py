"""The contact wire alone, held at the wanted heights: the forces that droppers must exert on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.sparse import Matrix
from catenaria.formfinding.finite_elements.start import straight_between
from catenaria.formfinding.finite_elements.wire_system import WireSystem
from catenaria.solvers.newton import solve_newton

FloatArray = NDArray[np.float64]

_SCALE = 1e-9  # m and rad: a correction that is negligible


@dataclass(frozen=True)
class _Equations:
    """A wire with held feet, as Newton's method wants it."""

    wire: WireSystem

    @property
    def newton_scale(self) -> FloatArray:
        return np.full(self.wire.size, _SCALE)

    def residual(self, y: FloatArray) -> FloatArray:
        return self.wire.residual(y, np.zeros(self.wire.mesh.clamp.size))

    def jacobian(self, y: FloatArray) -> Matrix:
        return self.wire.jacobian(y).tocsc()

    def reselect(self, y: FloatArray) -> None:
        """Return nothing: there is no discrete state."""


def held_feet_forces(system: LineSystem) -> FloatArray:
    """Return the forces that hold the contact wire at the wanted heights [N], positive upwards, shape (n,).

    Raises
    ------
    NotConvergedError
        If Newton's method finds no rest.
    """
    wire = WireSystem(system.contact.mesh, feet=system.target)
    y = solve_newton(_Equations(wire), straight_between(wire, system.target)).y
    return wire.nodal_forces(y)[wire.mesh.clamp, 1]
