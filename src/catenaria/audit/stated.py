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
    ends, outwards : FloatArray, shape (2, 3)
        Where its start and end were before they were pulled [m], and the unit vectors in which they are.
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
    ends: FloatArray
    outwards: FloatArray
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


def support_chainages(inputs: Inputs) -> FloatArray:
    """Return where the supports stand along the track [m]."""
    lengths = (span["length"] for span in inputs["spans"])
    return np.array(list(accumulate(lengths, initial=inputs["start_chainage"])), dtype=np.float64)


def _wire(inputs: Inputs, name: str) -> StatedWire:
    key = name.replace(" ", "_")
    wire, supports = inputs[key], inputs["supports"]
    held = [i for i, support in enumerate(supports) if support[key] is not None]
    height = [_height(supports[i], key) for i in held]
    tension = wire["tension"]
    support = np.column_stack((support_chainages(inputs)[held], np.zeros(len(held)), height))
    outwards = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    return StatedWire(
        name=name,
        conductor=read_conductor(inputs, wire["conductor"]),
        support_name=tuple(supports[i]["name"] for i in held),
        support=support,
        ends=support[[0, -1]] + wire["tail"] * outwards,
        outwards=outwards,
        tension=tension["force"] * tension["device"]["efficiency"],
        measure=tension["measure"],
        at_end=tension["at"] == "end",
    )


def _height(support: Inputs, key: str) -> float:
    """Return the height of a wire at a support, which an encumbrance counts from the contact wire."""
    height = support[key]["height"]
    return support["contact_wire"]["height"] + support[key]["encumbrance"] if height is None else height


def read_conductor(inputs: Inputs, name: str) -> Conductor:
    """Return the cross-section with a name in the line file."""
    return conductor_of(name, inputs["conductors"][name])


def conductor_of(name: str, data: dict[str, Any]) -> Conductor:
    """Return a cross-section from its data in the line file."""
    rhoA = data["mass_per_length"]
    if rhoA is None:
        rhoA = data["density"] * data["area"]
    return Conductor(name, data["youngs_modulus"] * data["area"], data["bending_stiffness"], rhoA)


def _droppers(inputs: Inputs) -> StatedDroppers:
    kind = inputs["dropper"]
    x: list[float] = []
    height: list[float] = []
    for i, (start, span) in enumerate(zip(support_chainages(inputs), inputs["spans"], strict=False)):
        places = dropper_places(span["droppers"])
        x += [start + place for place in places]
        height += wanted_heights(inputs, i).tolist()
    return StatedDroppers(
        x=np.array(x),
        target_height=np.array(height),
        conductor=read_conductor(inputs, kind["conductor"]),
        guided=kind["joint"] == "guided",
        mass_top=kind["clamp_mass_top"],
        mass_bottom=kind["clamp_mass_bottom"],
        clamp_heights=kind["clamp_height_top"] + kind["clamp_height_bottom"],
    )


def dropper_places(droppers: dict[str, Any]) -> list[float]:
    """Return distances of droppers from the beginning of their span [m]."""
    if droppers["positions"] is not None:
        return list(droppers["positions"])
    return [droppers["first"] + i * droppers["spacing"] for i in range(droppers["count"])]


def listed(heights: float | list[float], n: int) -> list[float]:
    """Return n heights of which a line file gives one for all, or a list."""
    return heights if isinstance(heights, list) else [heights] * n


def wanted_heights(inputs: Inputs, i: int) -> FloatArray:
    """Return the wanted heights of the contact wire at the droppers of span i, with its pre-sag [m].

    Notes
    -----
    Heights that are not given are on the line between the nearest supports that hold the contact wire.
    """
    span: Inputs = inputs["spans"][i]
    chainage = support_chainages(inputs)
    x = np.array(dropper_places(span["droppers"]), dtype=np.float64)
    wanted = span["contact_wire_height"]
    if wanted is None:
        contact: list[Inputs | None] = [support["contact_wire"] for support in inputs["supports"]]
        held = np.array([how is not None for how in contact], dtype=np.bool_)
        known = np.array([how["height"] for how in contact if how is not None], dtype=np.float64)
        height = np.interp(float(chainage[i]) + x, chainage[held], known)
    else:
        height = np.array(listed(wanted, x.size), dtype=np.float64)
    share = span["pre_sag_per_mille"]
    depth = span["pre_sag"] if share is None else 1e-3 * share * span["length"]
    if depth == 0.0 or x.size < 3:
        return height
    return height - 4.0 * depth * (x - x[0]) * (x[-1] - x) / (x[-1] - x[0]) ** 2
