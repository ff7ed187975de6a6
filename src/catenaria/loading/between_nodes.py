r"""What a mesh takes from elasticity: under a point force wires bend more sharply than their elements can.

Notes
-----
By Galerkin orthogonality the elasticity of a mesh is too small by the square of its error in the energy norm.
That error is where the force is: elements some way off see it as before. So the wire of a few elements on
either side is taken out, between two hinges, and what it lacks to its closed form is added.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.pressed_wire import pressed_elements, pressed_wire
from catenaria.discretise.read_back import element_tension
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.mechanics.chain import Chain

FloatArray = NDArray[np.float64]

_AROUND = 8  # elements on either side; the error falls to a tenth or less from one to the next


def between_nodes(model: SpatialModel, wires: Sequence[int], s: Sequence[FloatArray]) -> FloatArray:
    """Return what the mesh takes from elasticities [m/N], shape (n_points,).

    Parameters
    ----------
    model : SpatialModel
        The line, whose unknowns start at rest.
    wires : sequence of int
        Wires that share the force equally.
    s : sequence of FloatArray, shape (n_points,)
        Material coordinates of the points on each of these wires [m].
    """
    z, share = model.unknowns.start, 1.0 / len(wires)
    lacking = np.zeros(s[0].size)
    for k, at in zip(wires, s, strict=True):
        chain = model.wires[k]
        lacking += share**2 * _lacking(chain, element_tension(chain, z), at)
    return lacking


def _lacking(chain: Chain, tension: FloatArray, s: FloatArray) -> FloatArray:
    element, knots, EJ = chain.locate(s), chain.knots, chain.section.EJ
    lacking = np.empty(s.size)
    for e in np.unique(element).tolist():
        first, last = max(0, e - _AROUND), min(knots.size - 1, e + 1 + _AROUND)
        own, here = knots[first : last + 1] - knots[first], element == e
        x, T = s[here] - knots[first], float(tension[e])
        lacking[here] = pressed_wire(x, own[-1], T, EJ) - pressed_elements(own, e - first, x, T, EJ)
    return lacking
