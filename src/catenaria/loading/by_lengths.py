"""A built line as a function of the unstressed lengths of its droppers, and its derivatives.

Droppers may push here. A slack dropper would tell nothing of its length; one that may push tells how long it
can be at least, and a schedule in which none pushes is the same with droppers that can only pull.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import loaded_system
from catenaria.discretise.spatial.model import SpatialModel
from catenaria.formfinding.static_problem import static_problem
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.gauged import GaugedPoints
from catenaria.mechanics.chain import Points
from catenaria.solvers.linear import Factorisation, factorise
from catenaria.solvers.newton import NewtonOptions, solve_newton

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

_NEWTON = NewtonOptions(max_iterations=40, permc_spec="NATURAL")


@dataclass(frozen=True)
class Response:
    """A line at rest with droppers of given lengths, and how it changes with them.

    Attributes
    ----------
    length : FloatArray, shape (n,)
        Unstressed lengths of the droppers [m].
    z : FloatArray, shape (n_unknowns,)
        Unknowns at rest.
    factors : Factorisation
        LU of the Jacobian there.
    height, pull : FloatArray, shape (n,)
        Heights of the lower wires at droppers [m] and forces in droppers [N].
    gauged : FloatArray, shape (m,)
        Heights of the gauged points [m].
    height_slope, pull_slope : FloatArray, shape (n, n)
        Derivatives of heights and forces by the lengths, which go along the second axis.
    gauged_slope : FloatArray, shape (m, n)
        The same of the gauged heights.
    """

    length: FloatArray
    z: FloatArray
    factors: Factorisation
    height: FloatArray
    pull: FloatArray
    gauged: FloatArray
    height_slope: FloatArray
    pull_slope: FloatArray
    gauged_slope: FloatArray


def respond(
    built: BuiltLine, gauged: GaugedPoints, length: FloatArray, near: Response | None = None
) -> Response:
    r"""Return where a line rests with droppers of given lengths, and its derivatives by them.

    Parameters
    ----------
    built : BuiltLine
        The line.
    gauged : GaugedPoints
        Points whose heights are looked at besides those of the droppers.
    length : FloatArray, shape (n,)
        Unstressed lengths of the droppers [m].
    near : Response, optional
        For other lengths nearby.

    Raises
    ------
    NotConvergedError, InfeasibleError
        If no rest is found.

    Notes
    -----
    The lengths are given by equations l = l* of the system itself. So

    .. math:: J\,\frac{dz}{dl_i} = e_i,

    with the unit vector of the row of length i: one factorisation, and a solve for each dropper.
    """
    model = built.model
    z = (model.unknowns.start if near is None else near.z).copy()
    z[model.length] = length
    system = loaded_system(model, z, np.zeros(z.size), built.devices, may_push=True)
    problem = static_problem(system)
    factors = built.factors if near is None else near.factors
    root = solve_newton(problem, z, _NEWTON, factors=factors)
    factors = factorise(root.problem.jacobian(root.y), permc_spec="NATURAL")
    at_rest = _AtRest.of(model, gauged, root.y)
    slopes = [at_rest.changes(_response(factors, row, z.size)) for row in model.length.tolist()]
    height_slope, pull_slope, gauged_slope = (
        np.column_stack(columns) for columns in zip(*slopes, strict=True)
    )
    return Response(
        length,
        root.y,
        factors,
        at_rest.heights(),
        at_rest.pulls(),
        gauged.height(model, root.y),
        height_slope,
        pull_slope,
        gauged_slope,
    )


def _response(factors: Factorisation, row: int, size: int) -> FloatArray:
    """Return how all unknowns change with the one that is given in a row."""
    unit = np.zeros(size)
    unit[row] = 1.0
    return factors.solve(unit)


@dataclass(frozen=True)
class _AtRest:
    """What is looked at, evaluated once for all derivatives; clamps are fixed to their wires."""

    density: IntArray
    z: FloatArray
    below: Points
    above: Points
    gauged: Points
    origin: FloatArray
    up: FloatArray
    gauged_up: FloatArray

    @classmethod
    def of(cls, model: SpatialModel, gauged: GaugedPoints, z: FloatArray) -> _AtRest:
        frame = model.layout.droppers.frame
        below = model.lower_carrier.evaluate(z, z[model.lower_s])
        above = model.upper_carrier.evaluate(z, z[model.upper_s])
        points = gauged.points(model, z)
        return cls(model.density, z, below, above, points, frame.origin, frame.up, gauged.up)

    def heights(self) -> FloatArray:
        return _dot(self.up, self.below.r - self.origin)

    def pulls(self) -> FloatArray:
        return self.z[self.density] * np.linalg.norm(self.above.r - self.below.r, axis=1)

    def changes(self, dz: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return how heights, pulls q |d| and gauged heights change with the unknowns."""
        below, d = _moved(self.below, dz), self.above.r - self.below.r
        size = np.linalg.norm(d, axis=1)
        longer = _dot(d, _moved(self.above, dz) - below) / size
        pull = dz[self.density] * size + self.z[self.density] * longer
        return _dot(self.up, below), pull, _dot(self.gauged_up, _moved(self.gauged, dz))


def _moved(point: Points, dz: FloatArray) -> FloatArray:
    """Return how material points move, shape (n, 3)."""
    return np.einsum("nk,nki->ni", point.N, dz[point.dofs])


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.einsum("ni,ni->n", a, b)
