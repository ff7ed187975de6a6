"""When a controlled motion has come to rest.

The velocity law approaches its dead band like 1/t and never enters it, so two criteria are offered: every
error is within a factor of its dead band, or what the parameters would still travel is known to be
negligible.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix

from catenaria.mechanics.controls.control import Controls
from catenaria.mechanics.state import State
from catenaria.mechanics.system import System
from catenaria.mechanics.unknowns import Kind
from catenaria.solvers.linear import factorise

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Settled:
    """What counts as rest.

    Attributes
    ----------
    velocity : float
        Largest speed of any node [m/s].
    dead_bands : float
        Largest control error, in dead bands.
    remaining_travel : float
        Largest remaining travel of any control parameter [m].
    """

    velocity: float
    dead_bands: float
    remaining_travel: float


def largest_error(controls: Sequence[Controls], t: float, z: FloatArray) -> tuple[float, int, int]:
    """Return the largest control error in dead bands, the batch in which it is and its place there."""
    worst = (0.0, 0, 0)
    for batch, control in enumerate(controls):
        bands = np.abs(control.error(t, z)) / control.law.e0
        place = int(np.argmax(bands))
        worst = max(worst, (float(bands[place]), batch, place))
    return worst


def remaining_travel(system: System, controls: Sequence[Controls], t: float, z: FloatArray) -> float:
    """Estimate the largest travel of a parameter until every error is at the edge of its band [m].

    Parameters
    ----------
    system : System
        The system, with its discrete state.
    controls : sequence of Controls
        Its controls.
    t : float
        Time [s].
    z : FloatArray, shape (n,)
        Unknowns, close to rest.

    Notes
    -----
    Statics linearised at z give the errors' sensitivity to the parameters, de/dp = m_z dz/dp. Controls whose
    errors are beyond their bands move, the others rest, so the travel solves (de/dp)_AA dp_A = -(e - band)_A
    on the moving ones.
    """
    parameter = np.concatenate([control.parameter for control in controls])
    beyond = np.concatenate([control.law.beyond(control.error(t, z)) for control in controls])
    moving = np.flatnonzero(beyond)
    if moving.size == 0:
        return 0.0
    J = _with_given(system.jacobian(State.at_rest(z, t)), parameter)
    unit = np.zeros((system.size, moving.size))
    unit[parameter[moving], np.arange(moving.size)] = 1.0
    z_p = factorise(J).lu.solve(unit)
    e_p = np.concatenate([_error_slopes(control, t, z, z_p) for control in controls])
    return float(np.max(np.abs(np.linalg.solve(e_p[moving], -beyond[moving]))))


def _with_given(J: csc_matrix, rows: NDArray[np.int64]) -> csc_matrix:
    """Return J with the given rows replaced by those of the identity."""
    given = np.zeros(J.shape[0], dtype=np.bool_)
    given[rows] = True
    columns = np.repeat(np.arange(J.shape[0]), np.diff(J.indptr))
    data = np.where(given[J.indices], (J.indices == columns).astype(np.float64), J.data)
    return csc_matrix((data, J.indices, J.indptr), shape=J.shape)


def _error_slopes(control: Controls, t: float, z: FloatArray, z_p: FloatArray) -> FloatArray:
    columns, gradient = control.measure.columns(), control.measure.gradient(t, z)
    return np.einsum("nm,nmk->nk", gradient, z_p[columns])


def largest_speed(system: System, zd: FloatArray) -> float:
    """Return the largest component of any node's velocity [m/s]."""
    return float(np.max(np.abs(zd[system.unknowns.where(Kind.POSITION)])))
