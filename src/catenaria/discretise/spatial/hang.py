r"""Equilibrium of all wires as strings, across the track and upwards in turn.

Notes
-----
Knots lie in their planes across the track, so that each has two coordinates: horizontally to the left, and
up. A bay pulls its two knots towards each other with the force density H/b and weighs w b/2 on either:
balance is linear in the coordinates of one direction, and so it is in the pulls of the droppers where heights
are wanted. What couples the directions is weak: a dropper pulls to the side by its inclination, H differs
between bays by squares of slopes and by what ties take, roundings are small. So each pass solves one
direction after the other.

References
----------
Schek 1974, The force density method, Comput. Methods Appl. Mech. Eng. 3, 115-134.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.balance import Demands, Holding, Links, balance
from catenaria.discretise.spatial.holding import arm_densities, lateral_holding, vertical_holding
from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.network import Network
from catenaria.discretise.spatial.strings import UP, Strings
from catenaria.discretise.spatial.tensions import horizontal_tensions
from catenaria.errors import InconsistentInputError, InfeasibleError

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_PASSES = 4  # of a fixed point that gains two digits or more in each
_STEEPEST = 1.0  # slope beyond which nothing of this is true
_FLATTER = ("more tension, shorter spans or supports of less different height", "a longer reach")


def hang(net: Network, layout: Layout, *, loaded: bool) -> Strings:
    """Return all wires in equilibrium.

    Parameters
    ----------
    net : Network
        The net of the line, with its anchors where they are.
    layout : Layout
        The line.
    loaded : bool
        Whether there are weights, prescribed lifts, and droppers that hold wires at wanted heights.

    Raises
    ------
    InfeasibleError
        If a wire is slack, or a dropper would have no length.
    InconsistentInputError
        If two droppers, or a dropper and a support, hold a wire at the same place.
    """
    tension = np.array([wire.tension.force for wire in layout.wires])[net.bay_wire]
    none = np.zeros(layout.droppers.lower.size)
    r = net.P.copy()
    r[net.knot[net.hold]] = layout.holds.X
    strings = Strings(
        net, layout, loaded, r, tension, none, np.full(net.hold.size, np.nan), np.zeros((net.knot.size, 3))
    )
    for _ in range(_PASSES):
        strings = _retensioned(_rounded(_raised(_moved_across(strings))))
    _check(strings)
    return strings


def _moved_across(strings: Strings) -> Strings:
    """Return the strings in lateral equilibrium."""
    net, knot = strings.net, strings.net.knot
    links = Links(
        np.concatenate((knot[net.bay], knot[net.lower])),
        np.concatenate((knot[net.bay + 1], knot[net.upper])),
        np.concatenate((strings.H / strings.b, strings.dropper_density)),
        np.concatenate((strings.chord, strings.dropper)),
    )
    holding = _at_knots(strings, lateral_holding(strings))
    move, _ = balance(links, net.left, holding, Demands.none())
    return replace(strings, r=strings.r + move[:, None] * net.left)


def _raised(strings: Strings) -> Strings:
    """Return the strings in vertical equilibrium, lower wires of droppers at the wanted heights."""
    net, knot, n = strings.net, strings.net.knot, strings.r.shape[0]
    links = Links(knot[net.bay], knot[net.bay + 1], strings.H / strings.b, strings.chord)
    half = 0.5 * strings.w * strings.b
    holding = _at_knots(strings, vertical_holding(strings))
    weight = np.bincount(links.tail, half, n) + np.bincount(links.head, half, n) + strings.weights
    up, holding = np.tile(UP, (n, 1)), holding._replace(load=holding.load - weight)
    demands = _heights(strings, holding.stiffness) if strings.loaded else Demands.none()
    move, raising = balance(links, up, holding, demands)
    raised = replace(strings, r=strings.r + move[:, None] * up)
    return replace(raised, raising=raising) if strings.loaded else raised


def _at_knots(strings: Strings, holding: Holding) -> Holding:
    """Return what holds all knots, of which the anchored ends are fixed as well."""
    net = strings.net
    every = Holding(*(np.zeros(strings.r.shape[0]) for _ in holding))
    every.stiffness[net.anchors :] = np.inf
    for own, values in zip(every, holding, strict=True):
        own[net.knot[net.hold]] = values
    return every


def _heights(strings: Strings, stiffness: FloatArray) -> Demands:
    """Return the wanted heights, normal to the canted track, as ways of lower clamps upwards."""
    net, frame = strings.net, strings.layout.droppers.frame
    lower = net.knot[net.lower]
    _refuse_held_twice(strings, lower, stiffness)
    missing = strings.layout.droppers.height - frame.height(strings.wire_at[net.lower])
    return Demands(lower, net.knot[net.upper], missing / frame.up[:, 2])


def _refuse_held_twice(strings: Strings, lower: IntArray, stiffness: FloatArray) -> None:
    again = np.bincount(lower, minlength=stiffness.size)[lower] > 1
    twice = np.flatnonzero(again | np.isinf(stiffness[lower]))
    if twice.size:
        wire = strings.layout.wires[strings.layout.droppers.lower[twice[0]]].name
        raise InconsistentInputError(
            f"{_dropper(strings.layout, int(twice[0]))} would hold the {wire} where a support or another "
            "dropper holds it already"
        )


def _rounded(strings: Strings) -> Strings:
    """Return the strings with wires beside their kinks as far as bending takes them."""
    return replace(strings, rounding=0.5 * strings.layer[:, None] * strings.jump)


def _retensioned(strings: Strings) -> Strings:
    """Return the strings with the tensions and the arms' forces that fit their slopes."""
    return replace(strings, H=horizontal_tensions(strings), arm=arm_densities(strings))


def _check(strings: Strings) -> None:
    """Refuse wires so steep, and droppers so short, that this is no form of an overhead line."""
    net, layout = strings.net, strings.layout
    start, end = strings.slopes
    steep = np.flatnonzero(~(np.maximum(np.abs(start[:, 2]), np.abs(end[:, 2])) < _STEEPEST))
    if steep.size:
        wire = layout.wires[net.bay_wire[steep[0]]]
        raise InfeasibleError(
            f"the {wire.name} would be steeper than 45 degrees near "
            f"x = {strings.at[net.bay[steep[0]], 0]:.6g} m under its {wire.tension.force / 1e3:.4g} kN; "
            f"{_FLATTER[wire.role == 'mid-point anchor']} would help"
        )
    low = np.flatnonzero(~(strings.dropper[:, 2] > 0.0)) if strings.loaded else np.zeros(0, dtype=np.int64)
    if low.size:
        lower, upper = (
            layout.wires[which[low[0]]] for which in (layout.droppers.lower, layout.droppers.upper)
        )
        raise InfeasibleError(
            f"{_dropper(layout, int(low[0]))} would have no length: the {upper.name} hangs "
            f"{-1e3 * strings.dropper[low[0], 2]:.4g} mm below the {lower.name}; more tension or more "
            f"height of the {upper.name} would help"
        )


def _dropper(layout: Layout, index: int) -> str:
    droppers = layout.droppers
    return f"dropper {droppers.number[index]} in span {droppers.span[index]}"
