"""Which wires a line has, of what they are made and where they end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.layout import LaidWire, Role
from catenaria.discretise.wire_setup import TensionSetup
from catenaria.line import Anchor, Conductor, Line, Support, TensionControl, Wire
from catenaria.line.alignment import Frames
from catenaria.mechanics.chain import Section
from catenaria.mechanics.controls.velocity_law import VelocityLaw

FloatArray = NDArray[np.float64]

CONTACT: Final = "contact wire"
SECOND: Final = "second contact wire"
AUXILIARY: Final = "auxiliary messenger"
MESSENGER: Final = "messenger wire"


def lay_wires(line: Line, frames: Frames) -> tuple[LaidWire, ...]:
    """Return all wires of a line.

    Parameters
    ----------
    line : Line
        The line.
    frames : Frames
        Track frames at all supports.
    """
    return (*_long_wires(line, frames), *_stitch_wires(line), *_anchors(line))


def stitch_name(support: Support) -> str:
    """Return the name of the stitch wire at a support."""
    return f"stitch wire {support.name}"


def held_at(line: Line, wire: str, support: Support) -> tuple[float, float] | None:
    """Return lateral offset and height [m] at which a support holds a wire; None where it passes freely.

    Of two contact wires the first is half their spacing to the left of the stagger, the second to the right.
    """
    if wire == MESSENGER:
        return support.messenger_offset, support.messenger_height
    if wire == AUXILIARY:
        auxiliary = support.auxiliary_messenger
        return None if auxiliary is None else (support.messenger_offset, auxiliary.height)
    if support.contact_wire is None:
        return None
    return support.stagger + beside(line, wire), support.contact_wire.height


def beside(line: Line, wire: str) -> float:
    """Return how far a wire is to the left of where its stagger says, because there are two of them [m]."""
    if line.second_contact_wire is None or wire not in (CONTACT, SECOND):
        return 0.0
    return line.second_contact_wire.spacing / 2.0 * (1.0 if wire == CONTACT else -1.0)


def section(conductor: Conductor, wear: float = 0.0) -> Section:
    """Return the cross-section of a conductor of which a part has been worn off.

    Notes
    -----
    Area and mass are what is left, 1 - wear. The second moment of area of similar sections grows with the
    square of the area, so that EJ is left in the ratio (1 - wear)^2.
    """
    left = 1.0 - wear
    return Section(conductor.EA * left, conductor.EJ * left**2, conductor.rhoA * left)


def _long_wires(line: Line, frames: Frames) -> Iterator[LaidWire]:
    dynamic = line.solver.dynamic
    contact, messenger = dynamic.contact_tension, dynamic.messenger_tension
    yield _long_wire(line, CONTACT, "contact wire", line.contact_wire, contact, frames)
    if line.second_contact_wire is not None:
        yield _long_wire(line, SECOND, "contact wire", line.contact_wire, contact, frames)
    if line.auxiliary_messenger is not None:
        yield _long_wire(line, AUXILIARY, "auxiliary messenger", line.auxiliary_messenger, messenger, frames)
    yield _long_wire(line, MESSENGER, "messenger wire", line.messenger_wire, messenger, frames)


def _long_wire(
    line: Line, name: str, role: Role, wire: Wire, law: TensionControl, frames: Frames
) -> LaidWire:
    tension = wire.tension
    start, outwards_start = _end(line, name, wire, frames, 0)
    end, outwards_end = _end(line, name, wire, frames, -1)
    return LaidWire(
        name=name,
        role=role,
        section=section(line.conductor(wire.conductor), wire.wear),
        tension=TensionSetup(tension.on_wire, tension.measure, tension.at == "end", _law(law)),
        pulled=(tension.pulled in ("both", "start"), tension.pulled in ("both", "end")),
        ends=np.stack((start, end)),
        outwards=np.stack((outwards_start, outwards_end)),
    )


def _end(
    line: Line, name: str, wire: Wire, frames: Frames, which: Literal[0, -1]
) -> tuple[FloatArray, FloatArray]:
    """Return where a wire is anchored and the direction to there from where it is held last.

    Beyond its first and last support a line goes on straight, whatever the track does.
    """
    anchor = (wire.anchor_start if which == 0 else wire.anchor_end) or Anchor()
    held = held_at(line, name, line.supports[which])
    lateral, height = held if held is not None else (0.0, 0.0)  # a line is held at both ends
    distance = wire.tail if anchor.distance is None else anchor.distance
    frame = frames.take(np.array([which]))
    hold = frame.point(lateral, height)[0]
    end = frame.point(
        lateral if anchor.stagger is None else anchor.stagger + beside(line, name),
        height if anchor.height is None else anchor.height,
    )[0] + distance * frame.along[0] * (-1.0 if which == 0 else 1.0)
    return end, (end - hold) / np.linalg.norm(end - hold)


def _stitch_wires(line: Line) -> Iterator[LaidWire]:
    if line.stitch_wire is not None:
        stitch = line.stitch_wire
        for i in line.stitched_supports:
            name = stitch_name(line.supports[i])
            yield _tied_wire(line, name, "stitch wire", stitch.conductor, stitch.tension)


def _anchors(line: Line) -> Iterator[LaidWire]:
    if line.mid_point is not None:
        anchor = line.mid_point
        for number in (1, 2):
            name = f"mid-point anchor {number}"
            yield _tied_wire(line, name, "mid-point anchor", anchor.conductor, anchor.tension)


def _tied_wire(line: Line, name: str, role: Role, conductor: str, force: float) -> LaidWire:
    """Return a tied wire; its control has the messenger's dead band in the proportion of their tensions."""
    law, share = _law(line.solver.dynamic.messenger_tension), force / line.messenger_wire.tension.on_wire
    law = replace(law, e0=law.e0 * share, e1=law.e1 * share)
    return LaidWire(
        name=name,
        role=role,
        section=section(line.conductor(conductor)),
        tension=TensionSetup(force, "reaction", True, law),
        pulled=(False, False),
        ends=np.zeros((2, 3)),
        outwards=np.zeros((2, 3)),
    )


def _law(control: TensionControl) -> VelocityLaw:
    return VelocityLaw(control.velocity, control.dead_band, control.saturation)
