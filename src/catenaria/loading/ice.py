"""Ice on the wires and droppers of a line: its weight, and by how much it makes them thicker."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.line.load_case import Ice

FloatArray = NDArray[np.float64]

CONTACT: Final = "contact wire"  # the role of both contact wires
SHARE: Final = 0.5  # of the messenger wire's ice on a contact wire
_IFE: Final = ((500.0, 0.0), (1000.0, 3.5), (1500.0, 7.0), (math.inf, 15.0))


def ice_by_altitude(altitude: float) -> float:
    """Return the weight of ice on a messenger wire [N/m] at an altitude [m].

    Notes
    -----
    The Spanish rule for overhead lines (IFE, Order TMA/135/2023): 0 up to 500 m, 3.5 N/m up to 1000 m, 7 N/m
    up to 1500 m and 15 N/m above, and half of that on the contact wire.

    Examples
    --------
    >>> [ice_by_altitude(altitude) for altitude in (500.0, 500.1, 1200.0, 2000.0)]
    [0.0, 3.5, 7.0, 15.0]
    """
    return next(load for highest, load in _IFE if altitude <= highest)


def ring_weight(thickness: float, density: float, diameter: FloatArray, g: float) -> FloatArray:
    """Return the weight of rings of ice, pi t (d + t) rho g [N/m]."""
    return math.pi * thickness * (diameter + thickness) * density * g


def ice_on(ice: Ice, roles: tuple[str, ...], diameter: FloatArray, g: float) -> FloatArray:
    """Return the weight of ice on each of some wires, shape (n,) [N/m].

    Parameters
    ----------
    ice : Ice
        The ice.
    roles : tuple of str
        What the wires are for; what is no contact wire bears as much as a messenger wire.
    diameter : FloatArray, shape (n,)
        Outer diameters [m].
    g : float
        Gravity [m/s^2].
    """
    if ice.thickness is not None:
        return ring_weight(ice.thickness, ice.density, diameter, g)
    load = ice.messenger_wire or 0.0
    if ice.altitude is not None:
        load = ice_by_altitude(ice.altitude)
    contact = SHARE * load if ice.contact_wire is None else ice.contact_wire
    return np.array([contact if role == CONTACT else load for role in roles])


def thicker(ice: Ice | None) -> float:
    """Return by how much ice makes wires thicker [m], which is known only of ice of given thickness."""
    return 0.0 if ice is None or ice.thickness is None else 2.0 * ice.thickness
