"""The velocity law of the controls, eqs. (19) and (21): smooth, with a dead band and a saturation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.numerics.smoothstep import smoothstep, smoothstep_slope

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class VelocityLaw:
    """v(e) = -sign(e) v_s x^2 (3 - 2 x) with x = (|e| - e0)/(e1 - e0) between 0 and 1.

    Parameters
    ----------
    v_s : float
        Largest velocity [m/s].
    e0 : float
        Half width of the dead band, T0 or h0 [N or m].
    e1 : float
        Error from which the velocity is largest, T1 or h1 [N or m].

    Raises
    ------
    InconsistentInputError
        Unless 0 <= e0 < e1 and v_s > 0, all finite.

    Notes
    -----
    The last branches of (19) and (21) are printed with ">= -T1" and ">= -h1"; they must read "<=": the law is
    odd.

    Examples
    --------
    >>> law = VelocityLaw(v_s=0.2e-3, e0=5.0, e1=100.0)
    >>> law.velocity(np.array([-200.0, 52.5, 200.0]))
    array([ 0.0002, -0.0001, -0.0002])
    >>> bool(law.velocity(np.array(3.0)) == 0.0)
    True
    """

    v_s: float
    e0: float
    e1: float

    def __post_init__(self) -> None:
        if not (0.0 <= self.e0 < self.e1 < np.inf and 0.0 < self.v_s < np.inf):
            raise InconsistentInputError(f"a velocity law needs finite 0 <= e0 < e1 and v_s > 0, not {self}")

    def velocity(self, e: FloatArray) -> FloatArray:
        """Return v(e) [m/s]."""
        return -np.copysign(self.v_s, e) * smoothstep((np.abs(e) - self.e0) / (self.e1 - self.e0))

    def slope(self, e: FloatArray) -> FloatArray:
        """Return dv/de."""
        width = self.e1 - self.e0
        return -self.v_s / width * smoothstep_slope((np.abs(e) - self.e0) / width)

    def beyond(self, e: FloatArray) -> FloatArray:
        """Return by how much e lies beyond the dead band, with its sign; 0 inside."""
        return np.copysign(np.maximum(np.abs(e) - self.e0, 0.0), e)
