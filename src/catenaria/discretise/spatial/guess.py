"""The first guess of a line in space: where its wires lie, what acts where on them, and with what force."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from catenaria.catenary.green_bar import stretch
from catenaria.discretise.spatial.course import Course
from catenaria.discretise.spatial.hang import hang
from catenaria.discretise.spatial.laid import Laid
from catenaria.discretise.spatial.layout import Layout
from catenaria.discretise.spatial.network import Network
from catenaria.discretise.spatial.strings import Strings

FloatArray = NDArray[np.float64]

_PULLS = 2  # passes in which the pulls of ends are found: beyond the second there is nothing left


@dataclass(frozen=True)
class Guess:
    """A line near equilibrium.

    Attributes
    ----------
    courses : tuple of Laid
        Where the wires lie.
    hold_s, hold_force : FloatArray, shape (n_holds,), (n_holds, 3)
        Material coordinates at supports [m], and forces of the wires on the supports [N].
    lower_s, upper_s, density, dropper_length : FloatArray, shape (n_droppers,)
        Material coordinates of droppers' clamps [m], force per length [N/m], unstressed length [m].
    tie_s, tie_force : FloatArray, shape (n_ties,), (n_ties, 3)
        Material coordinates of ties on their hosts [m], and forces of the tied ends on the hosts [N].
    mass_s : FloatArray, shape (n_masses,)
        Material coordinates of point masses [m].
    end_force : FloatArray, shape (n_wires, 2, 3)
        Forces of wires' starts and ends on devices and terminations [N], none of tied wires.
    """

    courses: tuple[Laid, ...]
    hold_s: FloatArray
    hold_force: FloatArray
    lower_s: FloatArray
    upper_s: FloatArray
    density: FloatArray
    dropper_length: FloatArray
    tie_s: FloatArray
    tie_force: FloatArray
    mass_s: FloatArray
    end_force: FloatArray

    def centres(self, layout: Layout, wire: int) -> FloatArray:
        """Return the material coordinates of all that acts on a wire between its ends [m], ascending."""
        holds, droppers, ties, masses = layout.holds, layout.droppers, layout.ties, layout.masses
        parts = (
            self.hold_s[holds.wire == wire],
            self.lower_s[droppers.lower == wire],
            self.upper_s[droppers.upper == wire],
            self.tie_s[ties.host == wire],
            self.mass_s[masses.wire == wire],
        )
        return np.unique(np.concatenate(parts))


def guess(layout: Layout) -> Guess:
    """Return the line near the equilibrium in which all its demands are met, no end being pulled.

    Parameters
    ----------
    layout : Layout
        The line.

    Raises
    ------
    InfeasibleError
        If a wire is slack, a dropper would have no length, or a steady arm does not reach the wire.
    InconsistentInputError
        If two things hold a wire at the same place.
    """
    net = Network.of(layout)
    strings = hang(net, layout, loaded=True)
    return _at(strings, tuple(Course.of(strings, wire) for wire in range(len(layout.wires))))


def weightless(layout: Layout, full: Guess) -> Guess:
    """Return the same wires without weight, taut, with droppers that only reach from wire to wire.

    Parameters
    ----------
    layout : Layout
        The line.
    full : Guess
        Its guess in equilibrium, from which the wires have their lengths.

    Notes
    -----
    Without sag wires are too long, so that devices pull their ends outwards, or tied wires are shortened.
    Prescribed vertical forces are left out as well: without weights, nothing would hold them.
    """
    net, count = Network.of(layout), len(layout.wires)
    length = np.array([course.length for course in full.courses])
    pulled = np.array([wire.pulled for wire in layout.wires])
    pull, strings = np.zeros(count), hang(net, layout, loaded=False)
    for _ in range(_PULLS):
        courses = [Course.of(strings, wire) for wire in range(count)]
        left = (length - [course.length for course in courses]) * [
            course.curve.factor[-1] for course in courses
        ]
        pull += left / np.maximum(pulled.sum(axis=1), 1)
        strings = hang(_pulled(net, layout, pull), layout, loaded=False)
    courses = [Course.of(strings, wire) for wire in range(count)]
    tied = np.array([wire.tied for wire in layout.wires])
    pull = np.where(tied, [course.length for course in courses] - length, pull)
    made = zip(courses, length, pull, strict=True)
    return _at(strings, tuple(replace(course, length=float(L), pull=float(p)) for course, L, p in made))


def _pulled(net: Network, layout: Layout, pull: FloatArray) -> Network:
    """Return the net with anchored ends pulled outwards."""
    P = net.P.copy()
    ends = [
        wire.ends + np.array(wire.pulled)[:, None] * way * wire.outwards
        for wire, way in zip(layout.wires, pull, strict=True)
        if not wire.tied
    ]
    P[net.anchors :] = np.concatenate(ends)
    return replace(net, P=P)


def _at(strings: Strings, courses: tuple[Course, ...]) -> Guess:
    """Return the guess with what the strings exert."""
    net, droppers = strings.net, strings.layout.droppers
    s = np.concatenate([course.stations for course in courses])
    density, distance = strings.dropper_density, np.linalg.norm(strings.dropper, axis=1)
    tied = np.array([wire.tied for wire in strings.layout.wires])
    ends = strings.force[np.column_stack((net.first[:-1], net.first[1:] - 1))]
    return Guess(
        courses=courses,
        hold_s=s[net.hold],
        hold_force=strings.hold_force,
        lower_s=s[net.lower],
        upper_s=s[net.upper],
        density=density,
        dropper_length=distance / stretch(density * distance * droppers.flexibility, 1.0),
        tie_s=s[net.tie],
        tie_force=strings.force[net.tied],
        mass_s=s[net.mass],
        end_force=np.where(tied[:, None, None], 0.0, ends),
    )
