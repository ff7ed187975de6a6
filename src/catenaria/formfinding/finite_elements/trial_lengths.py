"""Finite elements with dropper lengths adjusted by trial [15, 16]: the plain way, to show what it costs.

Our reconstruction: every dropper is made longer by what the contact wire hangs too high at it, and the line
is computed again, until all heights are right.
"""

from __future__ import annotations

import numpy as np

from catenaria.errors import NotConvergedError
from catenaria.formfinding.finite_elements.found import Found, found_state
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.rest import come_to_rest
from catenaria.formfinding.finite_elements.start import first_guess
from catenaria.line import Line
from catenaria.results.form import FormResult

_TOLERANCE = 5e-8  # m, of the heights
_TRIALS = 500


def try_lengths(line: Line, start: FormResult | None) -> Found:
    r"""Find the dropper lengths with which the contact wire rests at the wanted heights, by trial.

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
    :math:`l_0 \leftarrow l_0 + z(l_0) - z^*`. The error goes down by the spectral radius of
    :math:`1 + dz/dl_0`: one half on the paper's line, where both wires are equally taut, because a dropper
    that is made longer lowers the contact wire by a half and lets the messenger rise by the other.
    """
    system = LineSystem.of(line)
    y, unstressed = first_guess(system, start)
    state = come_to_rest(system, unstressed, y)
    error = state.height - system.target
    for trial in range(_TRIALS):
        if np.max(np.abs(error)) < _TOLERANCE:
            how = f"{trial} trials of all lengths took {state.iterations} Newton iterations"
            return found_state(state, how, trial, trial + 1)
        state = come_to_rest(system, state.unstressed + error, state.y, state.iterations)
        error = state.height - system.target
    raise NotConvergedError(
        f"the heights are still {np.max(np.abs(error)):.3g} m off after {_TRIALS} trials",
        "--method 'adjusted lengths', which knows what every length does",
    )
