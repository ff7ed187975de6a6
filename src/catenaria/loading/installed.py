"""A built line with errors of its installation, at rest.

Nearly all errors are constants of the equations: a length or a clamp that is given, a point at which a wire
is held, a tension. They are put on the right-hand side; only hinges of steady arms are really moved. All
samples therefore share one system and the factors of its Jacobian.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array  # pyright: ignore[reportMissingTypeStubs]

from catenaria.discretise.spatial.layout import across
from catenaria.discretise.spatial.loaded import loaded_system
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.formfinding.static_problem import StaticProblem, static_problem
from catenaria.line import Line, Wire
from catenaria.loading.built_line import BuiltLine, LoadedLine
from catenaria.loading.errors_of_installation import ErrorSources
from catenaria.mechanics.contribution import Contribution
from catenaria.mechanics.elements.arms import Arms
from catenaria.mechanics.loads.dead import DeadLoads
from catenaria.mechanics.system import System
from catenaria.solvers.chord import solve_chord
from catenaria.solvers.linear import Factorisation
from catenaria.solvers.newton import NewtonOptions, solve_newton

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_NEWTON = NewtonOptions(max_iterations=25, permc_spec="NATURAL")
_COARSE = 10.0  # times the tolerances of form-finding: 10 nm, and forces that are off by 0.1 mN
_AHEAD = 0.5  # by which the slope of the track is measured [m]

Entry = tuple[IntArray, FloatArray]  # rows of the residual, and by how much they change


@dataclass(frozen=True)
class InstalledLine:
    """A built line into which errors are put.

    Attributes
    ----------
    built : BuiltLine
        The line as it was found.
    sources : ErrorSources
        What may be wrong with it, m errors.
    z : FloatArray, shape (n,)
        Where it rests without errors.
    problem : StaticProblem
        Its equations without errors, with joints that fit z.
    """

    built: BuiltLine
    sources: ErrorSources
    z: FloatArray
    problem: StaticProblem

    @classmethod
    def of(cls, built: BuiltLine, sources: ErrorSources) -> InstalledLine:
        """Return the line ready for errors.

        Raises
        ------
        NotConvergedError, InfeasibleError
            If it does not rest where it was found.
        """
        z = built.at_rest.z
        system = loaded_system(built.model, built.model.unknowns.start, np.zeros(z.size), built.devices)
        problem = static_problem(system)
        coarse = replace(problem, correction=_COARSE * problem.correction, force=_COARSE * problem.force)
        return cls(built, sources, z, coarse.reselect(z) or coarse)

    @property
    def model(self) -> SpatialModel:
        """The line."""
        return self.built.model

    @property
    def factors(self) -> Factorisation:
        """LU of the Jacobian at rest without errors."""
        return self.built.factors

    def problem_with(self, p: FloatArray) -> StaticProblem:
        """Return the equations of the line with errors p, shape (m,)."""
        system = self.problem.system
        load, shift = self.constants @ p, self._shift(p)
        parts = tuple(self._with(part, load, shift) for part in system.contributions)
        return replace(self.problem, system=System(system.unknowns, parts, system))

    def rest(self, p: FloatArray) -> FloatArray:
        """Return the unknowns at rest with errors p, shape (m,), starting where the line rests without.

        Raises
        ------
        NotConvergedError, InfeasibleError
            If no rest is found.
        """
        problem = self.problem_with(p)
        near = solve_chord(problem, self.z, self.factors)
        return solve_newton(problem, self.z, _NEWTON, factors=self.factors).y if near is None else near

    def outputs(self, z: FloatArray, p: FloatArray) -> FloatArray:
        """Return what is observed of the line with errors p at z.

        Returns
        -------
        FloatArray, shape (count,)
            Heights of lower wires at droppers above the track [m], forces in droppers [N], and forces at the
            starts and the ends of all wires with anchored ends [N].
        """
        loaded = LoadedLine(self.model, z, 0)
        clamped = self.sources.of("dropper position")
        height = loaded.height
        height[self.sources.part[clamped]] -= self._rise[self.sources.part[clamped]] * p[clamped]
        force = np.linalg.norm(loaded.end_force[self.untied], axis=2)
        return np.concatenate((height, loaded.dropper_pull, force.ravel()))

    @property
    def count(self) -> int:
        """Number of outputs."""
        return 2 * (self.model.length.size + self.untied.size)

    @cached_property
    def untied(self) -> IntArray:
        """Indices of the wires whose ends are anchored."""
        return np.flatnonzero([not wire.tied for wire in self.model.layout.wires])

    @cached_property
    def _rise(self) -> FloatArray:
        """How the track rises along itself where droppers hang, normal to it."""
        frame = self.model.layout.droppers.frame
        before, behind = (
            self.built.line.alignment.frames(frame.chainage + way * _AHEAD) for way in (-1.0, 1.0)
        )
        return np.einsum("ni,ni->n", frame.up, behind.origin - before.origin) / (2.0 * _AHEAD)

    @cached_property
    def constants(self) -> Any:
        """What each error adds to what the residual subtracts, shape (n, m); without hinges of arms."""
        shape = (self.z.size, self.sources.count)
        entries = list(self._entries())
        if not entries:
            return csr_array(shape)
        rows, values = (np.concatenate(part) for part in zip(*entries, strict=True))
        columns = np.repeat(np.arange(len(entries)), [row.size for row, _ in entries])
        return csr_array((values, (rows, columns)), shape=shape)

    @property
    def moves_hinge(self) -> NDArray[np.bool_]:
        """Mask of the errors that move hinges of arms, which are no constants."""
        of_hold = ~self.sources.of("dropper length", "dropper position", "tension")
        part = np.where(of_hold, self.sources.part, 0)
        return of_hold & self.model.layout.holds.hinged[part]

    def _entries(self) -> Iterator[Entry]:
        """Yield the rows in which each error stands."""
        model, lower, upper = self.model, *self._along_clamps
        for group, i in zip(self.sources.group, self.sources.part.tolist(), strict=True):
            if group == "dropper length":
                yield model.length[[i]], np.ones(1)
            elif group == "dropper position":
                rows = np.array([model.lower_s[i], model.upper_s[i]])
                yield rows, 1.0 / np.array([lower[i], upper[i]])
            elif group == "tension":
                yield model.pull[[i]], np.ones(1)
            else:
                frame = model.layout.holds.frame
                field = "height" if group.endswith("height") else "stagger"
                way = (frame.up if field == "height" else frame.left)[i]
                rows, values = zip(self._held(i, way), *self._anchored(i, field, way), strict=True)
                yield np.concatenate(rows), np.concatenate(values)

    @cached_property
    def _along_clamps(self) -> tuple[FloatArray, FloatArray]:
        """Metres of track per metre of lower and of upper wire at the droppers' clamps."""
        model, z, t = self.model, self.z, self.model.layout.droppers.frame.along
        ends = ((model.lower_carrier, model.lower_s), (model.upper_carrier, model.upper_s))
        lower, upper = (np.einsum("ni,ni->n", t, on.evaluate(z, z[s]).r1) for on, s in ends)
        return lower, upper

    def _held(self, i: int, way: FloatArray) -> Entry:
        """Return the rows of a place where a wire is held, and how they change if it moves by a unit."""
        model, holds = self.model, self.model.layout.holds
        if holds.hinged[i]:
            return np.empty(0, np.int64), np.empty(0)
        if holds.kind[i] == "cantilever":
            root = [part.hold for part in model.layout.cantilevers].index(i)
            return model.root_force[root, :3], way
        if not holds.guided[i]:
            return model.roller_force[np.count_nonzero(~holds.guided[:i])], way
        placed = holds.guided & ~holds.hinged
        aside, up = model.across_force[np.count_nonzero(placed[:i])]
        rises = way[2] if np.isnan(holds.lift[i]) else 0.0  # a lifted wire finds its height itself
        return np.array([aside, up]), np.array([across(holds.frame)[i] @ way, rises])

    def _anchored(self, i: int, field: Literal["height", "stagger"], way: FloatArray) -> Iterator[Entry]:
        """Yield the rows of a wire's end behind this place, if it shares its height or stagger."""
        on = self.model.layout.holds.wire
        k = int(on[i])
        wire = line_wire(self.built.line, self.model.layout.wires[k].role)
        own = np.flatnonzero(on == k)
        for end, anchor in enumerate((wire.anchor_start, wire.anchor_end)):
            given = None if anchor is None else getattr(anchor, field)
            if given is None and i == own[-end]:
                yield self.model.end_force[k, end], way

    def _shift(self, p: FloatArray) -> FloatArray:
        """Return by how much hinges of arms are off, shape (n_arms, 3)."""
        holds, shift = self.model.layout.holds, np.zeros((self.model.hold_s.size, 3))
        for direction, own in (
            (holds.frame.up, self.sources.of("contact height", "messenger height")),
            (holds.frame.left, self.sources.of("contact stagger", "messenger stagger")),
        ):
            part = self.sources.part[own]
            shift[part] += p[own, None] * direction[part]
        return shift[holds.hinged]

    def _with(self, part: Contribution, load: FloatArray, shift: FloatArray) -> Contribution:
        if isinstance(part, DeadLoads):
            return DeadLoads(part.force + load)
        return replace(part, hinge=part.hinge + shift) if isinstance(part, Arms) else part


def line_wire(line: Line, role: str) -> Wire:
    """Return what a line file says of the wires in a role that supports hold."""
    if role == "auxiliary messenger" and line.auxiliary_messenger is not None:
        return line.auxiliary_messenger
    return line.messenger_wire if role == "messenger wire" else line.contact_wire
