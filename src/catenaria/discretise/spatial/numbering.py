"""The unknowns of a line in space: meshed wires, and where the unknowns of all that acts on them are."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.mesh import graded_knots
from catenaria.discretise.spatial.guess import Guess
from catenaria.discretise.spatial.layout import LaidCantilever, Layout, across
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.unknowns import Kind, Unknowns, UnknownsBuilder

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

NONE = -1  # in the place of an index where there is no such unknown

_DIGITS = 3  # of where nodes stand [m]: the mesh does not change with the last digits of a force


@dataclass(frozen=True)
class Numbering:
    """Where the unknowns are.

    Attributes
    ----------
    wires, cantilevers : tuple of Chain
        Meshed.
    hold_s : IntArray, shape (n_holds,)
        Sliding coordinates at supports.
    roller_force : IntArray, shape (n_rollers, 3)
        Forces of wires on the supports over which they run.
    across_force : IntArray, shape (n_guided, 2)
        Forces of wires on brackets and arms with a hinge to be found, horizontally across the track and up.
    arm_density : IntArray, shape (n_hinged,)
        Force per length of arms with a given hinge.
    lower_s, upper_s, density, length : IntArray, shape (n_droppers,)
        Sliding coordinates of the clamps, force per length, and unstressed length of every dropper.
    tie_s, tie_force : IntArray, shape (n_ties,), (n_ties, 3)
        Sliding coordinates on the hosts, and forces of the tied wires' ends on the hosts.
    mass_s : IntArray, shape (n_masses,)
        Sliding coordinates of point masses.
    pull, piece : IntArray, shape (n_wires,)
        How far devices have pulled, or how much longer than meshed a tied wire is; `NONE` where not.
    end_force : IntArray, shape (n_wires, 2, 3)
        Forces of the wires' starts and ends on devices and terminations; `NONE` of tied wires.
    root_force : IntArray, shape (n_cantilevers, 6)
        Forces and moments (per slope) of cantilevers on their fixed roots.
    """

    wires: tuple[Chain, ...]
    cantilevers: tuple[Chain, ...]
    hold_s: IntArray
    roller_force: IntArray
    across_force: IntArray
    arm_density: IntArray
    lower_s: IntArray
    upper_s: IntArray
    density: IntArray
    length: IntArray
    tie_s: IntArray
    tie_force: IntArray
    mass_s: IntArray
    pull: IntArray
    piece: IntArray
    end_force: IntArray
    root_force: IntArray

    def renumbered(self, number: IntArray) -> Self:
        """Return the same with final numbers."""
        final = np.append(number, NONE)  # so that NONE stays what it is
        chains = ("wires", "cantilevers")
        arrays = {
            field.name: final[getattr(self, field.name)]
            for field in fields(Numbering)
            if field.name not in chains
        }
        wires, cantilevers = (tuple(c.renumbered(number) for c in getattr(self, name)) for name in chains)
        return replace(self, wires=wires, cantilevers=cantilevers, **arrays)


def graded_meshes(layout: Layout, guess: Guess) -> tuple[FloatArray, ...]:
    """Return the material coordinates of all wires' nodes, fine where a guess has supports and clamps."""
    meshes: list[FloatArray] = []
    for k, course in enumerate(guess.courses):
        centres = np.clip(np.round(guess.centres(layout, k), _DIGITS), 0.0, course.length)
        meshes.append(graded_knots(course.length, centres, layout.grading))
    return tuple(meshes)


def number_line(layout: Layout, guess: Guess, meshes: tuple[FloatArray, ...]) -> tuple[Unknowns, Numbering]:
    """Return the table of unknowns, and where everything is in it.

    Parameters
    ----------
    layout : Layout
        What is modelled.
    guess : Guess
        Where the unknowns start.
    meshes : tuple of FloatArray
        Material coordinates of all wires' nodes [m].
    """
    unknowns = UnknownsBuilder()
    holds, droppers, ties = layout.holds, layout.droppers, layout.ties
    at_hold, at_dropper, at_tie = (part.frame.chainage for part in (holds, droppers, ties))
    rollers, hinged = ~holds.guided, holds.hinged
    placed = holds.guided & ~hinged
    force = guess.hold_force

    def scalar(kind: Kind, start: FloatArray, at: FloatArray) -> IntArray:
        return unknowns.add(kind, start, at)

    numbering = Numbering(
        wires=tuple(_wire(layout, k, guess, knots, unknowns) for k, knots in enumerate(meshes)),
        cantilevers=tuple(_cantilever(layout, part, unknowns) for part in layout.cantilevers),
        hold_s=scalar(Kind.SLIDING, guess.hold_s, at_hold),
        roller_force=unknowns.add(Kind.MULTIPLIER, force[rollers], at_hold[rollers]),
        across_force=unknowns.add(Kind.MULTIPLIER, _across(layout, force)[placed], at_hold[placed]),
        arm_density=scalar(Kind.MULTIPLIER, _densities(layout, force)[hinged], at_hold[hinged]),
        lower_s=scalar(Kind.SLIDING, guess.lower_s, at_dropper),
        upper_s=scalar(Kind.SLIDING, guess.upper_s, at_dropper),
        density=scalar(Kind.MULTIPLIER, guess.density, at_dropper),
        length=scalar(Kind.PARAMETER, guess.dropper_length, at_dropper),
        tie_s=scalar(Kind.SLIDING, guess.tie_s, at_tie),
        tie_force=unknowns.add(Kind.MULTIPLIER, guess.tie_force, at_tie),
        mass_s=scalar(Kind.SLIDING, guess.mass_s, layout.masses.frame.chainage),
        **_ends(layout, guess, unknowns),
        root_force=np.array(
            [_root(layout, part, unknowns) for part in layout.cantilevers], dtype=np.int64
        ).reshape(-1, 6),
    )
    table, number = unknowns.build_along_line()
    return table, numbering.renumbered(number)


