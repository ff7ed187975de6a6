"""What every method for strings starts from: the numbers of a line; what strings cannot do is refused."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.errors import UnsupportedError
from catenaria.line import Line, refuse_for_method
from catenaria.line.wire import Wire

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class Joints(NamedTuple):
    """Supports and droppers of a wire in order: positions along the track [m], and which are which."""

    x: FloatArray
    support: IntArray
    clamp: IntArray


@dataclass(frozen=True)
class StringWire:
    """A wire as a string that slides over its supports.

    Attributes
    ----------
    name : str
        ``contact wire`` or ``messenger wire``.
    EA : float
        Axial stiffness; Green strain (9) [N].
    w : float
        Weight per unstressed length [N/m].
    tension : float
        The prescribed reaction at one of its ends [N].
    at_end : bool
        Whether that is its end instead of its start.
    tail : float
        Unstressed length beyond the first and the last support before the ends are pulled [m].
    support_x, support_z : FloatArray, shape (m,)
        Where it is held [m].
    """

    name: str
    EA: float
    w: float
    tension: float
    at_end: bool
    tail: float
    support_x: FloatArray
    support_z: FloatArray

    @property
    def laid(self) -> float:
        """Unstressed length from end to end [m]."""
        return float(self.support_x[-1] - self.support_x[0]) + 2.0 * self.tail

    def joints(self, dropper_x: FloatArray) -> Joints:
        """Return the supports and the droppers in order."""
        x = np.concatenate((self.support_x, dropper_x))
        order = np.argsort(x, kind="stable")
        place = np.argsort(order, kind="stable")
        return Joints(x[order], place[: self.support_x.size], place[self.support_x.size :])


@dataclass(frozen=True)
class StringLine:
    """Two strings, and droppers that pull vertically.

    Attributes
    ----------
    contact, messenger : StringWire
        The wires.
    x, height : FloatArray, shape (n,)
        Where the droppers hang along the track, and the wanted heights of the contact wire there [m].
    span : IntArray, shape (n,)
        Numbers of their spans, from 1.
    EA, w : float
        Axial stiffness [N] and weight per unstressed length [N/m] of droppers.
    top, bottom : float
        Weights of their clamps [N].
    """

    contact: StringWire
    messenger: StringWire
    x: FloatArray
    height: FloatArray
    span: IntArray
    EA: float
    w: float
    top: float
    bottom: float

    def unstressed(self, length: FloatArray, force: FloatArray) -> FloatArray:
        """Return the unstressed lengths of droppers of given lengths [m] and forces on the contact wire [N].

        Notes
        -----
        The inner force grows linearly from the lower clamp, its mean is that at half height. The stretch
        hardly depends on the dropper's own weight, so that two passes give all digits.
        """
        unstressed = length
        for _ in range(2):
            unstressed = length / stretch(force + self.bottom + 0.5 * self.w * unstressed, self.EA)
        return unstressed

    def load(self, unstressed: FloatArray, force: FloatArray) -> FloatArray:
        """Return T_md of (23), the loads on the messenger wire with all clamps [N]."""
        return force + self.bottom + self.w * unstressed + self.top


def string_line(line: Line, method: str) -> StringLine:
    """Return the numbers of a line.

    Parameters
    ----------
    line : Line
        The line.
    method : str
        Name of the method that asks, for messages.

    Raises
    ------
    UnsupportedError
        If the line asks for something that no method, or none for strings, can do; it is named.
    """
    refuse_for_method(line, method, spatial=False)
    kind = line.dropper
    if kind.joint == "frictionless":
        raise UnsupportedError(
            f"dropper.joint: frictionless droppers hang askew, the method {method!r} hangs them vertically: "
            "use guided ones, or --method direct"
        )
    for field, wire in (("contact_wire", line.contact_wire), ("messenger_wire", line.messenger_wire)):
        if wire.tension.measure != "reaction":
            raise UnsupportedError(
                f"{field}.tension.measure: the strain at a support is that of a bent wire, which the method "
                f"{method!r} does not know: use the reaction, or --method direct"
            )
    conductor = line.conductor(kind.conductor)
    held = [line.supports[i].contact_wire for i in line.contact_support_indices]
    return StringLine(
        contact=_wire(
            line,
            line.contact_wire,
            "contact wire",
            [line.support_x[i] for i in line.contact_support_indices],
            [support.height for support in held if support],
        ),
        messenger=_wire(
            line,
            line.messenger_wire,
            "messenger wire",
            list(line.support_x),
            [support.messenger_height for support in line.supports],
        ),
        x=np.array(line.dropper_x),
        height=np.array(line.dropper_target_height),
        span=np.array(line.dropper_span, dtype=np.int64) + 1,
        EA=conductor.EA,
        w=conductor.rhoA * line.gravity,
        top=kind.clamp_mass_top * line.gravity,
        bottom=kind.clamp_mass_bottom * line.gravity,
    )


def _wire(line: Line, wire: Wire, name: str, x: list[float], z: list[float]) -> StringWire:
    conductor = line.conductor(wire.conductor)
    return StringWire(
        name=name,
        EA=conductor.EA,
        w=conductor.rhoA * line.gravity,
        tension=wire.tension.force,
        at_end=wire.tension.at == "end",
        tail=wire.tail,
        support_x=np.array(x),
        support_z=np.array(z),
    )
