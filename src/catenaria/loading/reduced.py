r"""A built line reduced to its droppers: what it does where it is pushed, with droppers that go slack.

Everything but the droppers' decision to pull or to hang slack is linearised about the line at rest, once.

Notes
-----
At rest F(z) = 0, with the rows C of the elongations of droppers, see `Bars`. A force F_p along b, and clamps
that are nearer to each other than their droppers are long, by gaps y >= 0, move the line by

.. math:: \delta z = J^{-1}(F_p b - E (y - y_0)),

where J is the Jacobian with all droppers taut, the columns of E are the unit vectors of the rows C, and y_0
are the gaps at rest. With pulls P = l0 q (q: force density, l0: unstressed length),

.. math:: P = P_0 + F_p\, g + M (y - y_0), \quad y \ge 0, \quad P \ge 0, \quad y^T P = 0,

which is a linear complementarity problem (Cottle, Pang & Stone 1992, The Linear Complementarity Problem)
of the size of the number of droppers, whatever the line's number of unknowns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import loaded_system
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.loading.built_line import BuiltLine
from catenaria.mechanics.state import State
from catenaria.solvers.complementarity import solve_complementarity
from catenaria.solvers.linear import Factorisation, factorise

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]
Matrix = Any  # SciPy's csr_array
Listener = Callable[[int, int], None]

SLACK = 1e-6  # N: a dropper that pulls less is slack
_AT_ONCE = 16  # right-hand sides that SuperLU solves together; more fall out of the processor's cache


@dataclass(frozen=True)
class ReducedLine:
    """A built line about its rest, as its droppers see it.

    Attributes
    ----------
    model : SpatialModel
        The line, whose unknowns start at rest.
    factors : Factorisation
        Of the Jacobian with all droppers taut.
    pull : FloatArray, shape (n_droppers,)
        l0 q at rest [N]; 0 of slack ones.
    gap : FloatArray, shape (n_droppers,)
        By how much slack droppers are longer than what is between their clamps, at rest [m].
    stiffness : FloatArray, shape (n_droppers, n_droppers)
        M, by how much pulls change with gaps [N/m].
    """

    model: SpatialModel
    factors: Factorisation
    pull: FloatArray
    gap: FloatArray
    stiffness: FloatArray

    @classmethod
    def of(cls, built: BuiltLine) -> ReducedLine:
        """Return a line about its rest.

        Raises
        ------
        NotConvergedError, InfeasibleError
            If it finds no rest.
        """
        rest = built.at_rest
        model, z = rest.model, rest.z
        model = replace(model, unknowns=replace(model.unknowns, start=z))
        taut = loaded_system(model, z, np.zeros(z.size), built.devices, may_push=True)
        factors = factorise(taut.jacobian(State.at_rest(z)), permc_spec="NATURAL")
        slack = rest.dropper_pull <= SLACK
        shortfall = -taut.residual(State.at_rest(z))[model.density]
        stiffness = np.empty((slack.size, slack.size))
        for some, column in _columns(factors, model.density, z.size):
            stiffness[:, some] = -z[model.length][:, None] * column[model.density]
        pull = z[model.length] * z[model.density]
        return cls(
            model,
            factors,
            np.where(slack, 0.0, pull),
            np.where(slack, np.maximum(shortfall, 0.0), 0.0),
            stiffness,
        )

    @property
    def slack(self) -> Mask:
        """Which droppers are slack at rest."""
        return self.pull == 0.0

    def respond(self, forces: Matrix, progress: Listener | None = None) -> Responses:
        """Return what unit forces do to a line whose droppers all stay taut.

        Parameters
        ----------
        forces : csr_array, shape (n_points, n_unknowns)
            Generalised forces, each of unit size.
        progress : callable, optional
            Receives the number of points that are done, and of all.
        """
        model, count = self.model, forces.shape[0]
        own, pull = np.empty(count), np.empty((count, self.pull.size))
        opening = np.empty((count, self.pull.size))
        for some, column in _columns(self.factors, model.density, model.unknowns.size):
            opening[:, some] = forces @ column
        length = model.unknowns.start[model.length]
        for first in range(0, count, _AT_ONCE):
            rows = forces[first : first + _AT_ONCE]
            some = slice(first, first + rows.shape[0])
            moved = self.factors.solve(np.asfortranarray(rows.toarray().T))
            own[some] = rows.multiply(moved.T).sum(axis=1)
            pull[some] = (length[:, None] * moved[model.density]).T
            if progress is not None:
                progress(some.stop, count)
        return Responses(forces, own, pull, opening)

    def start(self, forces: Matrix, force: float, gap: FloatArray) -> FloatArray:
        """Return the unknowns under a force with given gaps, to first order; `forces` has one row."""
        load = force * forces.toarray()[0]
        load[self.model.density] -= gap - self.gap
        return self.model.unknowns.start + self.factors.solve(load)


@dataclass(frozen=True)
class Responses:
    """What unit forces do to a line whose droppers all stay taut.

    Attributes
    ----------
    forces : csr_array, shape (n_points, n_unknowns)
        The forces b.
    own : FloatArray, shape (n_points,)
        How far their own points move along them [m/N].
    pull : FloatArray, shape (n_points, n_droppers)
        By how much pulls change [N/N].
    opening : FloatArray, shape (n_points, n_droppers)
        How far the points move against the forces for each gap [m/m].
    """

    forces: Matrix
    own: FloatArray
    pull: FloatArray
    opening: FloatArray


@dataclass(frozen=True)
class Pushes:
    """What forces do to a line, one at a time.

    Attributes
    ----------
    elasticity : FloatArray, shape (n_points,)
        How far each point moves along its force, by the force [m/N].
    gap : FloatArray, shape (n_points, n_droppers)
        Gaps of slack droppers [m].
    slack : NDArray of bool, shape (n_points, n_droppers)
        Which droppers are slack.
    """

    elasticity: FloatArray
    gap: FloatArray
    slack: Mask


def push(reduced: ReducedLine, responses: Responses, force: float) -> Pushes:
    """Return what a force of a given size does at each point.

    Parameters
    ----------
    reduced : ReducedLine
        The line.
    responses : Responses
        To unit forces.
    force : float
        Size of the force [N]; 0 for the limit of a small one, in which droppers stay as they are at rest.

    Raises
    ------
    NotConvergedError
        If no set of slack droppers fits.
    """
    if force == 0.0:
        return _touch(reduced, responses)
    M, count = reduced.stiffness, responses.own.size
    gap, slack = np.empty((count, reduced.pull.size)), np.empty((count, reduced.pull.size), dtype=np.bool_)
    constant, open_ = reduced.pull - M @ reduced.gap, reduced.slack
    for i, change in enumerate(responses.pull):
        found = solve_complementarity(M, constant + force * change, open_)
        open_ = found.open  # a good guess for the next point
        gap[i], slack[i] = found.opening, open_
    moved = np.einsum("ij,ij->i", responses.opening, gap - reduced.gap)
    return Pushes(responses.own - moved / force, gap, slack)


def _touch(reduced: ReducedLine, responses: Responses) -> Pushes:
    """Return the limit of small forces: what is slack at rest stays so."""
    at = np.flatnonzero(reduced.slack)
    gap = np.linalg.solve(reduced.stiffness[np.ix_(at, at)], -responses.pull[:, at].T).T
    elasticity = responses.own - np.einsum("ij,ij->i", responses.opening[:, at], gap)
    shape = responses.pull.shape
    return Pushes(
        elasticity, np.broadcast_to(reduced.gap, shape).copy(), np.broadcast_to(reduced.slack, shape).copy()
    )


def _columns(factors: Factorisation, rows: IntArray, size: int) -> Iterator[tuple[slice, FloatArray]]:
    """Yield columns of the inverse of a matrix, some at a time."""
    for first in range(0, rows.size, _AT_ONCE):
        some = slice(first, min(first + _AT_ONCE, rows.size))
        unit = np.zeros((size, some.stop - first), order="F")
        unit[rows[some], np.arange(some.stop - first)] = 1.0
        yield some, factors.solve(unit)
