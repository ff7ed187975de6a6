"""The parts that hold wires at supports: rollers, clamps, brackets and steady arms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import Layout, across
from catenaria.discretise.spatial.numbering import Numbering
from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.elements.arms import Arms
from catenaria.mechanics.joints.clamps import Clamps
from catenaria.mechanics.joints.held_across import HeldAcross
from catenaria.mechanics.joints.supports import Supports
from catenaria.mechanics.loads.gravity import Ramp

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]


def held_parts(
    numbers: Numbering, layout: Layout, z: FloatArray, ramp: Ramp, *, built: bool
) -> Iterator[Contribution]:
    """Yield rollers, clamps and brackets, with wires in the elements that fit z.

    Parameters
    ----------
    numbers : Numbering
        Where the unknowns are.
    layout : Layout
        What is modelled.
    z : FloatArray, shape (n,)
        Unknowns.
    ramp : Ramp
        Growth of prescribed vertical forces.
    built : bool
        Whether clamps are closed; while a form is found, wires run through them as over rollers.
    """
    holds = layout.holds
    kind = np.array(holds.kind, dtype=np.str_)
    flexible = kind == "cantilever"
    clamped = (kind == "clamped") & built
    tips = np.array([chain.nodes[-1, :3] for chain in numbers.cantilevers], dtype=np.int64)
    for mask, nodes in ((~holds.guided & ~flexible & ~clamped, None), (flexible, tips)):
        if mask.any():
            yield _rollers(numbers, layout, z, mask, nodes)
    if clamped.any():
        on, s, element = _held(numbers, layout, z, clamped)
        force = numbers.roller_force[clamped[~holds.guided]]
        yield Clamps(on, s, force, element, holds.X[clamped])
    placed = holds.guided & ~holds.hinged
    if placed.any():
        on, s, element = _held(numbers, layout, z, placed)
        X, along = holds.X[placed], holds.frame.along[placed]
        yield HeldAcross(on, s, numbers.across_force, element, X, along, holds.lift[placed], ramp)


def arms(numbers: Numbering, layout: Layout, z: FloatArray, ramp: Ramp) -> Arms:
    """Return the steady arms whose hinges are given, with wires in the elements that fit z."""
    holds = layout.holds
    hinged = holds.hinged
    on, s, element = _held(numbers, layout, z, hinged)
    arm = holds.hinge[hinged], holds.arm_length[hinged], holds.arm_mass[hinged]
    return Arms(on, s, numbers.arm_density, element, *arm, layout.g, ramp)


def _held(
    numbers: Numbering, layout: Layout, z: FloatArray, mask: Mask
) -> tuple[Strands, IntArray, IntArray]:
    """Return wires, sliding coordinates and elements at some of the holds."""
    on, s = Strands.on(numbers.wires, layout.holds.wire[mask]), numbers.hold_s[mask]
    return on, s, on.locate(z[s])


def _rollers(
    numbers: Numbering, layout: Layout, z: FloatArray, mask: Mask, nodes: IntArray | None
) -> Supports:
    holds = layout.holds
    on, s, element = _held(numbers, layout, z, mask)
    left = across(holds.frame)[mask]
    sideways, vertical = holds.compliance[mask].T
    compliance = sideways[:, None, None] * left[:, :, None] * left[:, None, :]
    compliance[:, 2, 2] += vertical
    force = numbers.roller_force[mask[~holds.guided]]
    return Supports(on, s, force, element, holds.X[mask], compliance, holds.friction[mask], nodes)
