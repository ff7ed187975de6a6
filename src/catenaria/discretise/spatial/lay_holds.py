"""Where and how supports hold the wires."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.lay_wires import CONTACT, MESSENGER, SECOND, beside, held_at, section
from catenaria.discretise.spatial.layout import HoldKind, Holds, LaidCantilever, LaidWire
from catenaria.line import Line, Support, Tension
from catenaria.line.alignment import Frames
from catenaria.line.steady_arm import SIGN

FloatArray = NDArray[np.float64]

NOWHERE: Final = (np.nan, np.nan, np.nan)


@dataclass(frozen=True)
class _Hold:
    """One place; the same as a row of `Holds`."""

    wire: int
    support: int
    X: FloatArray
    kind: HoldKind
    friction: float = 0.0
    compliance: tuple[float, float] = (0.0, 0.0)
    lift: float = np.nan
    hinge: Sequence[float] | FloatArray = NOWHERE
    arm_length: float = 0.0
    arm_mass: float = 0.0
    side: float = 0.0


def lay_holds(line: Line, wires: Sequence[LaidWire], frames: Frames) -> Holds:
    """Return all places where supports hold wires.

    Parameters
    ----------
    line : Line
        The line.
    wires : sequence of LaidWire
        Its wires.
    frames : Frames
        Track frames at all supports.
    """
    holds = [hold for i, wire in enumerate(wires) for hold in _of_wire(line, i, wire, frames)]
    support = np.array([hold.support for hold in holds], dtype=np.int64)
    return Holds(
        wire=np.array([hold.wire for hold in holds], dtype=np.int64),
        support=support,
        frame=frames.take(support),
        X=np.array([hold.X for hold in holds]),
        kind=tuple(hold.kind for hold in holds),
        friction=np.array([hold.friction for hold in holds]),
        compliance=np.array([hold.compliance for hold in holds]),
        lift=np.array([hold.lift for hold in holds]),
        hinge=np.array([hold.hinge for hold in holds]),
        arm_length=np.array([hold.arm_length for hold in holds]),
        arm_mass=np.array([hold.arm_mass for hold in holds]),
        side=np.array([hold.side for hold in holds]),
    )


def lay_cantilevers(line: Line, holds: Holds) -> tuple[LaidCantilever, ...]:
    """Return the cantilevers: from a root beside the wire, in the canted plane, to where the wire is held."""
    laid: list[LaidCantilever] = []
    for i, (kind, support) in enumerate(zip(holds.kind, holds.support, strict=True)):
        cantilever = line.supports[int(support)].messenger_wire.cantilever
        if kind == "cantilever" and cantilever is not None:
            root = holds.X[i] + SIGN[cantilever.side] * cantilever.length * holds.frame.left[i]
            laid.append(LaidCantilever(i, root, section(cantilever), cantilever.elements))
    return tuple(laid)


def _of_wire(line: Line, index: int, wire: LaidWire, frames: Frames) -> Iterator[_Hold]:
    if wire.tied:
        return
    for i, support in enumerate(line.supports):
        held = held_at(line, wire.name, support)
        if held is None:
            continue
        frame = frames.take(np.array([i]))
        X = frame.point(*held)[0]
        if wire.name in (CONTACT, SECOND):
            yield _contact(line, _Hold(index, i, X, "sliding"), support, frame, beside(line, wire.name))
        elif wire.name == MESSENGER:
            loss = _loss_direction(line.messenger_wire.tension, i, frames)
            yield _messenger(_Hold(index, i, X, "sliding"), support, loss)
        else:
            yield _Hold(index, i, X, "sliding")


def _contact(line: Line, place: _Hold, support: Support, frame: Frames, offset: float) -> _Hold:
    """Return how a support holds a contact wire; each of two wires has an arm of its own, side by side."""
    arm = support.contact_wire.arm if support.contact_wire is not None else None
    if arm is None:
        return place
    return _Hold(
        place.wire,
        place.support,
        place.X,
        "arm",
        lift=np.nan if arm.lift is None else arm.lift,
        hinge=NOWHERE if arm.hinge is None else frame.point(arm.hinge.stagger + offset, arm.hinge.height)[0],
        arm_length=arm.length,
        arm_mass=arm.mass,
        side=arm.hinge_side(support.stagger),
    )


def _messenger(place: _Hold, support: Support, loss: float) -> _Hold:
    """Return how a support holds the messenger wire."""
    held = support.messenger_wire
    springs = [0.0 if k is None else 1.0 / k for k in (held.lateral_stiffness, held.stiffness)]
    return _Hold(
        place.wire,
        place.support,
        place.X,
        held.kind,
        friction=loss * held.friction,
        compliance=(springs[0], springs[1]),
    )


def _loss_direction(tension: Tension, support: int, frames: Frames) -> float:
    """Return whether tension grows (1) or falls (-1) with the chainage at a support with friction.

    It falls from a pulled end towards the fixed one; where both are pulled, from both towards the middle, and
    a support that stands exactly there takes nothing.
    """
    if tension.pulled != "both":
        return 1.0 if tension.pulled == "end" else -1.0
    chainage = frames.chainage
    return float(np.sign(chainage[support] - (chainage[0] + chainage[-1]) / 2.0))
