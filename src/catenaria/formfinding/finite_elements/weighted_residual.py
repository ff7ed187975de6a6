"""Minimising a weighted residual of tensions and heights [8].

Our reconstruction of the family: the original weighs tensions of wires against lateral positions of steady
arms; in the plane heights of the contact wire take the place of the latter.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from catenaria.formfinding.finite_elements.found import Found
from catenaria.formfinding.finite_elements.least_squares import least_squares
from catenaria.formfinding.finite_elements.line_system import LineSystem
from catenaria.formfinding.finite_elements.rest import come_to_rest
from catenaria.formfinding.finite_elements.start import first_guess
from catenaria.formfinding.finite_elements.trials import Trials
from catenaria.line import Line
from catenaria.results.form import FormResult

FloatArray = NDArray[np.float64]

TENSION, HEIGHT = 1e-3, 1e-3  # relative tension, and metres, that weigh the same


def minimise_weighted_residual(line: Line, start: FormResult | None) -> Found:
    r"""Find the lengths of droppers and wires for which a weighted residual is least, and zero.

    Parameters
    ----------
    line : Line
        What the engineer describes.
    start : FormResult or None
        An earlier result to begin from.

    Raises
    ------
    NotConvergedError
        If the least is not zero, or a state of equilibrium is not found.

    Notes
    -----
    Parameters are the unstressed lengths of the droppers and how far the ends of both wires are pulled, so
    that the n heights and two tensions have as many lengths to be met by:

    .. math:: \Phi = \sum_{c,m} \left(\frac{T - T^*}{10^{-3}\,T^*}\right)^2
              + \sum_i \left(\frac{z_i - z_i^*}{1\,\text{mm}}\right)^2 .

    With fewer lengths than demands the answer would depend on the weights; here the least must be zero, and
    it does not.
    """
    first = LineSystem.of(line)
    y, unstressed = first_guess(first, start)
    wanted = np.array([first.contact.mesh.tension, first.messenger.mesh.tension])
    pulls = np.array([part[-1] for part in first.parts(y)])
    system = first.pulled(*pulls.tolist())
    parameters = np.concatenate((unstressed, pulls))
    trials = Trials(come_to_rest(system, unstressed, y), parameters)

    def residual(lengths: FloatArray) -> FloatArray:
        state = trials.at(lengths)
        tension = (state.tension / wanted - 1.0) / TENSION
        return np.concatenate((tension, (state.height - system.target) / HEIGHT))

    def derivative(lengths: FloatArray) -> FloatArray:
        state = trials.at(lengths)
        tension = state.tension_by_parameter / (wanted * TENSION)[:, None]
        return np.vstack((tension, state.height_by_parameter / HEIGHT))

    lengths, rounds = least_squares(residual, derivative, parameters)
    return trials.found(lengths, rounds, "the weighted residual was minimised")
