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
    Statics linearised at z: controls whose errors are beyond their bands come to the edge of these, m_z dz =
    -(e - band), the parameters of the others rest, dp = 0, and everything else stays in balance.
    """
    parameter = np.concatenate([control.parameter for control in controls])
    beyond = np.concatenate([control.law.beyond(control.error(t, z)) for control in controls])
    moving = beyond != 0.0
    if not moving.any():
        return 0.0
    J = _with_rows(system.jacobian(State.at_rest(z, t)), parameter, moving, controls, t, z)
    wanted = np.zeros(system.size)
    wanted[parameter[moving]] = -beyond[moving]
    return float(np.max(np.abs(factorise(J).solve(wanted)[parameter[moving]])))


def _with_rows(
    J: csc_matrix,
    parameter: NDArray[np.int64],
    moving: NDArray[np.bool_],
    controls: Sequence[Controls],
    t: float,
    z: FloatArray,
) -> csc_matrix:
    """Return J with the gradients of what is measured in the rows of moving parameters, 1 in the others'."""
    replaced = np.zeros(J.shape[0], dtype=np.bool_)
    replaced[parameter] = True
    kept = csc_matrix((np.where(replaced[J.indices], 0.0, J.data), J.indices, J.indptr), shape=J.shape)
    rows, columns, values = [parameter[~moving]], [parameter[~moving]], [np.ones(np.count_nonzero(~moving))]
    first = 0
    for control in controls:
        own = moving[first : first + control.parameter.size]
        first += control.parameter.size
        column, gradient = control.measure.columns()[own], control.measure.gradient(t, z)[own]
        rows.append(np.repeat(control.parameter[own], column.shape[1]))
        columns.append(column.ravel())
        values.append(gradient.ravel())
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    total = csc_matrix(kept + csc_matrix(entries, shape=J.shape))
    total.eliminate_zeros()
    return total


def largest_speed(system: System, zd: FloatArray) -> float:
    """Return the largest component of any node's velocity [m/s]."""
    return float(np.max(np.abs(zd[system.unknowns.where(Kind.POSITION)])))
