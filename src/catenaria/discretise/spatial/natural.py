"""A state by natural coordinates: of tied wires, whose natural length is not that of their mesh."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.model import SpatialModel
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.unknowns import Kind

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Natural:
    """A state in which every material coordinate is the unstressed length from the wire's start.

    Attributes
    ----------
    model : SpatialModel
        The line.
    solved : FloatArray
        All unknowns, with coordinates of tied wires by the mesh.
    """

    model: SpatialModel
    solved: FloatArray

    @cached_property
    def stretch(self) -> FloatArray:
        """Natural length of every wire by that of its mesh, shape (n_wires,); 1 of untied wires."""
        model = self.model
        return np.array(
            [model.natural_length(self.solved, k) / wire.knots[-1] for k, wire in enumerate(model.wires)]
        )

    @cached_property
    def wires(self) -> tuple[Chain, ...]:
        """The wires with knots at natural coordinates; to be evaluated with `z`."""
        pairs = zip(self.model.wires, self.stretch, strict=True)
        return tuple(Chain(wire.nodes, wire.knots * factor, wire.section) for wire, factor in pairs)

    @cached_property
    def z(self) -> FloatArray:
        """All unknowns, with slopes and sliding coordinates by natural coordinates.

        Notes
        -----
        With s = l s_mesh, dr/ds = r'/l: the position at every point is the same.
        """
        z = self.solved.copy()
        for wire, factor in zip(self.model.wires, self.stretch, strict=True):
            if factor != 1.0:
                z[wire.nodes[:, 3:]] /= factor
        for at, on, _ in self.attached():
            z[at] *= self.stretch[on]
        return z

    def stations(self, wire: int) -> tuple[FloatArray, FloatArray]:
        """Return ascending natural coordinates of a wire [m], shape (n,), and their chainages [m]."""
        known = [(self.z[at[on == wire]], chainage[on == wire]) for at, on, chainage in self.attached()]
        ties = self.model.layout.ties
        own = ties.wire == wire
        known.append((ties.end[own] * self.wires[wire].knots[-1], ties.frame.chainage[own]))
        s, chainage = (np.concatenate(parts) for parts in zip(*known, strict=True))
        order = np.argsort(s)
        return s[order], chainage[order]

    def unknowns(self, kind: Kind) -> FloatArray:
        """Return the unknowns of one kind in the order of their numbers."""
        return self.z[self.model.unknowns.where(kind)]

    def attached(self) -> Iterator[tuple[IntArray, IntArray, FloatArray]]:
        """Yield sliding coordinates, the wires on which they are, and chainages."""
        model, layout = self.model, self.model.layout
        holds, droppers, ties, masses = layout.holds, layout.droppers, layout.ties, layout.masses
        yield model.hold_s, holds.wire, holds.frame.chainage
        yield model.lower_s, droppers.lower, droppers.frame.chainage
        yield model.upper_s, droppers.upper, droppers.frame.chainage
        yield model.tie_s, ties.host, ties.frame.chainage
        yield model.mass_s, masses.wire, masses.frame.chainage