def _wire(layout: Layout, wire: int, guess: Guess, knots: FloatArray, unknowns: UnknownsBuilder) -> Chain:
    """Return a meshed wire with nodes where the guess has them."""
    position, slope = guess.courses[wire].place(knots)
    known = sorted(_stations(layout, guess, wire))
    s, chainage = (np.array(column) for column in zip(*known, strict=True))
    nodes = unknowns.add_nodes(position, slope, np.interp(knots, s, chainage))
    return Chain(nodes, knots, layout.wires[wire].section)


def _stations(layout: Layout, guess: Guess, wire: int) -> Iterator[tuple[float, float]]:
    """Yield material coordinates of a wire and the chainages at which they will be."""
    holds, droppers, ties, masses = layout.holds, layout.droppers, layout.ties, layout.masses
    for part, on, s in (
        (holds, holds.wire, guess.hold_s),
        (droppers, droppers.lower, guess.lower_s),
        (droppers, droppers.upper, guess.upper_s),
        (ties, ties.host, guess.tie_s),
        (ties, ties.wire, ties.end * guess.courses[wire].length),
        (masses, masses.wire, guess.mass_s),
    ):
        own = on == wire
        yield from zip(s[own].tolist(), part.frame.chainage[own].tolist(), strict=True)


def _across(layout: Layout, force: FloatArray) -> FloatArray:
    """Return the components of forces at holds horizontally across the track and upwards, shape (n, 2)."""
    sideways = np.einsum("ni,ni->n", across(layout.holds.frame), force)
    return np.column_stack((sideways, force[:, 2]))


def _densities(layout: Layout, force: FloatArray) -> FloatArray:
    """Return the forces per length of arms with given hinges; nothing that matters elsewhere."""
    holds = layout.holds
    d = np.where(holds.hinged[:, None], holds.X - holds.hinge, 1.0)
    return np.einsum("ni,ni->n", d, force) / np.einsum("ni,ni->n", d, d)


def _ends(layout: Layout, guess: Guess, unknowns: UnknownsBuilder) -> dict[str, IntArray]:
    """Return where pulls, lengths of pieces and forces at ends are."""
    count = len(layout.wires)
    pull, piece = np.full(count, NONE), np.full(count, NONE)
    end_force = np.full((count, 2, 3), NONE)
    for k, wire in enumerate(layout.wires):
        on = layout.ties.wire == k
        chainage = (
            layout.ties.frame.chainage[on] if wire.tied else layout.holds.frame.chainage[_of(layout, k)]
        )
        last, way = np.full(1, chainage.max()), np.full(1, guess.courses[k].pull)
        if wire.tied:
            piece[k] = unknowns.add(Kind.PARAMETER, way, last)[0]
            continue
        pull[k] = unknowns.add(Kind.PARAMETER, way, last)[0]
        at = np.array([chainage.min(), chainage.max()])
        end_force[k] = unknowns.add(Kind.MULTIPLIER, guess.end_force[k], at)
    return {"pull": pull, "piece": piece, "end_force": end_force}


def _of(layout: Layout, wire: int) -> NDArray[np.bool_]:
    return layout.holds.wire == wire


def _cantilever(layout: Layout, part: LaidCantilever, unknowns: UnknownsBuilder) -> Chain:
    """Return a cantilever from its root to its free tip, without load."""
    tip, at = layout.holds.X[part.hold], layout.holds.frame.chainage[part.hold]
    reach = tip - part.root
    share = np.linspace(0.0, 1.0, part.elements + 1)
    slope = np.tile(reach / np.linalg.norm(reach), (share.size, 1))
    nodes = unknowns.add_nodes(part.root + share[:, None] * reach, slope, np.full(share.size, at))
    return Chain(nodes, share * float(np.linalg.norm(reach)), part.section)


def _root(layout: Layout, part: LaidCantilever, unknowns: UnknownsBuilder) -> IntArray:
    return unknowns.add(Kind.MULTIPLIER, np.zeros(6), layout.holds.frame.chainage[part.hold])
