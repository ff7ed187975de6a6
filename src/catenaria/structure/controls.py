"""From the description of controls to their contributions."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from catenaria.line.control import DropperForceControl, HeightControl, TensionControl
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.controls.balance import ForceBalance
from catenaria.mechanics.controls.control import Controls, Measure
from catenaria.mechanics.controls.measures import Height, ReactionTension, StrainTension, WireHeight
from catenaria.mechanics.controls.pull import Pull
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.loads.gravity import Ramp
from catenaria.structure.assembly import JointNumbers, node_of
from catenaria.structure.checks import joints_with_other_cables
from catenaria.structure.control import BalanceTarget, TensionTarget
from catenaria.structure.structure import Structure

FloatArray = NDArray[np.float64]

_AT_ONCE = Ramp(0.0)


def control_contributions(
    structure: Structure,
    joints: tuple[JointNumbers, ...],
    chains: Mapping[str, Chain],
    z: FloatArray,
    parameter: Mapping[str, int],
    ramp: Ramp,
) -> tuple[Controls, ...]:
    """Return the controls of a structure: tensions, heights, balances.

    Notes
    -----
    The velocities of tension and height controls grow with gravity, because the structure rests at the
    start; those of balances need not, because the forces grow with gravity themselves.
    """
    at = {numbers.name: numbers for numbers in joints}

    def control(
        name: str, measure: Measure, target: float, law: TensionControl | HeightControl | DropperForceControl
    ) -> Controls:
        velocity_law = VelocityLaw(law.velocity, law.dead_band, law.saturation)
        velocity_ramp = _AT_ONCE if name in structure.balances else ramp
        index = np.array([parameter[name]])
        return Controls(index, measure, np.array([target]), velocity_law, velocity_ramp, _AT_ONCE)

    return (
        *(control(n, _tension(at[c.joint], c, z), c.force, c.law) for n, c in structure.tensions.items()),
        *(control(n, _height(at[c.joint], chains, z), c.height, c.law) for n, c in structure.heights.items()),
        *(
            control(n, _balance(structure, c, at, chains, ramp), 0.0, c.law)
            for n, c in structure.balances.items()
        ),
    )


def _tension(at: JointNumbers, target: TensionTarget, z: FloatArray) -> Measure:
    if target.measure == "strain":
        return StrainTension(at.wire, at.s, at.wire.locate(z[at.s]))
    if target.measure == "pull":
        direction = np.array([target.move[target.joint]])
        return Pull(at.force[None, :], direction / np.linalg.norm(direction))
    outwards = -1.0 if at.joint.on.point == "start" else 1.0
    slope = at.wire.evaluate(z, at.coordinate(z)).r1
    return ReactionTension(at.force[None, :], outwards * slope / np.linalg.norm(slope))


def _height(at: JointNumbers, chains: Mapping[str, Chain], z: FloatArray) -> Measure:
    if not at.joint.slides:
        return Height(node_of(chains, at.joint.on)[2:3])
    if at.joint.to is not None:
        return Height(node_of(chains, at.joint.to)[2:3])
    return WireHeight(at.wire, at.s, at.wire.locate(z[at.s]))


def _balance(
    structure: Structure,
    balance: BalanceTarget,
    at: Mapping[str, JointNumbers],
    chains: Mapping[str, Chain],
    ramp: Ramp,
) -> Measure:
    joined = [next(joints_with_other_cables(structure, half)) for half in balance.halves]
    nodes = [node_of(chains, point) for _, point, _ in joined]
    hung = [
        mass.mass
        for mass in structure.masses.values()
        if any(np.array_equal(node_of(chains, mass.on), node) for node in nodes)
    ]
    return ForceBalance(
        force=np.array([[at[name].force[2] for name, _, _ in joined]]),
        sign=np.array([[sign for _, _, sign in joined]]),
        end=np.array([[node[2] for node in nodes]]),
        rhoA=np.array([chains[balance.halves[0]].section.rhoA]),
        mass=np.array([sum(hung)]),
        g=structure.gravity,
        ramp=ramp,
    )
