"""From the line file to everything that is modelled of a line in space."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from catenaria.discretise.mesh import Grading
from catenaria.discretise.spatial.lay_droppers import lay_droppers
from catenaria.discretise.spatial.lay_holds import lay_cantilevers, lay_holds
from catenaria.discretise.spatial.lay_wires import (
    CONTACT,
    MESSENGER,
    SECOND,
    lay_wires,
    stitch_name,
)
from catenaria.discretise.spatial.layout import LaidMasses, LaidTies, Layout
from catenaria.line import Line
from catenaria.mechanics.controls.velocity_law import VelocityLaw


def lay_out(line: Line) -> Layout:
    """Return all wires of a line and everything that acts on them.

    Parameters
    ----------
    line : Line
        The line.
    """
    frames = line.alignment.frames(np.array(line.support_x))
    wires = lay_wires(line, frames)
    index = {wire.name: i for i, wire in enumerate(wires)}
    holds = lay_holds(line, wires, frames)
    mesh, dynamic = line.solver.mesh, line.solver.dynamic
    return Layout(
        wires=wires,
        holds=holds,
        droppers=lay_droppers(line, index),
        ties=_lay_ties(line, index),
        masses=_lay_masses(line, index),
        cantilevers=lay_cantilevers(line, holds),
        height_law=VelocityLaw(dynamic.height.velocity, dynamic.height.dead_band, dynamic.height.saturation),
        grading=Grading(tuple(mesh.fine), mesh.largest_element, mesh.refine, mesh.even),
        gauss_points=mesh.gauss_points,
        g=line.gravity,
        ramp_time=dynamic.ramp_time,
        damping=(dynamic.damping.mass, dynamic.damping.stiffness),
    )


class _Tie(NamedTuple):
    wire: str
    end: int
    host: str
    chainage: float


def _lay_ties(line: Line, index: Mapping[str, int]) -> LaidTies:
    ties = [*_stitch_ties(line), *_anchor_ties(line)]
    return LaidTies(
        wire=np.array([index[tie.wire] for tie in ties], dtype=np.int64),
        end=np.array([tie.end for tie in ties], dtype=np.int64),
        host=np.array([index[tie.host] for tie in ties], dtype=np.int64),
        frame=line.alignment.frames(np.array([tie.chainage for tie in ties], dtype=np.float64)),
    )


def _stitch_ties(line: Line) -> Iterator[_Tie]:
    """Yield both ends of every stitch wire: on the messenger wire, as far from the support on either side."""
    if line.stitch_wire is not None:
        half = line.stitch_wire.length / 2.0
        for i in line.stitched_supports:
            name, at = stitch_name(line.supports[i]), line.support_x[i]
            yield _Tie(name, 0, MESSENGER, at - half)
            yield _Tie(name, 1, MESSENGER, at + half)


def _anchor_ties(line: Line) -> Iterator[_Tie]:
    """Yield the ends of the mid-point anchors, which come down from the messenger towards the support."""
    if line.mid_point is not None:
        anchor = line.mid_point
        at = next(
            x
            for x, support in zip(line.support_x, line.supports, strict=True)
            if support.name == anchor.support
        )
        yield _Tie("mid-point anchor 1", 0, MESSENGER, at - anchor.reach)
        yield _Tie("mid-point anchor 1", 1, CONTACT, at - anchor.clearance)
        yield _Tie("mid-point anchor 2", 0, CONTACT, at + anchor.clearance)
        yield _Tie("mid-point anchor 2", 1, MESSENGER, at + anchor.reach)


class _Mass(NamedTuple):
    name: str
    wire: str
    chainage: float
    mass: float


def _lay_masses(line: Line, index: Mapping[str, int]) -> LaidMasses:
    """Return the masses of the file and those of the steady arms' clamps, in order of wire and chainage."""
    masses = [_Mass(mass.name, mass.wire, mass.chainage, mass.mass) for mass in line.point_masses]
    masses += _clamps(line)
    masses.sort(key=lambda mass: (index[mass.wire], mass.chainage))
    return LaidMasses(
        name=tuple(mass.name for mass in masses),
        wire=np.array([index[mass.wire] for mass in masses], dtype=np.int64),
        frame=line.alignment.frames(np.array([mass.chainage for mass in masses], dtype=np.float64)),
        mass=np.array([mass.mass for mass in masses], dtype=np.float64),
    )


def _clamps(line: Line) -> Iterator[_Mass]:
    wires = (CONTACT,) if line.second_contact_wire is None else (CONTACT, SECOND)
    for chainage, support in zip(line.support_x, line.supports, strict=True):
        arm = support.contact_wire.arm if support.contact_wire is not None else None
        if arm is not None and arm.clamp_mass > 0.0:
            for wire in wires:
                yield _Mass(f"clamp at {support.name}", wire, chainage, arm.clamp_mass)
