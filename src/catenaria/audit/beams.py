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
from catenaria.audit.energy import STEP, bending_density, weight
from catenaria.audit.free_wire import FreeWire
from catenaria.audit.quadrature import clenshaw_curtis
from catenaria.audit.stated import Conductor

FloatArray = NDArray[np.float64]

_INTERVALS = 12


@dataclass(frozen=True)
class FreeBeam(FreeWire):
    """A wire of beam elements as a free body."""

    @cached_property
    def residual(self) -> FloatArray:
        """Residual of every node: forces [N], and moments per slope across the wire [N m], (n, 2, 3)."""
        curve = self.curve
        element = beam_force(curve, self.stated.conductor)
        element -= weight(curve, self.stated.conductor.rhoA, self.gravity)
        element = turning_only(curve, element)
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

    @property
    def mean_tension(self) -> FloatArray:
        """The true axial force EA eps |r'| of every element [N]."""
        x = self.mean_stretch
        return 0.5 * self.stated.conductor.EA * (x**2 - 1.0) * x

    def strain_tension(self, s: FloatArray) -> FloatArray:
        """Return N = EA eps at material coordinates, between the middles of elements [N]."""
        middle = 0.5 * (self.curve.s[:-1] + self.curve.s[1:])
        return np.interp(s, middle, 0.5 * self.stated.conductor.EA * (self.mean_stretch**2 - 1.0))


def turning_only(curve: Curve, force: FloatArray) -> FloatArray:
    """Return element forces for nodes that only turn, shape (n_elements, 4, 3).

    Notes
    -----
    Slopes are as long as their element is stretched, chord over unstressed length. What acts on their size
    therefore acts along the chord on the nodes.
    """
    force, along = force.copy(), curve.r1 / np.linalg.norm(curve.r1, axis=1)[:, None]
    on_size = np.zeros(curve.L.size)
    for k, directions in ((1, along[:-1]), (3, along[1:])):
        size = np.sum(force[:, k] * directions, axis=1)
        force[:, k] -= size[:, None] * directions
        on_size += size
    chord = np.diff(curve.r, axis=0)
    push = (on_size / curve.L / np.linalg.norm(chord, axis=1))[:, None] * chord
    force[:, 0] -= push
    force[:, 2] += push
    return force


def beam_force(curve: Curve, conductor: Conductor) -> FloatArray:
    r"""Return dU/dq of every element with one strain, shape (n_elements, 4, 3).

    Parameters
    ----------
    curve : Curve
        Nodes of the wire.
    conductor : Conductor
        EA and EJ.

    Notes
    -----
    :math:`U = \tfrac12 EA\,L\,\varepsilon^2 + \tfrac12 EJ \int \kappa^2 ds` with Green's
    :math:`\varepsilon = ((A/L)^2 - 1)/2` of the arc :math:`A = \int |r'| ds`, differentiated by complex
    step like the energy of the other wires.
    """
    t, weights = clenshaw_curtis(_INTERVALS)
    L = curve.L[:, None]
    N1, N2 = (shape_functions(np.broadcast_to(t, (L.size, t.size)), L, order) for order in (1, 2))
    q, weights = curve.q, weights * L
    r1, r2 = N1 @ q, N2 @ q
    force = np.empty_like(q)
    for k in range(4):
        for i in range(3):
            step = np.zeros(3, dtype=np.complex128)
            step[i] = 1j * STEP
            own, second = r1 + N1[..., k, None] * step, r2 + N2[..., k, None] * step
            arc = np.sum(np.sqrt(np.sum(own * own, axis=-1)) * weights, axis=1)
            axial = 0.125 * conductor.EA * curve.L * ((arc / curve.L) ** 2 - 1.0) ** 2
            bending = np.sum(bending_density(own, second, conductor) * weights, axis=1)
            force[:, k, i] = (axial + bending).imag / STEP
    return force
