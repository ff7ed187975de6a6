"""The course of a controlled motion, computed afterwards from the accepted time steps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.read_back import reactions, support_strain_tension
from catenaria.discretise.wire_model import WireModel
from catenaria.mechanics.controls.control import Controls
from catenaria.results.form import History
from catenaria.solvers.outcome import Solution

FloatArray = NDArray[np.float64]


def control_names(model: WireModel) -> tuple[str, ...]:
    """Return the names of the tension control and of the dropper controls."""
    quantity = "height at" if model.setup.droppers.up else "force of"
    droppers = (f"{quantity} dropper {i}" for i in range(1, len(model.droppers.chains) + 1))
    return (f"{model.setup.name} tension", *droppers)


def control_units(model: WireModel) -> tuple[str, ...]:
    """Return the units of the controls' errors."""
    return ("N",) + ("m" if model.setup.droppers.up else "N",) * len(model.droppers.chains)


def control_errors(controls: tuple[Controls, ...], t: float, z: FloatArray) -> FloatArray:
    """Return the errors of all controls in the elements that fit z."""
    return np.concatenate([(control.relocate(z) or control).error(t, z) for control in controls])


def history(model: WireModel, solution: Solution, support_names: tuple[str, ...]) -> History:
    """Return control errors, parameters, tensions and energies (7)-(8) at every accepted time step."""
    controls = model.controls(model.system)
    parameter = np.concatenate([control.parameter for control in controls])
    steps = list(zip(solution.t.tolist(), solution.y, solution.yd, strict=True))
    energies = np.array([model.elements.energies(z).sum(axis=0) for _, z, _ in steps])
    return History(
        step=model.setup.name,
        time=solution.t,
        step_size=solution.h,
        order=solution.order,
        control_name=control_names(model),
        control_unit=control_units(model),
        error=np.array([control_errors(controls, t, z) for t, z, _ in steps]),
        parameter=solution.y[:, parameter],
        velocity=solution.yd[:, parameter],
        joint_name=support_names,
        joint_tension=np.array([support_strain_tension(model, z) for _, z, _ in steps]),
        reaction=np.array([reactions(model, z) for _, z, _ in steps]),
        kinetic=np.array([model.inertia.kinetic_energy(zd) for _, _, zd in steps]),
        axial=energies[:, 0],
        bending=energies[:, 1],
    )
