"""Steady arms in a result: where they stand, and what they bear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Arms:
    """Steady arms, bars with hinges at both ends that hold a contact wire at its stagger; one entry for each.

    Attributes
    ----------
    support, wire, registration : tuple of str
        Names of support and wire; ``pull-off`` for an arm that pulls the wire to its hinge, ``push-off``.
    chainage : FloatArray
        Of the support [m].
    hinge, tip : FloatArray, shape (n, 3)
        The end at the support and the end at the wire [m].
    hinge_stagger, hinge_height : FloatArray
        The hinge in the track frame [m].
    length : FloatArray
        From hinge to tip [m].
    angle : FloatArray
        Of the arm above the horizontal, seen from the hinge [rad].
    axial : FloatArray
        Force in the arm, without its own weight; tension is positive [N].
    radial : FloatArray
        Horizontal component of the force with which the wire pulls at the arm, positive away from the hinge:
        the arm is in tension [N].
    vertical : FloatArray
        Force of the arm on the wire, upwards [N].
    minimum_radial : FloatArray
        Smallest size of the radial force that the line file asks for, 0 if it asks for none [N].
    """

    support: tuple[str, ...]
    wire: tuple[str, ...]
    registration: tuple[str, ...]
    chainage: FloatArray
    hinge: FloatArray
    tip: FloatArray
    hinge_stagger: FloatArray
    hinge_height: FloatArray
    length: FloatArray
    angle: FloatArray
    axial: FloatArray
    radial: FloatArray
    vertical: FloatArray
    minimum_radial: FloatArray

    @property
    def pull(self) -> FloatArray:
        """Radial force that holds the wire sideways [N]: of pull-off arms negative where they push."""
        pulls_off = np.array([kind == "pull-off" for kind in self.registration], dtype=np.bool_)
        return np.where(pulls_off, self.radial, np.abs(self.radial))

    @property
    def enough(self) -> NDArray[np.bool_]:
        """Mask of the arms that do what they are for, with the radial force that is wanted."""
        return (self.pull > 0.0) & (self.pull >= self.minimum_radial)


_NONE = np.empty(0)
_NOWHERE = np.empty((0, 3))
NO_ARMS: Final = Arms((), (), (), _NONE, _NOWHERE, _NOWHERE, *(_NONE,) * 8)
