"""A straight bar or dropper with Green strain under axial force: closed form of its stretch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InfeasibleError

FloatArray = NDArray[np.float64]


def stretch(force: float | FloatArray, EA: float) -> FloatArray:
    """Return |r'| of a bar that carries the true axial force EA eps |r'|.

    Parameters
    ----------
    force : float or FloatArray
        Axial force, positive in tension [N].
    EA : float
        Axial stiffness [N].

    Returns
    -------
    FloatArray
        Deformed length over unstressed length.

    Raises
    ------
    InfeasibleError
        If the compression exceeds what a bar of this law can carry, EA/sqrt(27).

    Notes
    -----
    With eps = (x^2 - 1)/2 of eq. (9) and the force EA eps x, the stretch x solves x^3 - x = 2 force/EA. The
    root near 1 is Viete's x = 2/sqrt(3) cos(arccos(3 sqrt(3) force/EA)/3), or its hyperbolic form beyond
    force/EA = 1/sqrt(27).

    Examples
    --------
    >>> x = stretch(100.0, 1.19e6)
    >>> round(float(1.19e6 * (x**2 - 1) / 2 * x), 6)
    100.0
    """
    c = np.asarray(3.0 * np.sqrt(3.0) * np.asarray(force, dtype=np.float64) / EA)
    if np.any(c < -1.0):
        pushed, most = -float(np.min(force)), EA / np.sqrt(27.0)
        raise InfeasibleError(
            f"a compression of {pushed:.4g} N exceeds the {most:.4g} N that a bar with Green strain can "
            "carry; demands that pull at it would help"
        )
    inner = np.cos(np.arccos(np.minimum(c, 1.0)) / 3.0)
    outer = np.cosh(np.arccosh(np.maximum(c, 1.0)) / 3.0)
    return 2.0 / np.sqrt(3.0) * np.where(c <= 1.0, inner, outer)
