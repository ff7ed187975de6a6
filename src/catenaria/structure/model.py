"""The system of a structure, and where to find things in it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import InconsistentInputError
from catenaria.line.conductor import Conductor
from catenaria.mechanics.chain import Chain, Section
from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.loads.linear import Inertia, RayleighDamping, assemble, point_masses
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind, Unknowns, UnknownsBuilder
from catenaria.structure.assembly import JointNumbers, hold, joint_contributions, node_of
from catenaria.structure.controls import control_contributions
from catenaria.structure.layout import lay_out
from catenaria.structure.mesh import knots
from catenaria.structure.section import Stiffnesses
from catenaria.structure.structure import Structure

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class StructureModel:
    """The system of a structure and its index table.

    Attributes
    ----------
    structure : Structure
        What was modelled.
    system : System
        At its starting configuration.
    chains : dict of str to Chain
        Cables by name.
    elements, inertia : CableElements, Inertia
        Contributions that know the energies.
    joints : tuple of JointNumbers
        Joints in the order of the structure.
    parameter : dict of str to int
        Index of each control's parameter, by name of the control.
    ramp_time : float
        Until when gravity and control velocities grow [s].
    """

    structure: Structure
    system: System
    chains: dict[str, Chain]
    elements: CableElements
    inertia: Inertia
    joints: tuple[JointNumbers, ...]
    parameter: dict[str, int]
    ramp_time: float

    @property
    def name(self) -> str:
        """Name of the structure, for messages."""
        return self.structure.name or "structure"

    def controls(self, system: System) -> tuple[Controls, ...]:
        """Return the controls in the order of `parameter`, with the discrete state of the given system."""
        return tuple(part for part in system.contributions if isinstance(part, Controls))

    @cached_property
    def start(self) -> FloatArray:
        """Unknowns at the start, shape (n,)."""
        return self.system.unknowns.start


def build_structure(structure: Structure, ramp_time: float = 0.0) -> StructureModel:
    """Build the system of a structure at its start.

    Parameters
    ----------
    structure : Structure
        What the researcher describes.
    ramp_time : float
        In which gravity and control velocities grow [s]; 0 for statics.

    Returns
    -------
    StructureModel

    Raises
    ------
    InconsistentInputError
        If there is no cable.
    """
    if not structure.cables:
        raise InconsistentInputError("a structure needs at least one cable")
    builder = UnknownsBuilder()
    chains = {name: _chain(structure, name, builder) for name in structure.cables}
    joints = tuple(JointNumbers.of(name, joint, chains, builder) for name, joint in structure.joints.items())
    parameter = {name: int(builder.add(Kind.PARAMETER, [0.0])[0]) for name in structure.controls}
    unknowns = _with_ground(builder.build(), joints, chains)
    z, ramp = unknowns.start, Ramp(ramp_time)
    elements = CableElements.of(list(chains.values()), structure.solver.gauss_points)
    inertia, damping, gravity = _loads(structure, elements, chains, z, ramp)
    joined = tuple(part for at in joints for part in joint_contributions(at, chains, z))
    held = hold(joints, chains, z, _moves(structure, parameter))
    controls = control_contributions(structure, joints, chains, z, parameter, ramp)
    system = System(unknowns, (elements, inertia, *damping, gravity, *joined, held, *controls))
    return StructureModel(structure, system, chains, elements, inertia, joints, parameter, ramp_time)


def _chain(structure: Structure, name: str, builder: UnknownsBuilder) -> Chain:
    cable, s = structure.cables[name], knots(structure, name)
    return Chain(builder.add_nodes(*lay_out(cable, s)), s, _section(structure, cable.section))


def _section(structure: Structure, name: str) -> Section:
    section: Conductor | Stiffnesses = structure.sections[name]
    return Section(section.EA, section.EJ, section.rhoA)


def _with_ground(unknowns: Unknowns, joints: tuple[JointNumbers, ...], chains: dict[str, Chain]) -> Unknowns:
    """Return the table with the nodes of the ground where the cables fixed to it are."""
    start = unknowns.start.copy()
    for at in joints:
        if at.ground.size:
            start[at.ground[:6]] = start[node_of(chains, at.joint.on)]
    return Unknowns(unknowns.kind, start)


def _moves(structure: Structure, parameter: dict[str, int]) -> dict[str, tuple[int, FloatArray]]:
    return {
        joint: (parameter[name], np.array(direction) / np.linalg.norm(direction))
        for name, control in structure.controls.items()
        for joint, direction in control.move.items()
    }


def _loads(
    structure: Structure, elements: CableElements, chains: dict[str, Chain], z: FloatArray, ramp: Ramp
) -> tuple[Inertia, tuple[RayleighDamping, ...], Gravity]:
    loaded = [node_of(chains, mass.on)[:3] for mass in structure.masses.values()]
    masses = np.array([mass.mass for mass in structure.masses.values()])
    point_mass, point_weight = point_masses(np.array(loaded, dtype=np.int64).reshape(-1, 3), masses, z.size)
    M = assemble(elements, elements.mass(), z.size) + point_mass
    rayleigh = structure.solver.damping
    damping = ()
    if rayleigh.mass or rayleigh.stiffness:
        K = assemble(elements, elements.stiffness(z), z.size)
        damping = (RayleighDamping(rayleigh.mass * M + rayleigh.stiffness * K),)
    heavy = [chain for name, chain in chains.items() if structure.cables[name].weight]
    weight = CableElements.of(heavy).weight(z.size) if heavy else np.zeros(z.size)
    return Inertia(M), damping, Gravity(weight + point_weight, structure.gravity, ramp)
