"""What supports do to strings: with what stiffness they keep a wire where, in each of the two directions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.balance import Holding
from catenaria.discretise.spatial.layout import LaidCantilever, across
from catenaria.discretise.spatial.strings import Strings
from catenaria.errors import InfeasibleError

FloatArray = NDArray[np.float64]


def lateral_holding(strings: Strings) -> Holding:
    """Return what supports do horizontally across the track.

    Raises
    ------
    InfeasibleError
        If a steady arm is too short to reach from its hinge to the height of the wire.
    """
    holds, at = strings.layout.holds, strings.wire_at[strings.net.hold]
    left = across(holds.frame)
    hinge = np.where(holds.hinged[:, None], holds.hinge, at)
    square = holds.arm_length**2 - (at - hinge)[:, 2] ** 2
    short = np.flatnonzero(holds.hinged & (square <= 0.0))
    if short.size:
        raise InfeasibleError(
            f"the steady arm at support {holds.support[short[0]] + 1} does not reach from its hinge to the "
            f"{strings.layout.wires[holds.wire[short[0]]].name}; a longer arm, or a hinge nearer to the "
            "height of the wire, would help"
        )
    tip = hinge - (holds.side * np.sqrt(np.maximum(square, 0.0)))[:, None] * left
    place, stiffness = _unloaded(strings)
    way = np.einsum("ni,ni->n", np.where(holds.hinged[:, None], tip, place) - at, left)
    return Holding(stiffness[:, 0], way, np.zeros_like(way))


def vertical_holding(strings: Strings) -> Holding:
    """Return what supports do vertically: an arm with a given hinge pulls, once its force is known."""
    holds, at = strings.layout.holds, strings.wire_at[strings.net.hold]
    lifted, swings = np.isfinite(holds.lift), holds.hinged & np.isfinite(strings.arm)
    place, stiffness = _unloaded(strings)
    height = np.where(swings, holds.hinge[:, 2], place[:, 2])
    lift = np.where(lifted & strings.loaded, holds.lift, 0.0)
    return Holding(
        np.where(swings, strings.arm, np.where(lifted, 0.0, stiffness[:, 1])),
        height - at[:, 2],
        np.where(swings, -0.5 * strings.g * holds.arm_mass, lift),
    )


def arm_densities(strings: Strings) -> FloatArray:
    """Return the force densities of arms with given hinges that carry the lateral forces [N/m]."""
    holds, left = strings.layout.holds, across(strings.layout.holds.frame)
    reach = np.einsum("ni,ni->n", strings.wire_at[strings.net.hold] - holds.hinge, left)
    force = np.einsum("ni,ni->n", strings.hold_force, left)
    return np.divide(force, reach, out=np.zeros_like(force), where=holds.hinged)


def _unloaded(strings: Strings) -> tuple[FloatArray, FloatArray]:
    """Return where supports are without forces, shape (n, 3), and their stiffness across and up, (n, 2)."""
    holds = strings.layout.holds
    place, compliance = holds.X.copy(), holds.compliance.copy()
    for part in strings.layout.cantilevers:
        place[part.hold, 2] -= _sag(strings, part)
        compliance[part.hold] = _compliance(strings, part)
    with np.errstate(divide="ignore"):
        return place, 1.0 / compliance


def _reach(strings: Strings, part: LaidCantilever) -> tuple[float, FloatArray]:
    """Return a cantilever's length and the components of its direction across and up."""
    holds = strings.layout.holds
    reach = holds.X[part.hold] - part.root
    length = float(np.linalg.norm(reach))
    return length, np.array([across(holds.frame)[part.hold] @ reach, reach[2]]) / length


def _compliance(strings: Strings, part: LaidCantilever) -> FloatArray:
    """Return how far a cantilever's tip gives way across and up: L^3/(3 EJ), along itself L/EA [m/N]."""
    length, direction = _reach(strings, part)
    axial = direction**2
    return axial * length / part.section.EA + (1.0 - axial) * length**3 / (3.0 * part.section.EJ)


def _sag(strings: Strings, part: LaidCantilever) -> float:
    """Return how far a cantilever's tip hangs down by its own weight: q L^4/(8 EJ) [m]."""
    length, direction = _reach(strings, part)
    across_it = (1.0 - direction[1] ** 2) * strings.g * part.section.rhoA
    return float(across_it * length**4 / (8.0 * part.section.EJ))
