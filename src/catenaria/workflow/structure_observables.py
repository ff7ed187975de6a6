"""The quantities of free structures that validation cases compare: functions from a form to numbers in SI."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.results.structure import CableForm, StructureForm
from catenaria.workflow.observables import input_values

FloatArray = NDArray[np.float64]


def observe_structure(form: StructureForm, quantity: str, of: Sequence[str]) -> FloatArray:
    """Return the numbers of a quantity [SI].

    Parameters
    ----------
    form : StructureForm
        What was found for a structure.
    quantity : str
        One of the names in `STRUCTURE_OBSERVABLES`.
    of : sequence of str
        Names of joints or cables, one for each number; pairs of joints for a rise; paths of inputs.

    Raises
    ------
    InconsistentInputError
        If there is no such quantity or joint.
    """
    if quantity not in STRUCTURE_OBSERVABLES:
        known = ", ".join(STRUCTURE_OBSERVABLES)
        raise InconsistentInputError(f"there is no quantity {quantity!r} of structures; there is {known}")
    return STRUCTURE_OBSERVABLES[quantity](form, of)


def _forces(form: StructureForm, joints: Sequence[str]) -> FloatArray:
    """Return the sizes of the forces that joints bear [N]."""
    return np.array([float(np.linalg.norm(form.force(joint))) for joint in joints])


def _heights(form: StructureForm, joints: Sequence[str]) -> FloatArray:
    return np.array([form.position(joint)[2] for joint in joints])


def _rise(form: StructureForm, joints: Sequence[str]) -> FloatArray:
    """Return how much higher the second joint of each pair is than the first: the paper's lengths [m]."""
    height = _heights(form, joints)
    return height[1::2] - height[::2]


def _strain_tensions(form: StructureForm, joints: Sequence[str]) -> FloatArray:
    return form.joints.strain_tension[[form.joints.name.index(joint) for joint in joints]]


def _mean_tension(cable: CableForm) -> float:
    """Return the mean of the axial force over a cable [N]."""
    return float(np.average(cable.tension, weights=np.diff(cable.s)))


STRUCTURE_OBSERVABLES: dict[str, Callable[[StructureForm, Sequence[str]], FloatArray]] = {
    "input": lambda form, of: input_values(form.inputs, of),
    "joint place along x": lambda form, of: np.array([form.position(joint)[0] for joint in of]),
    "joint force": _forces,
    "joint height": _heights,
    "rise between joints": _rise,
    "strain tension at joint": _strain_tensions,
    "mean tension": lambda form, cables: np.array([_mean_tension(form.cable(name)) for name in cables]),
    "simulated time": lambda form, _: np.array([form.counters.simulated_time]),
}
