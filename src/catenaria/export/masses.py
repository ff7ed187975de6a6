"""What has mass on the wires of a built line: clamps with half of the droppers, arms, point masses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.model import SpatialModel
from catenaria.mechanics.carrier import Strands

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_ARM_INERTIA = 1.0 / 3.0  # of a uniform rod about its hinge, as a mass at its tip
_ARM_WEIGHT = 0.5  # the hinge bears the other half


@dataclass(frozen=True)
class Lumps:
    """Masses at points of wires, one entry for each.

    Attributes
    ----------
    kind : tuple of str
        ``lower clamp``, ``upper clamp`` (each with half of its dropper), ``arm`` or ``mass``.
    carrier : Strands
        The wires.
    s : FloatArray
        Material coordinates [m].
    mass : FloatArray
        What has inertia [kg].
    weight : FloatArray
        What the wire bears [N].
    """

    kind: tuple[str, ...]
    carrier: Strands
    s: FloatArray
    mass: FloatArray
    weight: FloatArray


def lumps(model: SpatialModel, z: FloatArray) -> Lumps:
    """Return all masses of a line whose droppers weigh in their clamps.

    Parameters
    ----------
    model : SpatialModel
        The line.
    z : FloatArray, shape (n,)
        Where it is.
    """
    layout = model.layout
    droppers, masses, holds = layout.droppers, layout.masses, layout.holds
    arm = holds.hinged
    count = droppers.lower.size
    kind = (
        *("lower clamp",) * count,
        *("upper clamp",) * count,
        *("arm",) * int(np.count_nonzero(arm)),
        *("mass",) * masses.mass.size,
    )
    on = np.concatenate((droppers.lower, droppers.upper, holds.wire[arm], masses.wire))
    s = z[np.concatenate((model.lower_s, model.upper_s, model.hold_s[arm], model.mass_s))]
    clamps = np.concatenate((droppers.mass_bottom, droppers.mass_top))
    arms = holds.arm_mass[arm]
    return Lumps(
        kind,
        Strands.on(model.wires, on),
        s,
        np.concatenate((clamps, _ARM_INERTIA * arms, masses.mass)),
        layout.g * np.concatenate((clamps, _ARM_WEIGHT * arms, masses.mass)),
    )
