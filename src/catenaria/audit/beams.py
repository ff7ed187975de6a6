"""Wires of tensioned beams: cubics like any wire that bends, but with one strain and one rotation.

A beam element has the same axial strain everywhere, and its nodes only turn: their slopes r' have a direction
that is in balance, and the size by which the element is stretched.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.curve import Curve, shape_functions
from catenaria.audit.energy import STEP, ComplexArray, bending_density
from catenaria.audit.free_wire import FreeWire
from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.audit.stated import Conductor

FloatArray = NDArray[np.float64]

_INTERVALS = 12
_PASSES = 8  # each leaves the square of the slope against the chord, a thousandth, of the error in the arc


@dataclass(frozen=True)
class FreeBeam(FreeWire):
    """A wire of beam elements as a free body."""

    @cached_property
    def residual(self) -> FloatArray:
        """Residual of every node: forces [N], and moments per slope across the wire [N m], (n, 2, 3)."""
        curve = self.curve
        element = beam_force(curve, self.stated.conductor, self.gravity)
        at = curve.at(self.joint_s)
        np.subtract.at(element, at.element, at.N[:, :, None] * self.joint_force[:, None, :])
        residual = np.zeros((curve.s.size, 2, 3))
        residual[:-1] += element[:, :2]
        residual[1:] += element[:, 2:]
        return residual

    @cached_property
    def mean_stretch(self) -> FloatArray:
        """Stretched over unstressed length of every element."""
        pairs = pairwise(self.curve.s.tolist())
        return np.array([self.curve.stretched_length(*pair) for pair in pairs]) / self.curve.L

    @cached_property
    def mean_tension(self) -> FloatArray:
        """The true axial force EA eps |r'| of every element [N]."""
        x = self.mean_stretch
        return 0.5 * self.stated.conductor.EA * (x**2 - 1.0) * x

    def strain_tension(self, s: FloatArray) -> FloatArray:
        """Return N = EA eps at material coordinates, between the middles of elements [N]."""
        middle = 0.5 * (self.curve.s[:-1] + self.curve.s[1:])
        return np.interp(s, middle, 0.5 * self.stated.conductor.EA * (self.mean_stretch**2 - 1.0))


def beam_force(curve: Curve, conductor: Conductor, gravity: float) -> FloatArray:
    r"""Return the derivative of every element's potential by its nodes, shape (n_elements, 4, 3).

    Parameters
    ----------
    curve : Curve
        Nodes of the wire; of their slopes only the directions count.
    conductor : Conductor
        EA, EJ and mass.
    gravity : float
        Acceleration [m/s^2].

    Notes
    -----
    :math:`\tfrac12 EA\,L\,\varepsilon^2 + \tfrac12 EJ \int \kappa^2 ds + \rho A g \int z\,ds` with Green's
    :math:`\varepsilon = ((A/L)^2 - 1)/2` of the arc :math:`A = \int |r'| ds`, on the cubic whose slopes have
    the size A/L; differentiated by complex step like the energy of the other wires.
    """
    L, force = curve.L, np.empty_like(curve.q)
    for k in range(4):
        for i in range(3):
            q = curve.q.astype(np.complex128)
            q[:, k, i] += 1j * STEP
            force[:, k, i] = _potential(q, L, conductor, gravity).imag / STEP
    return force


def _potential(q: ComplexArray, L: FloatArray, conductor: Conductor, gravity: float) -> ComplexArray:
    """Return the potential of every element, for complex coordinates (n, 4, 3)."""
    t, weights = clenshaw_curtis(_INTERVALS)
    places = np.broadcast_to(t, (L.size, t.size))
    N, N1, N2 = (shape_functions(places, L[:, None], order) for order in range(3))
    chord = q[:, 2] - q[:, 0]
    own, arc = q.copy(), np.sqrt(np.sum(chord * chord, axis=1))
    for _ in range(_PASSES):
        for k in (1, 3):
            size = np.sqrt(np.sum(q[:, k] * q[:, k], axis=1))
            own[:, k] = q[:, k] * (arc / L / size)[:, None]
        arc = L * (np.sqrt(np.sum((N1 @ own) ** 2, axis=-1)) @ weights)
    axial = 0.125 * conductor.EA * L * ((arc / L) ** 2 - 1.0) ** 2
    bending = L * (bending_density(N1 @ own, N2 @ own, conductor) @ weights)
    return axial + bending + conductor.rhoA * gravity * L * ((N @ own)[..., 2] @ weights)
