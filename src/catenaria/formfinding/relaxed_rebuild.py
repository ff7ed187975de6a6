"""The rebuilt line brought to rest by dynamic relaxation: no matrix, no multipliers, no Newton iteration.

Unknowns are the nodal coordinates of both wires. Wire ends stand where they were pulled to, droppers are bars
clamped to the wires, supports are stiff springs normal to the wires.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.line_model import HungWire, LineModel
from catenaria.formfinding.elastic_supports import ElasticSupports
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.elements.cable import CableElements
from catenaria.mechanics.loads.gravity import Gravity, Ramp
from catenaria.mechanics.state import State
from catenaria.solvers.dynamic_relaxation import relax
from catenaria.solvers.relaxation_values import RelaxationOptions

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_FORCE = 1e-4  # N and N m: negligible residual, 1 um of height in a span of 65 m
_ROUND_OFF = 10.0  # in units of the stiffest element's force when a coordinate changes in its last bit
_SUPPORT = 1e9  # N/m: gives way by 1 um under a span's weight, and slows nothing down
_OPTIONS = RelaxationOptions(mass_factor=3.0, mass_interval=10)  # wires that are thrown off turn quickly
_SEED, _WAVES = 2017, 3
_LATERAL, _ALONG = 0.03, 0.001  # m: sizes of the disturbance; along a wire 1 mm is worth a kilonewton


@dataclass(frozen=True)
class BuiltLine:
    """`catenaria.solvers.relaxation_values.RelaxationProblem` of a line whose lengths are given.

    Parameters
    ----------
    model : LineModel
        The line.
    z : FloatArray
        Its unknowns: lengths, clamps, pulls and wire ends are given by them, the others do not matter.
    """

    model: LineModel
    z: FloatArray

    @property
    def wires(self) -> tuple[HungWire, HungWire]:
        """Contact wire and messenger wire."""
        return self.model.contact, self.model.messenger

    @cached_property
    def free(self) -> IntArray:
        """Indices of the nodal coordinates but for the positions of wire ends."""
        nodes, ends = (
            np.concatenate([hung.wire.nodes[rows, :columns].ravel() for hung in self.wires])
            for rows, columns in ((slice(None), 6), ([0, -1], 3))
        )
        return np.setdiff1d(nodes, ends)

    @cached_property
    def elements(self) -> CableElements:
        """The elements of both wires."""
        return CableElements.of([hung.wire for hung in self.wires], self.model.contact.setup.gauss_points)

    @cached_property
    def supports(self) -> tuple[ElasticSupports, ElasticSupports]:
        """The supports of both wires."""
        lower, upper = (
            ElasticSupports(hung.wire, _points(hung), self.z[hung.support_s], _SUPPORT) for hung in self.wires
        )
        return lower, upper

    @cached_property
    def _loads(self) -> tuple[Contribution, Contribution]:
        g = self.model.contact.setup.g
        gravity = Gravity(self.elements.weight(self.z.size), g, Ramp(0.0))
        return gravity, self.model.droppers(self.z, clamped=True)

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.free.size

    @property
    def force_scale(self) -> FloatArray:
        """Size of a negligible residual, above round-off where chainages are large."""
        return self._negligible

    @cached_property
    def _negligible(self) -> FloatArray:
        last_bit = np.spacing(np.abs(self.z[self.free]).max())
        stiffest = np.max(self.elements.EA / self.elements.L)
        return np.full(self.size, max(_FORCE, _ROUND_OFF * float(stiffest * last_bit)))

    def unknowns(self, y: FloatArray) -> FloatArray:
        """Return the line's unknowns with nodal coordinates y."""
        z = self.z.copy()
        z[self.free] = y
        return z

    def forces(self, z: FloatArray) -> FloatArray:
        """Return internal minus external forces on all nodes, in the numbering of the line."""
        f, state = np.zeros(z.size), _at_rest(z)
        for part in (self.elements, *self._loads, *self.supports):
            part.add_residual(state, f)
        return f

    def residual(self, y: FloatArray) -> FloatArray:
        """Return f(y)."""
        return self.forces(self.unknowns(y))[self.free]

    def stiffness_bound(self, y: FloatArray) -> FloatArray:
        """Return row sums of all element matrices; droppers that are slack count as taut."""
        z, sums = self.unknowns(y), np.zeros(self.z.size)
        bars = self.model.droppers(z, clamped=True, may_push=True)
        wires = (self.elements.dofs, self.elements.stiffness(z))
        rows, columns = bars.pattern()
        nodal = np.isin(rows, self.free) & np.isin(columns, self.free)
        sums += np.bincount(rows, np.abs(bars.jacobian(_at_rest(z), 0.0, 0.0)) * nodal, z.size)
        for dofs, K in (wires, *(supports.stiffness(z) for supports in self.supports)):
            sums += np.bincount(dofs.ravel(), np.abs(K).sum(axis=2).ravel(), z.size)
        return sums[self.free]


