"""First derivatives of what is observed of a line by the errors of its installation.

One factorisation serves all errors. The elasticity of the contact wire, itself a solution of the linearised
equations, is differentiated too, by the change of the Jacobian along each response.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from catenaria.discretise.spatial.loaded import material_at, point_load
from catenaria.loading.installed import InstalledLine
from catenaria.solvers.linear import Factorisation

FloatArray = NDArray[np.float64]

_STEP = {"m": 1e-4, "N": 10.0}  # of an error, for differences
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Linearised:
    """What is observed of a line as a linear function of the errors p: y = nominal + slope p.

    Attributes
    ----------
    nominal : FloatArray, shape (n_outputs,)
        Without errors; see `InstalledLine.outputs`.
    slope : FloatArray, shape (n_outputs, m)
        Derivatives by the errors.
    elasticity : FloatArray, shape (n_spans,)
        Uplift per force of the contact wire in the middle of each span, for small forces [m/N].
    elasticity_slope : FloatArray, shape (n_spans, m)
        Its derivatives by the errors.
    """

    nominal: FloatArray
    slope: FloatArray
    elasticity: FloatArray
    elasticity_slope: FloatArray

    def outputs(self, p: FloatArray) -> FloatArray:
        """Return what is observed with errors p, shape (..., m), as shape (..., n_outputs)."""
        return self.nominal + p @ self.slope.T

    def elasticities(self, p: FloatArray) -> FloatArray:
        """Return the elasticities at mid spans with errors p, shape (..., n_spans) [m/N]."""
        return self.elasticity + p @ self.elasticity_slope.T


def linearise(installed: InstalledLine) -> Linearised:
    r"""Return the derivatives of all outputs by all errors at the line without errors.

    Notes
    -----
    With F(z, p) = 0, the response to an error is x_k = -J^{-1} dF/dp_k. Derivatives of F and of outputs are
    central differences.
    """
    z, count = installed.z, installed.sources.count
    nominal = installed.outputs(z, np.zeros(count))
    slope, response = np.empty((nominal.size, count)), np.empty((z.size, count))
    for k, unit in enumerate(installed.sources.unit):
        p = np.zeros(count)
        p[k] = step = _STEP[unit]
        x = _response(installed, p)
        above, below = installed.outputs(z + x, p), installed.outputs(z - x, -p)
        slope[:, k], response[:, k] = (above - below) / (2.0 * step), x / step
    return Linearised(nominal, slope, *_elasticity(installed, response))


def _response(installed: InstalledLine, p: FloatArray) -> FloatArray:
    """Return by how much the unknowns change with errors p, to first order."""
    f1, f0 = (installed.problem_with(way * p).residual(installed.z) for way in (1.0, -1.0))
    return -installed.factors.solve(0.5 * (f1 - f0))


def _elasticity(installed: InstalledLine, response: FloatArray) -> tuple[FloatArray, FloatArray]:
    r"""Return the elasticity at mid spans and its derivatives by all errors.

    Notes
    -----
    A unit force b on the wire moves it by u = J^{-1} b and e = b.u. With w = J^{-T} b,

    .. math:: \frac{de}{dp_k} = -w^T\left(\sum_i\frac{\partial J}{\partial z_i} x_{ik}
        + \frac{\partial J}{\partial p_k}\right) u, \qquad
        w^T\frac{\partial J}{\partial z_i} u = \frac{d}{d\epsilon}\left(J(z + \epsilon u)^T w\right)_i ,

    so that the first term takes two Jacobians a span. The second is there for hinges of arms only.
    """
    z, problem = installed.z, installed.problem
    b, u, w = _unit_forces(installed)
    slope = np.empty((u.shape[1], response.shape[1]))
    for j, (way, dual) in enumerate(zip(u.T, w.T, strict=True)):
        above, below = problem.jacobian(z + way), problem.jacobian(z - way)
        slope[j] = -0.5 * ((above.T @ dual - below.T @ dual) @ response)
    for k in np.flatnonzero(installed.moves_hinge).tolist():
        p = np.zeros(response.shape[1])
        p[k] = step = _STEP["m"]
        above, below = (installed.problem_with(way * p).jacobian(z) for way in (1.0, -1.0))
        slope[:, k] -= np.einsum("nj,nj->j", w, above @ u - below @ u) / (2.0 * step)
    return np.einsum("jn,nj->j", b, u), slope


def _unit_forces(installed: InstalledLine) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return unit forces b on the first contact wire at mid spans, shape (n_spans, n), and u, w by column."""
    line, x = installed.built.line, np.array(installed.built.line.support_x)
    middle = material_at(installed.model, 0, line.alignment, 0.5 * (x[:-1] + x[1:]))
    b = point_load(installed.model, 0, middle, np.tile(_UP, (middle.size, 1)))
    factors: Factorisation = installed.factors
    u = np.column_stack([factors.solve(row) for row in b])
    return b, u, np.column_stack([factors.solve_transposed(row) for row in b])
