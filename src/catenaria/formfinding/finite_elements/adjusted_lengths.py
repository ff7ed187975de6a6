"""Finite elements with adjusted dropper lengths [15, 16]: Newton's method on the lengths.

Our reconstruction of the family: the originals adjust lengths by trial (see `trial_lengths`); here every
adjustment uses what each length does to every height.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements.found import Found, found_state
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.rest import LineState, come_to_rest
from catenaria.formfinding.finite_elements.start import first_guess
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

_TOLERANCE = 1e-8  # m, of the heights
_ROUNDS = 30
_SMALLEST = 0.1  # part of a change of lengths that is halved once more


def adjust_lengths(line: Line, start: FormResult | None) -> Found:
    r"""Find the dropper lengths with which the contact wire rests at the wanted heights.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    start : FormResult or None
        An earlier result to begin from.

    Returns
    -------
    Found

    Raises
    ------
    NotConvergedError
        If lengths or a state of equilibrium are not found.

    Notes
    -----
    For given unstressed lengths :math:`l_0` the line comes to rest, R(y, l_0) = 0, with heights z(y) at the
    droppers. Newton's method for z = z*:

    .. math:: \frac{dz}{dl_0} = -C\,R_y^{-1} R_{l_0},\qquad
              \Delta l_0 = -\left(\frac{dz}{dl_0}\right)^{-1} (z - z^*),

    in which C picks the heights out of y: one factorisation and n back-substitutions a round.
    """
    system = LineSystem.of(line)
    y, unstressed = first_guess(system, start)
    state = come_to_rest(system, unstressed, y)
    error = state.height - system.target
    for rounds in range(_ROUNDS):
        if np.max(np.abs(error)) < _TOLERANCE:
            how = f"lengths were adjusted in {rounds} rounds with {state.iterations} Newton iterations"
            return found_state(state, how, rounds, rounds + 1)
        change = -np.asarray(np.linalg.solve(state.height_by_parameter, error), dtype=np.float64)
        state = _adjusted(state, change)
        error = state.height - system.target
    raise NotConvergedError(
        f"the heights are still {np.max(np.abs(error)):.3g} m off after {_ROUNDS} adjustments",
        "--method direct",
    )


def _adjusted(state: LineState, change: FloatArray, part: float = 1.0) -> LineState:
    """Return the line at rest after a part of a change of lengths, or after half of it if that is too far."""
    guess = state.y + part * (state.by_parameter @ change)
    try:
        return come_to_rest(state.system, state.unstressed + part * change, guess, state.iterations)
    except NotConvergedError:
        if part < _SMALLEST:
            raise
    return _adjusted(state, change, 0.5 * part)
