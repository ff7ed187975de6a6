"""From the line file to the numbers of each step."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import Grading
from catenaria.discretise.wire_setup import DropperSetup, TensionSetup, WireSetup
from catenaria.line import Conductor, Line, TensionControl, Wire
from catenaria.mechanics.chain import Section
from catenaria.mechanics.controls.velocity_law import VelocityLaw
from catenaria.mechanics.loads.gravity import Ramp

FloatArray = NDArray[np.float64]


def contact_wire_setup(line: Line) -> WireSetup:
    """Return the first step: contact wire with lower dropper cables, tension and height control."""
    law = line.solver.dynamic.height
    droppers = _droppers(
        line,
        up=True,
        clamp_mass=line.dropper.clamp_mass_bottom,
        target=np.array(line.dropper_target_height),
        law=VelocityLaw(law.velocity, law.dead_band, law.saturation),
        foot=(np.array(line.dropper_x), np.zeros(len(line.dropper_x))),
    )
    held = [support for support in line.supports if support.contact_wire is not None]
    height = held[0].contact_wire.height if held[0].contact_wire else 0.0
    x = np.array(line.support_x)[list(line.contact_support_indices)]
    return _setup(
        line, line.contact_wire, "contact wire", x, height, line.solver.dynamic.contact_tension, droppers
    )


def messenger_wire_setup(
    line: Line, foot_force: FloatArray, foot_height: FloatArray, foot_x: FloatArray | None = None
) -> WireSetup:
    """Return the second step: messenger wire with upper dropper cables, tension control and (23).

    Parameters
    ----------
    line : Line
        The line.
    foot_force : FloatArray, shape (n,)
        Forces T_cd that the droppers exert on the contact wire [N].
    foot_height : FloatArray, shape (n,)
        Heights of P_cd [m].
    foot_x : FloatArray, shape (n,), optional
        Where they are along the track [m], where the droppers are if this is not given.
    """
    law = line.solver.dynamic.dropper_force
    droppers = _droppers(
        line,
        up=False,
        clamp_mass=line.dropper.clamp_mass_top,
        target=foot_force,
        law=VelocityLaw(law.velocity, law.dead_band, law.saturation),
        foot=(np.array(line.dropper_x) if foot_x is None else foot_x, foot_height),
    )
    height = line.supports[0].messenger_height
    x = np.array(line.support_x)
    return _setup(
        line,
        line.messenger_wire,
        "messenger wire",
        x,
        height,
        line.solver.dynamic.messenger_tension,
        droppers,
    )


def section(conductor: Conductor) -> Section:
    """Return the cross-section of a conductor."""
    return Section(conductor.EA, conductor.EJ, conductor.rhoA)


def _droppers(
    line: Line,
    *,
    up: bool,
    clamp_mass: float,
    target: FloatArray,
    law: VelocityLaw,
    foot: tuple[FloatArray, FloatArray],
) -> DropperSetup:
    kind = line.dropper
    return DropperSetup(
        x=np.array(line.dropper_x),
        up=up,
        length=kind.guessed_length,
        elements=kind.elements,
        section=section(line.conductor(kind.conductor)),
        clamp_mass=clamp_mass,
        guided=kind.joint == "guided",
        target=target,
        law=law,
        foot_x=foot[0],
        foot_height=foot[1],
        clamps_mass=kind.clamp_mass_top + kind.clamp_mass_bottom,
    )


def _setup(
    line: Line,
    wire: Wire,
    name: str,
    x: FloatArray,
    height: float,
    law: TensionControl,
    droppers: DropperSetup,
) -> WireSetup:
    dynamic, mesh = line.solver.dynamic, line.solver.mesh
    return WireSetup(
        name=name,
        section=section(line.conductor(wire.conductor)),
        support_x=x,
        height=height,
        tail=wire.tail,
        tension=TensionSetup(
            wire.tension.force,
            wire.tension.measure,
            wire.tension.at == "end",
            VelocityLaw(law.velocity, law.dead_band, law.saturation),
        ),
        droppers=droppers,
        grading=Grading(tuple(mesh.fine), mesh.largest_element, mesh.refine, mesh.even),
        gauss_points=mesh.gauss_points,
        g=line.gravity,
        gravity_ramp=Ramp(dynamic.ramp_time),
        control_ramp=Ramp(dynamic.ramp_time),
        damping=(dynamic.damping.mass, dynamic.damping.stiffness),
    )
