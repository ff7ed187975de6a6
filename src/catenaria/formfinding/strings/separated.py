"""The separated model: the contact wire alone gives the forces with which the messenger wire is loaded.

Strings in closed form: the string between two points is a beam's moment divided by the horizontal tension.
"""

from __future__ import annotations

from collections.abc import Callable
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
Loads = Callable[[FloatArray], FloatArray]

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
    d; the dropper's force is what is missing at the joint, F = W_r + W_l' + S - S'. The messenger carries these
    forces and the droppers' weights; its chords have S = S_0 + the sum of all loads before, with S_0 such
    that the rises d = S h/H add up to that between the supports.

    Examples
    --------
    See `tests/formfinding/strings/test_separated.py`.
    """
    joints = task.contact.joints(task.x)
    z = np.empty_like(joints.x)
    z[joints.support], z[joints.clamp] = task.contact.support_z, task.height
    contact, first = _wire(task.contact, joints, z, None)
    below = with_tails(task.contact, joints, contact)
    force = below.force[below.clamp, 2]

    joints = task.messenger.joints(task.x)
    z = np.interp(joints.x, task.messenger.support_x, task.messenger.support_z)

    def loads(height: FloatArray) -> FloatArray:
        """Return what hangs on the joints, given the heights of all of them."""
        P = np.zeros_like(height)
        length = height[joints.clamp] - task.height
        P[joints.clamp] = task.load(task.unstressed(length, force), force)
        return P

    messenger, second = _wire(task.messenger, joints, z, loads)
    above = with_tails(task.messenger, joints, messenger)
    unstressed = task.unstressed(messenger.z[joints.clamp] - task.height, force)
    return Solved(LineAtRest(below, above, unstressed), first + second, 2 * joints.x.size)


class _Carried(NamedTuple):
    """What bays carry to their left and right ends [N], and their unstressed lengths [m]."""

    left: FloatArray
    right: FloatArray
    L: FloatArray


def _wire(wire: StringWire, joints: Joints, z: FloatArray, loads: Loads | None) -> tuple[Bays, int]:
    """Return a string span by span from its tensioned end on, and the passes that it took.

    Supports without friction pass the tension on. Without `loads` the heights z are kept, and with them
    they are found between supports.
    """
    spans = list(zip(joints.support[:-1].tolist(), joints.support[1:].tolist(), strict=True))
    n = joints.x.size - 1
    H, V, L, z, passes, T = np.empty(n), np.empty(n), np.empty(n), z.copy(), 0, wire.tension
    for first, last in reversed(spans) if wire.at_end else spans:
        bays, points = slice(first, last), slice(first, last + 1)
        own = None if loads is None else (lambda part, at=points: _part(loads, z, part, at))
        span, count = _span(wire, T, joints.x[points], z[points], own)
        z[points], H[bays], V[bays], L[bays] = span.z, span.H, span.V, span.L
        far = span.V[0] if wire.at_end else span.V[-1] + wire.w * span.L[-1]
        T, passes = float(np.hypot(span.H[0], far)), passes + count
    return Bays(z, H, V, L), passes


def _part(loads: Loads, z: FloatArray, part: FloatArray, at: slice) -> FloatArray:
    """Return the loads on some joints, whose heights replace those of the whole wire."""
    whole = z.copy()
    whole[at] = part
    return loads(whole)[at]


def _span(wire: StringWire, T: float, x: FloatArray, z: FloatArray, loads: Loads | None) -> tuple[Bays, int]:
    """Return the string between two supports with the tension T at the one that is nearer to the device."""
    h, H = np.diff(x), T
    W = _Carried(0.5 * wire.w * h, 0.5 * wire.w * h, h)
    for count in range(1, _MOST):
        if loads is not None:
            z = _hung(x, z, H, W, loads(z))
        S = H * np.diff(z) / h
        V = S[-1] + W.right[-1] if wire.at_end else S[0] - W.left[0]
        if not abs(V) < T:
            raise InfeasibleError(f"the {wire.name} cannot carry its loads with a tension of {T:.4g} N")
        H_new, W_new = float(np.sqrt(T * T - V * V)), _weight(wire, H, S, W, h)
        change = max(abs(H_new - H), float(np.max(np.abs(W_new.left - W.left))))
        H, W = H_new, W_new
        if change < _ENOUGH * T:
            if loads is not None:
                z = _hung(x, z, H, W, loads(z))
            V = H * np.diff(z) / h - W.left
            return Bays(z, np.full_like(h, H), V, W.L), count
    raise NotConvergedError(f"the loads of the {wire.name} did not settle in {_MOST} passes", "more tension")


def _hung(x: FloatArray, z: FloatArray, H: float, W: _Carried, P: FloatArray) -> FloatArray:
    """Return the heights of a string under loads at its joints."""
    h = np.diff(x)
    S = np.concatenate(([0.0], np.cumsum(W.right[:-1] + W.left[1:] + P[1:-1])))
    S += (H * (z[-1] - z[0]) - S @ h) / (x[-1] - x[0])
    inner = z[0] + np.cumsum(S * h / H)
    return np.concatenate((z[:1], inner[:-1], z[-1:]))


def _weight(wire: StringWire, H: float, S: FloatArray, W: _Carried, h: FloatArray) -> _Carried:
    """Return what bays carry: weight per length along the track, integrated by Simpson's rule.

    It is w sqrt(1 + z'^2)/x(T) with T = H sqrt(1 + z'^2) and the stretch x; slopes z' follow from the loads
    of the pass before, at the middle those of a load that is linear along the bay.
    """
    middle = S + (W.right - W.left) / 4.0
    slope = np.stack((S - W.left, middle, S + W.right)) / H
    secant = np.sqrt(1.0 + slope * slope)
    a, b, c = secant / stretch(H * secant, wire.EA)
    return _Carried(
        wire.w * h / 6.0 * (a + 2.0 * b), wire.w * h / 6.0 * (2.0 * b + c), h / 6.0 * (a + 4.0 * b + c)
    )
