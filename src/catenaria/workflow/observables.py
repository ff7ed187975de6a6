"""The quantities that validation cases compare: functions from a result to numbers in SI."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]
Observable = Callable[[FormResult, Sequence[str]], FloatArray]


def observe(result: FormResult, quantity: str, of: Sequence[str]) -> FloatArray:
    """Return the numbers of a quantity [SI].

    Parameters
    ----------
    result : FormResult
        What was found for a line.
    quantity : str
        One of the names in `OBSERVABLES`.
    of : sequence of str
        Numbers of droppers, where the quantity has one for each; dotted paths of inputs. Empty for all.

    Raises
    ------
    InconsistentInputError
        If there is no such quantity.
    """
    if quantity not in OBSERVABLES:
        raise InconsistentInputError(f"there is no quantity {quantity!r}; there is {', '.join(OBSERVABLES)}")
    return np.atleast_1d(OBSERVABLES[quantity](result, of)).astype(np.float64)


def input_values(inputs: Mapping[str, Any], paths: Sequence[str]) -> FloatArray:
    """Return what stands in a description at dotted paths [SI]."""

    def at(path: str) -> float:
        place: Any = inputs
        for step in path.split("."):
            place = place[step]
        return float(place)

    return np.array([at(path) for path in paths])


def _chosen(values: FloatArray, of: Sequence[str]) -> FloatArray:
    """Return the values of the droppers with the given numbers, counted along the line from 1."""
    return values[[int(number) - 1 for number in of]] if of else values


def _intervals(result: FormResult, of: Sequence[str]) -> FloatArray:
    """Return the distances between neighbouring droppers, the first one from the first support."""
    return _chosen(np.diff(np.concatenate(([result.supports.x.min()], result.droppers.x))), of)


def _cable_tops(result: FormResult, of: Sequence[str]) -> FloatArray:
    """Return the tension at the top of the lower dropper cables, by which they are held in the first step.

    In a `Stage` the multipliers of supports and clamps come before those of the far dropper ends.
    """
    held, n = result.supports.wire.count(result.wires[0].name), result.droppers.x.size
    force = result.stages[0].multiplier.reshape(-1, 3)[held + n : held + 2 * n]
    return _chosen(np.linalg.norm(force, axis=1), of)


def _first(values: FloatArray, equal: float) -> FloatArray:
    """Return the number, from 1, of the smallest value; of those that are as small, the first one."""
    return np.array(1.0 + np.flatnonzero(values <= values.min() + equal)[0])


OBSERVABLES: dict[str, Observable] = {
    "input": lambda result, of: input_values(result.inputs, of),
    "audit findings": lambda result, _: np.array(float(len(result.audit.findings))),
    "dropper interval": _intervals,
    "dropper length": lambda result, of: _chosen(result.droppers.length, of),
    "force on contact wire": lambda result, of: _chosen(result.droppers.force_bottom, of),
    "tension of lower dropper cable": _cable_tops,
    "height of upper clamp": lambda result, of: _chosen(result.droppers.messenger_height, of),
    "height error": lambda result, of: _chosen(result.droppers.height_error, of),
    "number of the most loaded dropper": lambda result, _: _first(-_cable_tops(result, ()), 1e-3),
    "number of the shortest dropper": lambda result, _: _first(result.droppers.length, 1e-6),
    "contact-wire sag": lambda result, _: np.array(result.wires[0].sag),
    "measured tension": lambda result, _: np.array([wire.tension for wire in result.wires]),
    "mean messenger tension": lambda result, _: np.array(result.wires[1].tension_mean),
    "messenger reaction": lambda result, _: np.array(result.wires[1].reaction_end),
}
