"""What the line file asked for, read anew from the echo of it that a result holds."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Inputs = dict[str, Any]


@dataclass(frozen=True)
class Conductor:
    """A cross-section: name, EA [N], EJ [N m^2] and mass per unstressed length [kg/m]."""

    name: str
    EA: float
    EJ: float
    rhoA: float


@dataclass(frozen=True)
class StatedWire:
    """A wire: its conductor, where it is held, and its prescribed tension.

    Attributes
    ----------
    name : str
        ``contact wire`` or ``messenger wire``.
    conductor : Conductor
        Cross-section.
    support_name : tuple of str
        The m supports that hold it.
    support : FloatArray, shape (m, 3)
        Where they hold it [m].
    tail : float
        Unstressed length beyond the first and the last support before the ends were pulled [m].
    tension : float
        Prescribed tension [N].
    measure : str
        ``reaction`` or ``strain``.
    at_end : bool
        Whether it is measured at the wire's end instead of its start.
    """

    name: str
    conductor: Conductor
    support_name: tuple[str, ...]
    support: FloatArray
    tail: float
    tension: float
    measure: str
    at_end: bool


@dataclass(frozen=True)
class StatedDroppers:
    """All droppers: places [m], wanted heights [m], conductor, joint, clamp masses [kg] and heights [m]."""

    x: FloatArray
    target_height: FloatArray
    conductor: Conductor
    guided: bool
    mass_top: float
    mass_bottom: float
    clamp_heights: float


@dataclass(frozen=True)
class Stated:
    """The line: gravity [m/s^2], the two wires, the droppers."""

    gravity: float
    wires: tuple[StatedWire, StatedWire]
    droppers: StatedDroppers


def read_inputs(inputs: Inputs) -> Stated:
    """Return what the line file asked for.

    Parameters
    ----------
    inputs : dict
        Echo of the line file in a result, all values in SI.
    """
    contact, messenger = (_wire(inputs, name) for name in ("contact wire", "messenger wire"))
    return Stated(float(inputs["gravity"]), (contact, messenger), _droppers(inputs))


def _support_x(inputs: Inputs) -> FloatArray:
    lengths = (span["length"] for span in inputs["spans"])
    return np.array(list(accumulate(lengths, initial=inputs["start_chainage"])), dtype=np.float64)


def _wire(inputs: Inputs, name: str) -> StatedWire:
    key = name.replace(" ", "_")
    wire, supports = inputs[key], inputs["supports"]
    held = [i for i, support in enumerate(supports) if support[key] is not None]
    height = [_height(supports[i], key) for i in held]
    tension = wire["tension"]
    return StatedWire(
        name=name,
        conductor=_conductor(inputs, wire["conductor"]),
        support_name=tuple(supports[i]["name"] for i in held),
        support=np.column_stack((_support_x(inputs)[held], np.zeros(len(held)), height)),
        tail=wire["tail"],
        tension=tension["force"],
        measure=tension["measure"],
        at_end=tension["at"] == "end",
    )


def _height(support: Inputs, key: str) -> float:
    """Return the height of a wire at a support, which an encumbrance counts from the contact wire."""
    height = support[key]["height"]
    return support["contact_wire"]["height"] + support[key]["encumbrance"] if height is None else height


def _conductor(inputs: Inputs, name: str) -> Conductor:
    data = inputs["conductors"][name]
    rhoA = data["mass_per_length"]
    if rhoA is None:
        rhoA = data["density"] * data["area"]
    return Conductor(name, data["youngs_modulus"] * data["area"], data["bending_stiffness"], rhoA)


def _droppers(inputs: Inputs) -> StatedDroppers:
    kind = inputs["dropper"]
    x: list[float] = []
    height: list[float] = []
    for start, span in zip(_support_x(inputs), inputs["spans"], strict=False):
        places = _places(span["droppers"])
        x += [start + place for place in places]
        wanted = span["contact_wire_height"]
        height += wanted if isinstance(wanted, list) else [wanted] * len(places)
    return StatedDroppers(
        x=np.array(x),
        target_height=np.array(height),
        conductor=_conductor(inputs, kind["conductor"]),
        guided=kind["joint"] == "guided",
        mass_top=kind["clamp_mass_top"],
        mass_bottom=kind["clamp_mass_bottom"],
        clamp_heights=kind["clamp_height_top"] + kind["clamp_height_bottom"],
    )


def _places(droppers: Inputs) -> list[float]:
    if droppers["positions"] is not None:
        return list(droppers["positions"])
    return [droppers["first"] + i * droppers["spacing"] for i in range(droppers["count"])]
