"""A found line at rest, linearised: mass, tangent stiffness and constraints by nodes and sliding coordinates.

All lengths are given and all clamps are closed; wires go on running over rollers. Weights of droppers and
arms are dead forces here, as large as they are at rest, so that the stiffness is symmetric.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.demands import as_built
from catenaria.discretise.spatial.found import found_model
from catenaria.discretise.spatial.layout import LaidDroppers
from catenaria.discretise.spatial.model import FULL, SpatialModel
from catenaria.export.masses import Lumps, lumps
from catenaria.export.tangent import Tangent, sparse, tangent
from catenaria.formfinding.static_problem import find_rest
from catenaria.line import Line
from catenaria.mechanics.chain import Chain
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.loads.linear import assemble
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind
from catenaria.results import FormResult

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_NOTHING = 1e-6  # N


@dataclass(frozen=True)
class RestingLine:
    """A line at rest.

    Attributes
    ----------
    line, result
        What was described, and what was found.
    model : SpatialModel
        The line, with the weights of droppers in their clamps.
    system : System
        Its equations.
    z : FloatArray, shape (n,)
        All unknowns at rest.
    """

    line: Line
    result: FormResult
    model: SpatialModel
    system: System
    z: FloatArray

    @classmethod
    def of(cls, line: Line, result: FormResult) -> RestingLine:
        """Return a found line at rest.

        Raises
        ------
        UnsupportedError
            If the result has no nodes to start from.
        NotConvergedError, InfeasibleError
            If the line does not come to rest.
        """
        model = _with_dead_weights(found_model(line, result))
        start = model.unknowns.start
        system = as_built(model, start)
        z = find_rest(system, start).y
        return cls(line, result, model, system.relocate(z) or system, z)

    @property
    def strands(self) -> tuple[Chain, ...]:
        """Wires, then cantilevers."""
        return (*self.model.wires, *self.model.cantilevers)

    @cached_property
    def running(self) -> NDArray[np.bool_]:
        """Which holds let their wires run without friction, shape (n_holds,); those with friction stick."""
        holds = self.model.layout.holds
        closed = np.array([kind == "clamped" for kind in holds.kind], dtype=np.bool_)
        return ~holds.guided & ~closed & (holds.friction == 0.0)

    @cached_property
    def coordinates(self) -> IntArray:
        """Unknowns that are coordinates: r and r' of all nodes, strand by strand, then sliding ones."""
        nodes = np.concatenate([chain.nodes for chain in self.strands]).ravel()
        return np.concatenate((nodes, self.model.hold_s[self.running]))

    @cached_property
    def slack(self) -> NDArray[np.bool_]:
        """Which droppers carry nothing, shape (n_droppers,); as far as matrices go, they are not there."""
        return self.z[self.model.density] * self.dropper_reach < _NOTHING

    @cached_property
    def springs(self) -> NDArray[np.bool_]:
        """Which droppers are springs, shape (n_droppers,)."""
        return ~self.slack & (self.model.layout.droppers.flexibility > 0.0)

    @cached_property
    def rigid(self) -> NDArray[np.bool_]:
        """Which droppers are constraints, shape (n_droppers,)."""
        return ~self.slack & ~self.springs

    @cached_property
    def multipliers(self) -> IntArray:
        """Unknowns that are forces of constraints, in the order of their numbers in the system."""
        every = np.flatnonzero(self.model.unknowns.where(Kind.MULTIPLIER))
        return np.setdiff1d(every, self.model.density[~self.rigid])

    @cached_property
    def lumps(self) -> Lumps:
        """Masses at points of wires."""
        return lumps(self.model, self.z)

    @cached_property
    def residual(self) -> tuple[float, float]:
        """Largest force that is not balanced [N, N m] and largest violation of a constraint [m]."""
        f = self.system.residual(State.at_rest(self.z))
        return float(np.abs(f[self.coordinates]).max()), float(np.abs(f[self.multipliers]).max())

    @cached_property
    def tangent(self) -> Tangent:
        """The linearised equations."""
        jacobian = self.system.jacobian(State.at_rest(self.z))
        springs = self.model.density[self.springs]
        return tangent(
            jacobian, self._mass(), self.coordinates, self.multipliers, springs, 1.0 / self.bar_length
        )

    @cached_property
    def bar_length(self) -> FloatArray:
        """Lengths of arms and rigid droppers [m], whose unknowns are N/m, and 1 for other constraints."""
        model, length = self.model, np.ones(self.multipliers.size)
        length[self.rows(model.arm_density)] = model.layout.holds.arm_length[model.layout.holds.hinged]
        length[self.rows(model.density[self.rigid])] = self.dropper_reach[self.rigid]
        return length

    @cached_property
    def constraint_force(self) -> FloatArray:
        """Forces of constraints mu at rest, shape (m,): C^T mu is what they take from the line [N]."""
        return self.z[self.multipliers] * self.bar_length

    @cached_property
    def dropper_reach(self) -> FloatArray:
        """Distances between the clamps of droppers [m]."""
        return _distances(self.model, self.z)

    @cached_property
    def load(self) -> FloatArray:
        """Dead forces on all coordinates: weights of wires, droppers, arms and masses [N], shape (n,)."""
        size, lumped, layout = self.z.size, self.lumps, self.model.layout
        force = np.zeros(size)
        for elements in self._elements():
            force += layout.g * elements.weight(size)
        point = lumped.carrier.evaluate(self.z, lumped.s)
        np.subtract.at(force, point.dofs[:, :, 2], lumped.weight[:, None] * point.N)
        return force[self.coordinates]

    def rows(self, multipliers: IntArray) -> IntArray:
        """Return which constraints some multipliers belong to."""
        return np.searchsorted(self.multipliers, multipliers)

    def _elements(self) -> list[CableElements]:
        pieces = [self.model.pieces(FULL).elements] if self.model.has_pieces else []
        return [self.model.elements, *pieces]

    def _mass(self) -> Any:
        """Return the consistent mass matrix of wires and cantilevers, with point masses on them."""
        size, lumped = self.z.size, self.lumps
        parts = [assemble(elements, elements.mass(), size) for elements in self._elements()]
        point = lumped.carrier.evaluate(self.z, lumped.s)
        share = lumped.mass[:, None, None] * point.N[:, :, None] * point.N[:, None, :]
        rows, columns = np.broadcast_arrays(point.dofs[:, :, None, :], point.dofs[:, None, :, :])
        values = np.broadcast_to(share[..., None], rows.shape)
        where = rows.ravel(), columns.ravel()
        return sum(parts, sparse.csr_array(sparse.coo_array((values.ravel(), where), shape=(size, size))))


def _with_dead_weights(model: SpatialModel) -> SpatialModel:
    """Return the line with half of each dropper's weight in either clamp, as it is in the model's start."""
    droppers = model.layout.droppers
    half = 0.5 * droppers.rhoA * _distances(model, model.unknowns.start)
    dead: LaidDroppers = replace(
        droppers,
        rhoA=np.zeros_like(half),
        mass_bottom=droppers.mass_bottom + half,
        mass_top=droppers.mass_top + half,
    )
    return replace(model, layout=replace(model.layout, droppers=dead))


def _distances(model: SpatialModel, z: FloatArray) -> FloatArray:
    below = model.lower_carrier.evaluate(z, z[model.lower_s]).r
    above = model.upper_carrier.evaluate(z, z[model.upper_s]).r
    return np.linalg.norm(above - below, axis=1)
