"""A line in space as one system: wires, supports, arms, droppers, ties and masses.

The same parts serve to find the form (tensions and heights are targets, lengths and pulls unknown), to move
it there under controls, and to build what was found (lengths, pulls and clamps are given).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.guess import Guess, guess
from catenaria.discretise.spatial.guided_points import guided
from catenaria.discretise.spatial.held_parts import arms, held_parts
from catenaria.discretise.spatial.layout import Layout, across
from catenaria.discretise.spatial.numbering import (
    NONE,
    Numbering,
    graded_meshes,
    number_line,
)
from catenaria.mechanics.carrier import Strands
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.controls.given import Given
from catenaria.mechanics.controls.target import Targets
from catenaria.mechanics.elements.bars import Bars
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.elements.pieces import Pieces
from catenaria.mechanics.joints.guides import Guides
from catenaria.mechanics.joints.held_point import HeldPoints
from catenaria.mechanics.joints.ties import Ties
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.loads.hung_masses import HungMasses
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Unknowns

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]

FULL: Final = Ramp(0.0)  # the whole gravity from the start

_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class SpatialModel(Numbering):
    """A line in space, and where its unknowns are; see also `Numbering`.

    Attributes
    ----------
    layout : Layout
        What is modelled.
    guess : Guess
        Where it lies at the start.
    unknowns : Unknowns
        All unknowns, numbered along the line; they start there.
    """

    layout: Layout
    guess: Guess
    unknowns: Unknowns

    def system(
        self,
        z: FloatArray,
        demands: list[Contribution],
        ramp: Ramp,
        *,
        built: bool,
        only_pull: bool = False,
    ) -> System:
        """Return the parts that act in every use, and the given demands on lengths, pulls and forces.

        Parameters
        ----------
        z : FloatArray, shape (n,)
            What joints shall be in the elements of; if it is built, with what lengths, pulls and clamps.
        demands : list of Contribution
            What owns the rows of lengths and pulls: targets or controls, and what else acts. What is left
            without an owner is given if the line is built.
        ramp : Ramp
            Growth of gravity.
        built : bool
            Whether clamps are fixed to their wires, instead of guided across the track.
        only_pull : bool
            Whether droppers go slack instead of pushing.
        """
        parts = [
            *self._wires(ramp),
            *held_parts(self, self.layout, z, ramp, built=built),
            *self._clamps(z, ramp),
        ]
        bars = self.bars(z, ramp, only_pull=only_pull)
        taken = guided(self, self.layout, built=built)
        if built:
            given = np.concatenate([taken.s, self.length, *(x[x != NONE] for x in (self.pull, self.piece))])
            owned = [part.parameter for part in demands if isinstance(part, Targets)]
            given = np.setdiff1d(given, np.concatenate([np.empty(0, np.int64), *owned]))
            parts.append(Given(given, z[given]))
        else:
            element = taken.carrier.locate(z[taken.s])
            parts.append(Guides(taken.carrier, taken.s, element, taken.P, taken.along))
        every = (*parts, bars, *demands)
        return System(self.unknowns, tuple(every))

    def bars(self, z: FloatArray, ramp: Ramp = FULL, *, only_pull: bool = False) -> Bars:
        """Return the droppers, with clamps in the elements that fit z."""
        kind, lower, upper = self.layout.droppers, self.lower_carrier, self.upper_carrier
        elements = lower.locate(z[self.lower_s]), upper.locate(z[self.upper_s])
        return Bars(
            lower,
            upper,
            self.lower_s,
            self.upper_s,
            *elements,
            self.density,
            self.length,
            kind.flexibility,
            kind.rhoA,
            kind.mass_bottom,
            kind.mass_top,
            self.layout.g,
            ramp,
            only_pull,
        )

    @cached_property
    def lower_carrier(self) -> Strands:
        """The wires below the droppers."""
        return Strands.on(self.wires, self.layout.droppers.lower)

    @cached_property
    def upper_carrier(self) -> Strands:
        """The wires above the droppers."""
        return Strands.on(self.wires, self.layout.droppers.upper)

    @cached_property
    def host_carrier(self) -> Strands:
        """The wires to which others are tied."""
        return Strands.on(self.wires, self.layout.ties.host)

    @cached_property
    def hold_carrier(self) -> Strands:
        """The wires that supports hold."""
        return Strands.on(self.wires, self.layout.holds.wire)

    @cached_property
    def elements(self) -> CableElements:
        """Elements of all wires of given length, and of cantilevers."""
        laid = zip(self.wires, self.layout.wires, strict=True)
        chains = [chain for chain, wire in laid if not wire.tied] + list(self.cantilevers)
        return CableElements.of(chains, self.layout.gauss_points)

    @property
    def has_pieces(self) -> bool:
        """Whether there are tied wires."""
        return bool(np.any(self.piece != NONE))

    def pieces(self, ramp: Ramp) -> Pieces:
        """Return the tied wires, whose lengths are parameters."""
        tied = np.flatnonzero(self.piece != NONE)
        chains = [self.wires[k] for k in tied.tolist()]
        return Pieces.of(chains, self.piece[tied], self.layout.gauss_points, self.layout.g, ramp)

    def natural_length(self, z: FloatArray, wire: int) -> float:
        """Return the unstressed length of a wire, end to end [m]."""
        longer = z[self.piece[wire]] if self.piece[wire] != NONE else 0.0
        return float(self.wires[wire].knots[-1] + longer)

    def hold_forces(self, z: FloatArray) -> FloatArray:
        """Return the forces of wires on their supports, and on arms at their tips [N], shape (n_holds, 3)."""
        holds, force = self.layout.holds, np.zeros((self.hold_s.size, 3))
        force[~holds.guided] = z[self.roller_force]
        placed = holds.guided & ~holds.hinged
        h, v = z[self.across_force].T
        force[placed] = h[:, None] * across(holds.frame)[placed] + v[:, None] * _UP
        if holds.hinged.any():
            force[holds.hinged] = -arms(self, self.layout, z, FULL).loads(0.0, z)
        return force

    def _wires(self, ramp: Ramp) -> Iterator[Contribution]:
        yield self.elements
        yield Gravity(self.elements.weight(self.unknowns.size), self.layout.g, ramp)
        if self.has_pieces:
            yield self.pieces(ramp)
        yield self.ends
        if self.cantilevers:
            yield self._roots()

    @cached_property
    def ends(self) -> HeldPoints:
        """Ends of wires at devices and terminations."""
        own = [k for k, wire in enumerate(self.layout.wires) if not wire.tied]
        wires = [self.layout.wires[k] for k in own]
        pulled = np.array([wire.pulled for wire in wires], dtype=np.bool_)
        return HeldPoints(
            np.concatenate([self.wires[k].nodes[[0, -1], :3] for k in own]),
            self.end_force[own].reshape(-1, 3),
            np.concatenate([wire.ends for wire in wires]),
            np.concatenate([wire.outwards for wire in wires]),
            np.where(pulled, self.pull[own][:, None], NONE).astype(np.int64).ravel(),
        )

    def _roots(self) -> HeldPoints:
        """Return cantilevers' roots, held in place and direction: a node's slope is held like its place."""
        nodes = np.concatenate([chain.nodes[0].reshape(2, 3) for chain in self.cantilevers])
        start, fixed = self.unknowns.start[nodes], np.full(nodes.shape[0], NONE, dtype=np.int64)
        return HeldPoints(nodes, self.root_force.reshape(-1, 3), start, np.zeros(nodes.shape), fixed)

    def _clamps(self, z: FloatArray, ramp: Ramp) -> Iterator[Contribution]:
        """Yield arms with given hinges, ties and masses."""
        layout = self.layout
        if layout.holds.hinged.any():
            yield arms(self, layout, z, ramp)
        if layout.ties.wire.size:
            wires: list[int] = layout.ties.wire.tolist()
            ends: list[int] = layout.ties.end.tolist()
            own = zip(wires, ends, strict=True)
            nodes = np.array([self.wires[k].nodes[-end, :3] for k, end in own], dtype=np.int64)
            element = self.host_carrier.locate(z[self.tie_s])
            yield Ties(nodes, self.host_carrier, self.tie_s, element, self.tie_force)
        if layout.masses.mass.size:
            on = Strands.on(self.wires, layout.masses.wire)
            element = on.locate(z[self.mass_s])
            yield HungMasses(on, self.mass_s, element, layout.masses.mass, layout.g, ramp)


def build_model(layout: Layout, start: Guess, meshes: tuple[FloatArray, ...]) -> SpatialModel:
    """Return the line numbered, where it starts, with nodes at given material coordinates of its wires."""
    unknowns, numbering = number_line(layout, start, meshes)
    own = {field.name: getattr(numbering, field.name) for field in fields(Numbering)}
    return SpatialModel(**own, layout=layout, guess=start, unknowns=unknowns)


def guessed_model(layout: Layout) -> SpatialModel:
    """Return the line meshed for its first guess, where that has it.

    Raises
    ------
    InfeasibleError, InconsistentInputError
        If there is no such guess.
    """
    first = guess(layout)
    return build_model(layout, first, graded_meshes(layout, first))
