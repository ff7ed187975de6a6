"""From a state of a structure back to named values."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.history import control_errors
from catenaria.discretise.read_back import element_tension, profile, stretched_length
from catenaria.formfinding.versions import versions
from catenaria.mechanics.chain import Chain
from catenaria.results.form import Controls, Counters
from catenaria.results.structure import CableForm, Joints, StructureForm, StructureHistory
from catenaria.solvers.outcome import Solution
from catenaria.structure.assembly import JointNumbers
from catenaria.structure.model import StructureModel

FloatArray = NDArray[np.float64]


def structure_form(
    model: StructureModel,
    method: str,
    reason: str,
    rest: tuple[float, FloatArray],
    counters: Counters,
    histories: tuple[StructureHistory, ...] = (),
) -> StructureForm:
    """Gather what was found.

    Parameters
    ----------
    model : StructureModel
        What was brought to rest.
    method, reason : str
        Name of the method, and why it stopped.
    rest : tuple of float and FloatArray
        Time [s] and unknowns.
    counters, histories
        Work, and the course of a dynamic run.
    """
    t, z = rest
    return StructureForm(
        name=model.structure.name,
        method=method,
        stop_reason=reason,
        cables=tuple(_cable_form(name, chain, z) for name, chain in model.chains.items()),
        joints=_joints(model.joints, z),
        controls=_controls(model, t, z, exact=not histories),
        histories=histories,
        counters=counters,
        unknowns=z,
        inputs=model.structure.model_dump(mode="json"),
        versions=versions(),
    )


def _cable_form(name: str, chain: Chain, z: FloatArray) -> CableForm:
    length = float(chain.knots[-1])
    return CableForm(
        name=name,
        unstressed_length=length,
        stretched_length=stretched_length(chain, z, 0.0, length),
        s=chain.knots,
        position=z[chain.nodes[:, :3]],
        slope=z[chain.nodes[:, 3:]],
        tension=element_tension(chain, z),
        profile=profile(chain, z),
    )


def _joints(joints: tuple[JointNumbers, ...], z: FloatArray) -> Joints:
    return Joints(
        name=tuple(at.name for at in joints),
        type=tuple(at.joint.type for at in joints),
        position=np.array([at.point(z) for at in joints]).reshape(-1, 3),
        force=np.array([z[at.force] for at in joints]).reshape(-1, 3),
        coordinate=np.array([at.coordinate(z)[0] for at in joints]),
        strain_tension=np.array([_strain_tension(at, z) for at in joints]),
    )


def _strain_tension(at: JointNumbers, z: FloatArray) -> float:
    r1 = at.wire.evaluate(z, at.coordinate(z)).r1[0]
    return 0.5 * at.wire.section.EA * float(r1 @ r1 - 1.0)


def _units(model: StructureModel) -> tuple[str, ...]:
    return tuple("m" if name in model.structure.heights else "N" for name in model.parameter)


_MET = {"N": 1e-3, "m": 1e-6}  # within which the direct method meets its targets


def _controls(model: StructureModel, t: float, z: FloatArray, exact: bool) -> Controls:
    controls, units = model.controls(model.system), _units(model)
    target = np.array([float(control.target[0]) for control in controls])
    error = control_errors(controls, t, z) if controls else np.empty(0)
    bands = [_MET[u] if exact else c.law.e0 for u, c in zip(units, controls, strict=True)]
    parameter = z[np.array(list(model.parameter.values()), dtype=np.int64)]
    return Controls(tuple(model.parameter), units, target, target + error, error, np.array(bands), parameter)


def structure_history(model: StructureModel, solution: Solution) -> StructureHistory:
    """Return controls, joints and energies at every accepted time step."""
    steps = list(zip(solution.t.tolist(), solution.y, solution.yd, strict=True))
    controls = model.controls(model.system)
    target = np.array([float(control.target[0]) for control in controls])
    index = np.array(list(model.parameter.values()), dtype=np.int64)
    joints = [_joints(model.joints, z) for _, z, _ in steps]
    errors = [control_errors(controls, t, z) if controls else np.empty(0) for t, z, _ in steps]
    energies = np.array([model.elements.energies(z).sum(axis=0) for _, z, _ in steps])
    return StructureHistory(
        time=solution.t,
        step_size=solution.h,
        order=solution.order,
        control_name=tuple(model.parameter),
        control_unit=_units(model),
        value=np.array(errors).reshape(len(steps), -1) + target,
        parameter=solution.y[:, index],
        velocity=solution.yd[:, index],
        joint_name=tuple(at.name for at in model.joints),
        joint_position=np.array([joint.position for joint in joints]),
        joint_force=np.array([joint.force for joint in joints]),
        joint_strain_tension=np.array([joint.strain_tension for joint in joints]),
        kinetic=np.array([model.inertia.kinetic_energy(zd) for _, _, zd in steps]),
        axial=energies[:, 0],
        bending=energies[:, 1],
    )