def rest_by_relaxation(model: LineModel, z: FloatArray) -> tuple[FloatArray, int]:
    """Disturb a line that is about in its place, and let it come to rest by dynamic relaxation.

    Parameters
    ----------
    model : LineModel
        The line.
    z : FloatArray, shape (n,)
        Its unknowns; lengths, clamps and pulls are given by them. Wires must be under tension.

    Returns
    -------
    z : FloatArray, shape (n,)
        At rest, with the forces of supports and wire ends.
    iterations : int
        Evaluations of the forces.

    Raises
    ------
    NotConvergedError
        See `catenaria.solvers.dynamic_relaxation.relax`.
    """
    generator = np.random.default_rng(_SEED)
    start = z.copy()
    for hung in (model.contact, model.messenger):
        _carry_to_ends(hung, model.unknowns.start, start)
        _disturb(hung, generator, start)
    built = BuiltLine(model, start)
    with np.errstate(over="ignore", invalid="ignore"):  # `relax` refuses forces that are not finite
        relaxed = relax(built, start[built.free], _OPTIONS)
    return _with_reactions(built, built.unknowns(relaxed.y)), relaxed.iterations


def _carry_to_ends(hung: HungWire, laid_out: FloatArray, z: FloatArray) -> None:
    """Stretch a wire so that its ends are where its pull has them."""
    nodes, knots = hung.wire.nodes, hung.wire.knots
    ends = nodes[[0, -1], :3]
    wanted = laid_out[ends] + np.outer([-1.0, 1.0], [1.0, 0.0, 0.0]) * z[hung.pull]
    first, last = wanted - z[ends]
    z[nodes[:, :3]] += first + np.outer(knots / knots[-1], last - first)
    z[nodes[:, 3:]] += (last - first) / knots[-1]


def _disturb(hung: HungWire, generator: np.random.Generator, z: FloatArray) -> None:
    """Throw the bays of a wire off their places by smooth waves, zero and level at supports."""
    nodes, held = hung.wire.nodes, hung.setup.support_x
    x = z[nodes[:, 0]]
    bay = np.clip(np.searchsorted(held, x, side="right") - 1, 0, held.size - 2)
    inside = (x > held[0]) & (x < held[-1])
    for wave in range(1, _WAVES + 1):
        size = np.array([_ALONG, _LATERAL, _LATERAL]) / wave
        amplitude = 0.5 * generator.normal(size=(held.size - 1, 3)) * size
        frequency = 2.0 * np.pi * wave / np.diff(held)[bay]
        phase = frequency * (x - held[bay])
        z[nodes[:, :3]] += (inside * (1.0 - np.cos(phase)))[:, None] * amplitude[bay]
        z[nodes[:, 3:]] += (inside * frequency * np.sin(phase))[:, None] * amplitude[bay]


def _with_reactions(built: BuiltLine, z: FloatArray) -> FloatArray:
    """Return z with the sliding coordinates and forces at supports, and the forces at wire ends."""
    at_rest, forces = z.copy(), built.forces(z)
    for hung, supports in zip(built.wires, built.supports, strict=True):
        at_rest[hung.support_s], point = supports.closest(z)
        at_rest[hung.support_force] = supports.force(point)
        at_rest[hung.end_force] = -forces[hung.wire.nodes[[0, -1], :3]]
    return at_rest


def _points(hung: HungWire) -> FloatArray:
    """Return the places of a wire's supports [m], shape (m, 3)."""
    x = hung.setup.support_x
    return np.column_stack((x, np.zeros_like(x), np.full_like(x, hung.setup.height)))


def _at_rest(z: FloatArray) -> State:
    rest = np.zeros_like(z)
    return State(0.0, z, rest, rest)
