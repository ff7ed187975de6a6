"""What `catenaria solve` says of a line in space besides its tables: wires, steady arms, odd droppers."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

from catenaria.errors import some

if TYPE_CHECKING:
    from catenaria.results import Droppers, FormResult


def space_lines(result: FormResult) -> list[str]:
    """Return what there is to say of a line in space, in lines of text; nothing of a plane one."""
    if not result.spatial:
        return []
    return [_wire_line(result), *_arm_lines(result), *_dropper_lines(result.droppers)]


def _wire_line(result: FormResult) -> str:
    roles = Counter(wire.role for wire in result.wires)
    parts = [role if count == 1 else f"{count} {role}s" for role, count in roles.items()]
    return f"{len(result.wires)} wires: {', '.join(parts)}."


def _arm_lines(result: FormResult) -> list[str]:
    arms = result.arms
    if not arms.support:
        return []
    i = int(np.argmin(arms.pull))
    weakest = f"{arms.pull[i]:.1f} N at {arms.support[i]} ({arms.wire[i]}, {arms.registration[i]})"
    lines = [f"{len(arms.support)} steady arms: weakest radial force {weakest}."]
    wrong = np.flatnonzero(~arms.enough)
    if wrong.size:
        named = (f"{arms.support[k]} {arms.radial[k]:.1f} N ({arms.registration[k]})" for k in wrong)
        lines.append(
            "Caution: steady arms that do not bear what they are for, or less radial force than is wanted "
            f"(tension positive): {some(list(named))}."
        )
    pushed = np.flatnonzero(arms.enough & (arms.radial < 0.0))
    if pushed.size:
        named = (f"{arms.support[k]} {arms.radial[k]:.1f} N ({arms.registration[k]})" for k in pushed)
        lines.append(
            "Caution: steady arms in compression, although hinged arms are built for tension; `side` says "
            f"where the hinge is: {some(list(named))}."
        )
    return lines


def _dropper_lines(droppers: Droppers) -> list[str]:
    if not droppers.x.size:
        return []
    angle = np.degrees(droppers.inclination)
    i = int(np.argmax(angle))
    lines = [f"Largest inclination of a dropper: {angle[i]:.2f} degrees ({_name(droppers, i)})."]
    slack = np.flatnonzero(droppers.slack)
    if slack.size:
        named = [_name(droppers, int(k)) for k in slack]
        lines.append(f"Caution: {slack.size} slack droppers, which lift nothing: {some(named)}.")
    return lines


def _name(droppers: Droppers, i: int) -> str:
    return f"span {droppers.span[i]}, dropper {droppers.number[i]} of the {droppers.lower_wire[i]}"
