"""The dropper lengths of a built line that explain heights which were measured on it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.loading.built_line import BuiltLine
from catenaria.loading.by_lengths import Response, respond
from catenaria.loading.gauged import GaugedPoints

FloatArray = NDArray[np.float64]

SCATTER = 0.010  # m: standard deviation of built lengths from the schedule that is expected before measuring

_PASSES = 20
_RANK = 1e-9  # of the largest singular value: what is smaller is not determined
_CHANGE = 1e-7  # m: lengths that change by less have been found


def identify(built: BuiltLine, gauged: GaugedPoints, height: FloatArray, noise: float) -> Response:
    r"""Return the line with the lengths that explain measured heights.

    Parameters
    ----------
    built : BuiltLine
        The line as it was to be built.
    gauged : GaugedPoints
        Where heights were measured.
    height : FloatArray, shape (m,)
        What was measured [m].
    noise : float
        Standard deviation of the measurement [m]; 0 if heights are to be met as they are.

    Raises
    ------
    NotConvergedError
        If no such lengths are found.

    Notes
    -----
    The lengths l are the most probable ones if both deviations are normal (Tarantola 2005, chapter 3): with
    the schedule l_0 and the scatter sigma_l, the minimum of

    .. math:: \frac{|h(l) - h_m|^2}{\sigma_h^2} + \frac{|l - l_0|^2}{\sigma_l^2},

    found by Gauss and Newton's method. Without noise it is the least change of the schedule with which
    heights are met, and the only one if as many heights are measured as there are droppers.
    """
    scheduled = built.model.unknowns.start[built.model.length]
    found = respond(built, gauged, scheduled)
    for _ in range(_PASSES):
        length = scheduled + _step(found, scheduled, height, noise)
        done = float(np.abs(length - found.length).max()) < _CHANGE
        found = respond(built, gauged, length, found)
        if done:
            return found
    raise NotConvergedError(
        f"no lengths of droppers were found that explain the measured heights, after {_PASSES} passes",
        "check the heights that differ most from those that were found, or state --noise",
        found,
    )


def _step(found: Response, scheduled: FloatArray, height: FloatArray, noise: float) -> FloatArray:
    """Return the change of the schedule for the heights as they are linear about what was found."""
    S = found.gauged_slope
    wanted = height - found.gauged + S @ (found.length - scheduled)
    if noise == 0.0:
        return _least_squares(S, wanted)
    n = scheduled.size
    rows = np.vstack((S / noise, np.eye(n) / SCATTER))
    return _least_squares(rows, np.concatenate((wanted / noise, np.zeros(n))))


def _least_squares(A: FloatArray, b: FloatArray) -> FloatArray:
    """Return the smallest of all x with the least |A x - b|."""
    return np.asarray(np.linalg.lstsq(A, b, rcond=_RANK)[0], dtype=np.float64)
