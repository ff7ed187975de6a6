"""How far from its targets a result may be: the bands of its own controls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.audit.free_wire import FreeBody
from catenaria.audit.lengths import TOLERANCE
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]


_DEFINITION = (
    1.01  # (23) takes a dropper's weight from its deformed length, the audit from its unstressed one
)


@dataclass(frozen=True)
class Allowance:
    """Largest deviations that pass: tensions of the two wires [N], heights [m] and forces [N] of droppers."""

    tension: FloatArray
    height: FloatArray
    force: FloatArray


def allowance(result: FormResult, wires: tuple[FreeBody, FreeBody]) -> Allowance:
    r"""Return what a method may leave of its targets.

    Parameters
    ----------
    result : FormResult
        Its controls state their dead bands; a control that is not there has none.
    wires : tuple of FreeBody
        Contact and messenger wire.

    Notes
    -----
    A method without dead bands meets its targets, one with bands ends within them. The dynamic method stops
    when every error is within a factor of its dead band, 1.1 by default, *or* when no control would travel
    farther than a stated distance d until it is in its band. Both are in the echo of the line file. A
    distance d is worth d of height,
    :math:`2\,EA\,d/L` of tension when both ends move, and :math:`2\,T d (1/l_1 + 1/l_2)` of dropper force
    when the wire is bent between joints at the distances l_1, l_2 and neighbours move the opposite way.
    """
    factor, travel = stop_criteria(result)
    n = result.droppers.x.size
    bands = dict(zip(result.controls.name, result.controls.dead_band.tolist(), strict=True))

    def allowed(names: list[str], slope: FloatArray, floor: float) -> FloatArray:
        e0 = np.array([bands.get(name, 0.0) for name in names])
        left = np.where(e0 > 0.0, np.maximum(factor * e0, e0 + slope * travel), 0.0)
        return np.maximum(_DEFINITION * left, floor)

    contact, messenger = wires
    slope = np.array([2.0 * wire.stated.conductor.EA / float(np.ptp(wire.end_s)) for wire in wires])
    force = max(contact.force_tolerance, messenger.force_tolerance)
    return Allowance(
        allowed([f"{wire.stated.name} tension" for wire in wires], slope, force),
        allowed([f"height at dropper {i + 1}" for i in range(n)], np.ones(n), TOLERANCE),
        allowed([f"force of dropper {i + 1}" for i in range(n)], _string_stiffness(messenger), force),
    )


def stop_criteria(result: FormResult) -> tuple[float, float]:
    """Return how many bands an error and how many metres a control may end away, after the method's rule."""
    if result.method != "dynamic":
        return 1.0, 0.0
    settle = result.inputs["solver"]["dynamic"]["settle"]
    return float(settle["dead_bands"]), float(settle["remaining_travel"])


def _string_stiffness(wire: FreeBody) -> FloatArray:
    """Return 2 T (1/l_1 + 1/l_2) at every dropper of a wire [N/m]."""
    joints = np.sort(wire.joint_s)
    after = np.searchsorted(joints, wire.clamp_s, side="right")
    before = np.searchsorted(joints, wire.clamp_s, side="left") - 1
    right = joints[np.minimum(after, joints.size - 1)] - wire.clamp_s
    left = wire.clamp_s - joints[np.maximum(before, 0)]
    return 2.0 * wire.stated.tension * (1.0 / left + 1.0 / right)
