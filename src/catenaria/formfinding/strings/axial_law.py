"""The axial law in the form that closed solutions need: a stretch that is linear in the force."""

from __future__ import annotations

from catenaria.catenary.green_bar import stretch


def tangent_law(tension: float, EA: float) -> tuple[float, float]:
    """Return c and E of the stretch c + T/E that touches the law of Green strain (9) at a tension.

    Parameters
    ----------
    tension : float
        Where they touch [N].
    EA : float
        Axial stiffness [N].

    Examples
    --------
    >>> c, E = tangent_law(15e3, 12.5e6)
    >>> round(c, 9), round(E / 12.5e6, 6)  # Hooke's law would be 1 and 1
    (1.000002146, 1.003596)
    """
    x = float(stretch(tension, EA))
    E = 0.5 * EA * (3.0 * x * x - 1.0)
    return x - tension / E, E
