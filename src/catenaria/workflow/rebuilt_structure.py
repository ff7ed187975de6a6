"""A free structure as it would be built from what was found: cables of the found lengths, no controls.

Yang et al. 2017 do this with their second example (Fig. 19) and let the structure come to rest by itself.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from catenaria.results.structure import StructureForm
from catenaria.structure import Structure

_LOWERED = 0.01  # m by which joints between cables start below the place where they were found
_REST = 1e-5  # m/s


def rebuilt_structure(structure: Structure, form: StructureForm) -> Structure:
    """Return a structure of the found cables, which has to find its form by itself.

    Parameters
    ----------
    structure : Structure
        What was described.
    form : StructureForm
        What was found for it.

    Returns
    -------
    Structure
        Without controls. The halves of a cable of unknown length are one cable of the found length. Every
        cable is laid out straight from joint to joint, and joints between cables start 10 mm too low.
    """
    data = structure.model_dump(mode="json")
    for group in ("tensions", "heights", "balances"):
        data[group] = {}
    for name, balance in structure.balances.items():
        _join_halves(data, form, name, balance.halves)
    for name in structure.cables:
        if name in data["cables"]:
            _lay_out(data, form, name)
    data["solver"]["settle"]["velocity"] = _REST
    return Structure.model_validate(data)


def _join_halves(data: dict[str, Any], form: StructureForm, name: str, halves: tuple[str, str]) -> None:
    """Put one cable in the place of an upper and a lower half, from the lower joint to the upper one."""
    upper, lower = halves
    cables, joints = data["cables"], data["joints"]
    ends = {joint["to"]["cable"]: key for key, joint in joints.items() if joint["to"] is not None}
    points = [_found(form, data, ends[half]) for half in (lower, upper)]
    half = form.cable(lower)
    cable = cables.pop(lower)
    del cables[upper]
    for key in [key for key, joint in joints.items() if joint["on"]["cable"] in halves]:
        del joints[key]
    for half_name, point in ((lower, "start"), (upper, "end")):
        joints[ends[half_name]]["to"] = {"cable": name, "point": point}
    distance = float(np.linalg.norm(form.position(ends[upper]) - form.position(ends[lower])))
    length = distance * half.unstressed_length / half.stretched_length
    cables[name] = cable | {"points": points, "unstressed_length": length}


def _lay_out(data: dict[str, Any], form: StructureForm, name: str) -> None:
    """Lay a cable out through the joints on it, and tell the joints where on it they are then."""
    on = {key: joint for key, joint in data["joints"].items() if joint["on"]["cable"] == name}
    inner = [key for key, joint in on.items() if joint["on"]["point"] not in ("start", "end")]
    inner.sort(key=lambda key: form.joints.coordinate[form.joints.name.index(key)])
    ends = form.cable(name).position[[0, -1]].tolist()
    points = [ends[0], *(_found(form, data, key) for key in inner), ends[1]]
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    length = form.cable(name).unstressed_length
    data["cables"][name] |= {"points": points, "unstressed_length": length}
    for key, place in zip(inner, along[1:-1].tolist(), strict=True):
        on[key]["on"]["point"] = place / float(along[-1]) * length


def _found(form: StructureForm, data: dict[str, Any], joint: str) -> list[float]:
    """Return where a joint was found, lower if it is not one with the ground [m]."""
    lowered = 0.0 if data["joints"][joint]["to"] is None else _LOWERED
    return (form.position(joint) - [0.0, 0.0, lowered]).tolist()
