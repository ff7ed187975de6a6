"""The nonlinear displacement method [17]: geometry varies up to equilibrium with prescribed forces.

Our reconstruction of the family (Argyris): displacements by the full tangent stiffness of the elastic line,
after each of which all pieces are cut anew to the forces that they shall carry.
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


def displace_nonlinearly(line: Line, start: FormResult | None) -> Found:
    r"""Find the form by displacements with elastic and geometric stiffness.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    start : FormResult or None
        An earlier result to begin from: the method's need for an initial geometry.

    Raises
    ------
    NotConvergedError
        If the nodes do not come to rest.

    Notes
    -----
    :math:`(K_E + K_G)\,\Delta x = f - B N^*`, then lengths are cut so that the forces are N* again. The
    elastic part resists what cutting lets go, so that the error goes down by a factor a round, which is about
    :math:`EA\,z'^2/T` over one plus that for a slope z' of the wire.
    """
    return vary(line, start, tangent_stiffness, "the line was displaced and cut")


def tangent_stiffness(q: FloatArray, L: FloatArray, section: Section) -> FloatArray:
    """Return the tangent stiffness of elements with fixed unstressed lengths, shape (n, 6, 6)."""
    return beam.tangent(q, L, section)[0]
