"""What droppers are called: hangers, if they hang from the auxiliary messenger of a compound line."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.results import FormResult


def are_hangers(result: FormResult) -> NDArray[np.bool_]:
    """Return which droppers hang from an auxiliary messenger; they have numbers of their own."""
    roles = {wire.name: wire.role for wire in result.wires}
    upper = [roles[name] for name in result.droppers.upper_wire]
    return np.array([role == "auxiliary messenger" for role in upper], dtype=np.bool_)


def dropper_names(result: FormResult) -> list[str]:
    """Return the names of all droppers by span and number, as ``dropper 2.1`` and ``hanger 2.1``."""
    droppers = result.droppers
    return [
        f"{'hanger' if hangs else 'dropper'} {span}.{number}"
        for hangs, span, number in zip(are_hangers(result), droppers.span, droppers.number, strict=True)
    ]


def dropper_place(result: FormResult, i: int) -> str:
    """Return where a dropper is, as ``span 2, dropper 1``."""
    kind = "hanger" if are_hangers(result)[i] else "dropper"
    return f"span {result.droppers.span[i]}, {kind} {result.droppers.number[i]}"
