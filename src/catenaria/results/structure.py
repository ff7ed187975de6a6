"""The form of a free structure: named arrays in SI units, frozen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.results.form import Controls, Counters, Profile

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class CableForm:
    """What was found for one cable.

    Attributes
    ----------
    name : str
        As in the description.
    unstressed_length, stretched_length : float
        From end to end [m].
    s, position, slope : FloatArray, shape (n,), (n, 3), (n, 3)
        Material coordinate [m], r [m] and r' of every node.
    tension : FloatArray, shape (n - 1,)
        Mean of the true axial force EA eps |r'| over every element [N].
    profile : Profile
        Position and internal forces at several points of each element.
    """

    name: str
    unstressed_length: float
    stretched_length: float
    s: FloatArray
    position: FloatArray
    slope: FloatArray
    tension: FloatArray
    profile: Profile


@dataclass(frozen=True)
class Joints:
    """Where the joints are and what they bear, one entry for each joint.

    Attributes
    ----------
    name, type : tuple of str
        As in the description.
    position : FloatArray, shape (n, 3)
        Where it is [m].
    force : FloatArray, shape (n, 3)
        Force of the cable `on` which it is on the other cable or the ground [N]; guided joints: the first
        component is the force of the guide.
    coordinate : FloatArray, shape (n,)
        Material coordinate of the cable `on` at the joint [m]; changes where it slides.
    strain_tension : FloatArray, shape (n,)
        N = EA eps of eq. (11) at that point of it [N].
    """

    name: tuple[str, ...]
    type: tuple[str, ...]
    position: FloatArray
    force: FloatArray
    coordinate: FloatArray
    strain_tension: FloatArray


@dataclass(frozen=True)
class StructureHistory:
    """The course of a dynamic run, at every accepted time step.

    Attributes
    ----------
    time, step_size, order : FloatArray, FloatArray, IntArray, shape (n_t,)
        Simulated time and step size [s], BDF order.
    control_name, control_unit : tuple of str
        The n_c controls, and the units of what they measure.
    value, parameter, velocity : FloatArray, shape (n_t, n_c)
        Measured quantities [N or m], control parameters [m] and their velocities [m/s].
    joint_name : tuple of str
        The n_j joints.
    joint_position, joint_force : FloatArray, shape (n_t, n_j, 3)
        As in `Joints` [m], [N].
    joint_strain_tension : FloatArray, shape (n_t, n_j)
        As in `Joints` [N].
    kinetic, axial, bending : FloatArray, shape (n_t,)
        Energies (7) and the two terms of (8) [J].
    """

    time: FloatArray
    step_size: FloatArray
    order: IntArray
    control_name: tuple[str, ...]
    control_unit: tuple[str, ...]
    value: FloatArray
    parameter: FloatArray
    velocity: FloatArray
    joint_name: tuple[str, ...]
    joint_position: FloatArray
    joint_force: FloatArray
    joint_strain_tension: FloatArray
    kinetic: FloatArray
    axial: FloatArray
    bending: FloatArray


@dataclass(frozen=True)
class StructureForm:
    """Everything that was found for a structure.

    Attributes
    ----------
    name, method, stop_reason : str
        Name of the structure and of the method, and in words why the computation ended.
    cables : tuple of CableForm
        In the order of the description.
    joints : Joints
        Places and forces.
    controls : Controls
        Targets and how closely they are met; empty without controls.
    histories : tuple of StructureHistory
        One for a dynamic run, none for a static one.
    counters : Counters
        Work.
    unknowns : FloatArray
        All unknowns, in the numbering of `catenaria.structure.model.build_structure`.
    inputs : dict
        Echo of the description, all values in SI.
    versions : dict
        Versions of catenaria, Python, NumPy, SciPy and Numba.
    """

    name: str
    method: str
    stop_reason: str
    cables: tuple[CableForm, ...]
    joints: Joints
    controls: Controls
    histories: tuple[StructureHistory, ...]
    counters: Counters
    unknowns: FloatArray
    inputs: dict[str, Any]
    versions: dict[str, str]

    def cable(self, name: str) -> CableForm:
        """Return what was found for a cable."""
        return self.cables[_place(name, tuple(cable.name for cable in self.cables))]

    def position(self, joint: str) -> FloatArray:
        """Return where a joint is [m], shape (3,)."""
        return self.joints.position[_place(joint, self.joints.name)]

    def force(self, joint: str) -> FloatArray:
        """Return the force of the cable `on` which a joint is on what it is joined to [N], shape (3,)."""
        return self.joints.force[_place(joint, self.joints.name)]

    def parameter(self, control: str) -> float:
        """Return how far a control has moved its held points [m]."""
        return float(self.controls.parameter[_place(control, self.controls.name)])


def _place(name: str, names: tuple[str, ...]) -> int:
    if name not in names:
        raise InconsistentInputError(f"there is no {name!r} among {', '.join(names) or 'none'}")
    return names.index(name)
