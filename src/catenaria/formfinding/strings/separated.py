"""The separated model: the contact wire alone gives the forces with which the messenger wire is loaded.

Strings in closed form: the string between two points is a beam's moment divided by the horizontal tension.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.bays import Bays, with_tails
from catenaria.formfinding.strings.method import Solved
from catenaria.formfinding.strings.task import Joints, StringLine, StringWire

FloatArray = NDArray[np.float64]

NEGLECTS = "bending; solves one wire after the other in the plane"

_ENOUGH = 1e-13  # change of loads between two passes, relative to the tension
_MOST = 100


def find_rest(task: StringLine) -> Solved:
    """Find both strings at rest.

    Parameters
    ----------
    task : StringLine
        What was asked for.

    Notes
    -----
    The contact wire has a wanted height at every joint. Between two joints it carries its weight over h like
    a beam, W_l to the left and W_r to the right end, and its chord the vertical force S = H d/h of the rise
    d; the dropper's force is what is missing at the joint, F = W_r + W_l' + S - S'. The messenger carries
    these forces and the droppers' weights; its chords have S = S_0 + the sum of all loads before, with S_0
    such that the rises d = S h/H add up to that between the supports. What depends on slopes and tension
    (weight along the track, H, dropper lengths) settles in some passes.

    References
    ----------
    The family of the separate model, [7] of Yang et al. 2017, in our reconstruction: the original was not
    available.
    """
    joints = task.contact.joints(task.x)
    z = np.empty_like(joints.x)
    z[joints.support], z[joints.clamp] = task.contact.support_z, task.height
    contact, first = _wire(task.contact, joints, z, None)
    below = with_tails(task.contact, joints, contact)
    force = below.force[below.clamp, 2]

    joints = task.messenger.joints(task.x)
    z = np.interp(joints.x, task.messenger.support_x, task.messenger.support_z)

    hanging = _Hanging(task, np.zeros_like(z), np.zeros_like(z))
    hanging.foot[joints.clamp], hanging.force[joints.clamp] = task.height, force
    messenger, second = _wire(task.messenger, joints, z, hanging)
    above = with_tails(task.messenger, joints, messenger)
    unstressed = task.unstressed(messenger.z[joints.clamp] - task.height, force)
    return Solved(LineAtRest(below, above, unstressed), first + second, 2 * joints.x.size)


class _Hanging(NamedTuple):
    """What hangs on joints: heights of droppers' feet [m] and their forces [N]; zeros at supports."""

    task: StringLine
    foot: FloatArray
    force: FloatArray

    def load(self, z: FloatArray, at: slice) -> FloatArray:
        """Return the loads on some joints at the heights z [N]."""
        force = self.force[at]
        return self.task.load(self.task.unstressed(z - self.foot[at], force), force)


class _Carried(NamedTuple):
    """What bays carry to their left and right ends [N], and their unstressed lengths [m]."""

    left: FloatArray
    right: FloatArray
    L: FloatArray


def _wire(wire: StringWire, joints: Joints, height: FloatArray, hanging: _Hanging | None) -> tuple[Bays, int]:
    """Return a string span by span from its tensioned end on, and the passes that it took.

    Supports without friction pass the tension on. Heights are kept if nothing hangs on the string, and
    found between supports if something does.
    """
    spans = list(zip(joints.support[:-1].tolist(), joints.support[1:].tolist(), strict=True))
    n = joints.x.size - 1
    bays, passes, tension = Bays(height.copy(), np.empty(n), np.empty(n), np.empty(n)), 0, wire.tension
    for first, last in reversed(spans) if wire.at_end else spans:
        inner, points = slice(first, last), slice(first, last + 1)
        span, count = _span(wire, tension, joints.x[points], height[points], hanging, points)
        bays.z[points], bays.H[inner], bays.V[inner], bays.L[inner] = span.z, span.H, span.V, span.L
        far = span.V[0] if wire.at_end else span.V[-1] + wire.w * span.L[-1]
        tension, passes = float(np.hypot(span.H[0], far)), passes + count
    return bays, passes


def _span(
    wire: StringWire,
    tension: float,
    x: FloatArray,
    z: FloatArray,
    hanging: _Hanging | None,
    at: slice,
) -> tuple[Bays, int]:
    """Return the string between two supports, given the tension at the one that is nearer to the device."""
    h, along = np.diff(x), tension
    weight = _Carried(0.5 * wire.w * h, 0.5 * wire.w * h, h)
    for count in range(1, _MOST):
        if hanging is not None:
            z = _hung(x, z, along, weight, hanging.load(z, at))
        chord = along * np.diff(z) / h
        up = chord[-1] + weight.right[-1] if wire.at_end else chord[0] - weight.left[0]
        if not abs(up) < tension:
            raise InfeasibleError(f"the {wire.name} cannot carry its loads with a tension of {tension:.4g} N")
        after, carried = float(np.sqrt(tension**2 - up**2)), _weight(wire, along, chord, weight, h)
        change = max(abs(after - along), float(np.max(np.abs(carried.left - weight.left))))
        along, weight = after, carried
        if change < _ENOUGH * tension:
            if hanging is not None:
                z = _hung(x, z, along, weight, hanging.load(z, at))
            V = along * np.diff(z) / h - weight.left
            return Bays(z, np.full_like(h, along), V, weight.L), count
    raise NotConvergedError(f"the loads of the {wire.name} did not settle in {_MOST} passes", "more tension")


def _hung(x: FloatArray, z: FloatArray, H: float, weight: _Carried, load: FloatArray) -> FloatArray:
    """Return the heights of a string under loads at its joints."""
    h = np.diff(x)
    below = np.cumsum(weight.right[:-1] + weight.left[1:] + load[1:-1])
    chord = np.concatenate(([0.0], below))
    chord += (H * (z[-1] - z[0]) - chord @ h) / (x[-1] - x[0])
    inner = z[0] + np.cumsum(chord * h / H)
    return np.concatenate((z[:1], inner[:-1], z[-1:]))


def _weight(wire: StringWire, H: float, chord: FloatArray, before: _Carried, h: FloatArray) -> _Carried:
    """Return what bays carry: weight per length along the track, integrated by Simpson's rule.

    It is w sqrt(1 + z'^2)/x(T) with T = H sqrt(1 + z'^2) and the stretch x; slopes z' follow from the loads
    of the pass before, at the middle those of a load that is linear along the bay.
    """
    middle = chord + (before.right - before.left) / 4.0
    slope = np.stack((chord - before.left, middle, chord + before.right)) / H
    secant = np.sqrt(1.0 + slope * slope)
    a, b, c = secant / stretch(H * secant, wire.EA)
    left, right = (wire.w * h / 6.0 * (end + 2.0 * b) for end in (a, c))
    return _Carried(left, right, h / 6.0 * (a + 4.0 * b + c))
