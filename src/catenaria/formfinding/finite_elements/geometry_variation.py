"""Geometry variation with updated reference [6, 23]: the deformed geometry becomes the next reference.

Our reconstruction of the family: stress stays as prescribed while the geometry, imposed anew as the reference
after every step, is moved by the unbalanced forces.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements import beam
from catenaria.formfinding.finite_elements.beam import Section
from catenaria.formfinding.finite_elements.found import Found
from catenaria.formfinding.finite_elements.prescribed_forces import vary
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]


def vary_geometry(line: Line, start: FormResult | None) -> Found:
    r"""Find the form by moving a reference geometry under prescribed stress.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    start : FormResult or None
        An earlier result to begin from.

    Raises
    ------
    NotConvergedError
        If the nodes do not come to rest.

    Notes
    -----
    Within a step an element's force does not change, because its reference moves along. With the force f and
    its horizontal part H that is held by the unstressed length L,

    .. math:: K_H = \frac{\partial f}{\partial q}
              - \frac{\partial f}{\partial L}\left(\frac{\partial H}{\partial L}\right)^{-1}
              \frac{\partial H}{\partial q},

    which leaves the geometric stiffness, that of bending, and no elastic one along the wire. It is the exact
    derivative for prescribed horizontal forces, so that few rounds suffice.
    """
    return vary(line, start, held_stiffness, "the reference geometry was moved")


def held_stiffness(q: FloatArray, L: FloatArray, section: Section) -> FloatArray:
    """Return the stiffness of elements that keep their horizontal force, shape (n, 6, 6)."""
    K, f_L = beam.tangent(q, L, section)
    return K - f_L[:, :, None] * K[:, None, 3, :] / f_L[:, 3, None, None]
