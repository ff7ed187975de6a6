"""The force density method of Schek (1974) for a line with prescribed tensions and heights.

With the force per length of every element given, equilibrium is linear in the coordinates.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded  # pyright: ignore[reportUnknownVariableType]

from catenaria.errors import InfeasibleError, NotConvergedError
from catenaria.formfinding.strings.at_rest import LineAtRest
from catenaria.formfinding.strings.bays import Bays, with_tails
from catenaria.formfinding.strings.method import Solved
from catenaria.formfinding.strings.net import Net
from catenaria.formfinding.strings.task import Joints, StringLine, StringWire

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

NEGLECTS = "bending; weight is lumped at nodes at most 2.4 m apart, their sag added afterwards"

_LARGEST = 2.4  # m: an element's weight acts 0.02 mm from its middle where the messenger is steepest
_ENOUGH = 1e-12  # m by which heights may still change
_MOST = 100


def find_rest(task: StringLine) -> Solved:
    r"""Find both strings at rest.

    Parameters
    ----------
    task : StringLine
        What was asked for.

    Notes
    -----
    Branches e have force densities q_e = N_e/l_e. Nodes stand at prescribed places x along the track, so that
    :math:`q_e = H/\Delta x_e` holds the tension's horizontal component exactly and heights follow from the
    one linear system :math:`C^TQC\,z = -p` with the branch-node matrix C, Q = diag(q) and lumped weights p.
    On the contact wire the heights at droppers are given as well and the rows of these nodes give the
    droppers' forces; density and length of droppers are never guessed. What is not linear (weights by the
    lengths and stretches of elements, H by the slope at the tensioned end) is repeated until it settles.

    References
    ----------
    H.-J. Schek, The force density method for form finding and computation of general networks, Computer
    Methods in Applied Mechanics and Engineering 3 (1974) 115-134. [18] of Yang et al. 2017. The linear step
    is that of the method as it is commonly taught, its use for a line is our reconstruction: the original
    was not available.
    """
    joints = task.contact.joints(task.x)
    net = Net.of(joints, _LARGEST)
    height = np.empty_like(joints.x)
    height[joints.support], height[joints.clamp] = task.contact.support_z, task.height
    contact, first = _settle(task.contact, joints, net, np.interp(net.x, joints.x, height), None)
    below = with_tails(task.contact, joints, contact)
    force = below.force[below.clamp, 2]

    joints = task.messenger.joints(task.x)
    net = Net.of(joints, _LARGEST)
    z = np.interp(net.x, task.messenger.support_x, task.messenger.support_z)
    messenger, second = _settle(task.messenger, joints, net, z, (task, force))
    above = with_tails(task.messenger, joints, messenger)
    unstressed = task.unstressed(messenger.z[joints.clamp] - task.height, force)
    return Solved(LineAtRest(below, above, unstressed), first + second, 2 * net.x.size)


def _settle(
    wire: StringWire, joints: Joints, net: Net, z: FloatArray, hanging: tuple[StringLine, FloatArray] | None
) -> tuple[Bays, int]:
    """Repeat the linear step until heights do not change; without droppers that hang, heights are given."""
    fixed = np.zeros(net.x.size, dtype=np.bool_)
    fixed[net.joint[joints.support] if hanging else net.joint] = True
    along, change = np.full(net.dx.size, wire.tension), np.inf
    for count in range(_MOST):
        q = along / net.dx
        L = net.unstressed(wire, z, along)
        weight = wire.w * L
        if change < _ENOUGH:
            return net.bays(wire, z, along, L), count
        load = np.zeros_like(z)
        load[:-1] += 0.5 * weight
        load[1:] += 0.5 * weight
        if hanging:
            task, force = hanging
            clamp = net.joint[joints.clamp]
            load[clamp] += task.load(task.unstressed(z[clamp] - task.height, force), force)
        new = _heights(q, load, z, fixed)
        change, z = float(np.max(np.abs(new - z))), new
        along = _along(wire, net, joints, q * np.diff(z), weight)
    raise NotConvergedError(
        f"the heights of the {wire.name} did not settle in {_MOST} passes", "more tension"
    )


def _heights(q: FloatArray, load: FloatArray, z: FloatArray, fixed: BoolArray) -> FloatArray:
    """Return heights that balance the loads: D z = -p - D_f z_f, with the rows of fixed nodes trivial.

    D = C^T Q C of a chain is tridiagonal.
    """
    given = np.where(fixed, z, 0.0)
    right = np.where(fixed, z, -load)
    right[:-1] += np.where(fixed[:-1], 0.0, q * given[1:])
    right[1:] += np.where(fixed[1:], 0.0, q * given[:-1])
    D = np.ones((2, z.size))
    D[0, 0], D[0, 1:] = 0.0, np.where(fixed[:-1] | fixed[1:], 0.0, -q)
    free = ~fixed  # never the first and the last node
    D[1, free] = (q[:-1] + q[1:])[free[1:-1]]
    return np.asarray(solveh_banded(D, right, check_finite=False), dtype=np.float64)


def _along(wire: StringWire, net: Net, joints: Joints, up: FloatArray, weight: FloatArray) -> FloatArray:
    """Return H of every element: the tension passes supports, and vertical forces take their part of it."""
    ends = net.joint[joints.support]
    spans = list(zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True))
    H, tension = np.empty_like(up), wire.tension
    for first, last in reversed(spans) if wire.at_end else spans:
        sides = up[first] - 0.5 * weight[first], up[last - 1] + 0.5 * weight[last - 1]
        near, far = sides[::-1] if wire.at_end else sides
        if not abs(near) < tension:
            raise InfeasibleError(f"the {wire.name} cannot carry its loads with a tension of {tension:.4g} N")
        along = float(np.sqrt(tension**2 - near**2))
        H[first:last], tension = along, float(np.hypot(along, far))
    return H
