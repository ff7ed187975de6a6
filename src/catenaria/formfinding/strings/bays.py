"""A string as bays between supports and droppers, and what hangs beyond its end supports."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.errors import InconsistentInputError
from catenaria.formfinding.strings.at_rest import StringAtRest
from catenaria.formfinding.strings.task import Joints, StringWire

FloatArray = NDArray[np.float64]

_GAUSS = 0.5 + np.sqrt(0.15) * np.array([-1.0, 0.0, 1.0])
_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0
_PASSES = 3  # each leaves a millionth of what the one before left


@dataclass(frozen=True)
class Bays:
    """The n bays of a string from its first to its last support.

    Attributes
    ----------
    z : FloatArray, shape (n + 1,)
        Heights of the joints [m].
    H, V : FloatArray, shape (n,)
        Force of the string along the track, and upwards behind the start of each bay [N].
    L : FloatArray, shape (n,)
        Unstressed lengths [m].
    """

    z: FloatArray
    H: FloatArray
    V: FloatArray
    L: FloatArray


def with_tails(wire: StringWire, joints: Joints, bays: Bays) -> StringAtRest:
    """Return the whole string, with the level tails between end supports and tensioning devices.

    Parameters
    ----------
    wire : StringWire
        The wire.
    joints : Joints
        Its supports and droppers.
    bays : Bays
        The string between its end supports.

    Raises
    ------
    InconsistentInputError
        If the stretched string leaves nothing of its tails.

    Notes
    -----
    What is not needed between the end supports is left for the tails. Both ends are pulled by the same way,
    so that both tails reach equally far. A tail is level: its two ends have the tension T of the string at
    the support, and half its weight each.
    """
    V_end = bays.V + wire.w * bays.L
    rest = wire.laid - float(np.sum(bays.L))
    if rest <= 0.0:
        raise InconsistentInputError(
            f"the {wire.name} is too slack for its tails of {wire.tail:g} m: longer ones would help"
        )
    T = np.hypot(bays.H[[0, -1]], (bays.V[0], V_end[-1]))
    length = np.full(2, 0.5 * rest)
    for _ in range(_PASSES):
        reach = _level(wire, T, length)
        length = rest * (length / reach) / np.sum(length / reach)
    V = 0.5 * wire.w * length
    H = np.sqrt(T * T - V * V)
    r = np.zeros((joints.x.size + 2, 3))
    r[1:-1, 0], r[1:-1, 2] = joints.x, bays.z
    r[[0, -1], 0] = joints.x[[0, -1]] + np.array([-1.0, 1.0]) * _level(wire, T, length)
    r[[0, -1], 2] = bays.z[[0, -1]]
    behind = np.zeros((bays.H.size + 2, 3))
    behind[:, 0] = np.concatenate((H[:1], bays.H, H[1:]))
    before = behind.copy()
    behind[:, 2] = np.concatenate((-V[:1], bays.V, -V[1:]))
    before[:, 2] = np.concatenate((V[:1], V_end, V[1:]))
    force = np.vstack((-behind[:1], before[:-1] - behind[1:], before[-1:]))
    s = np.concatenate(([0.0], np.cumsum(np.concatenate((length[:1], bays.L, length[1:])))))
    return StringAtRest(s, r, force, joints.support + 1, joints.clamp + 1)


def _level(wire: StringWire, T: FloatArray, length: FloatArray) -> FloatArray:
    """Return how far level strings reach that have the tension T at both ends [m]."""
    V = 0.5 * wire.w * length
    H = np.sqrt(T * T - V * V)
    size = np.hypot(H[:, None], V[:, None] * (2.0 * _GAUSS - 1.0))
    return length * H * (stretch(size, wire.EA) / size @ _WEIGHTS)
